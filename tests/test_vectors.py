"""Cracks as files, read back by other programs: lxml-free XML, svgpathtools' own grammar by hand, ezdxf, Shapely."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

import crazing as cz

NAME = "{http://www.w3.org/2000/svg}"


def path_points(path: ElementTree.Element) -> NDArray[np.float64]:
    text = path.attrib["d"].removeprefix("M").removesuffix("Z")
    return np.array([place.split(" ") for place in text.split("L")], dtype=float) * (1, -1)


CRACKS = {
    "thesis": lambda: cz.crack(n=120, rng=3),
    "paint": lambda: cz.crack(preset="painting-italian", n=60, rng=3),
    "glaze": lambda: cz.crack(preset="glaze", n=40, rng=3),
    "torus": lambda: cz.crack(preset="glaze", n=40, period=(2, 1), rng=3),
    "glass": lambda: cz.crack(preset="glass-impact", n=40, rng=3),
    "growing": lambda: cz.crack(preset="asphalt-alligator", n=40, rng=3).at(0.5),
    "nothing": lambda: cz.crack(n=0, rng=3),
}


@pytest.mark.parametrize("name", CRACKS)
def test_geojson_is_every_edge_once_with_who_abuts_whom(tmp_path: Path, name: str) -> None:
    c = CRACKS[name]()
    c.save(tmp_path / "crack.geojson")
    features = json.loads((tmp_path / "crack.geojson").read_text())["features"]
    lines = [shapely.from_geojson(json.dumps(feature["geometry"])) for feature in features]
    length = np.zeros(int(c.strand.max(initial=-1)) + 1)
    for feature, line in zip(features, lines, strict=True):
        facts = feature["properties"]
        length[facts["strand"]] += line.length
        rows = c.strand == facts["strand"]
        assert set(c.generation[rows]) == {facts["generation"]}
        assert set(c.parent[rows]) == {-1 if facts["parent"] is None else facts["parent"]}
        assert facts["width"] == max(facts["widths"]) <= c.width[rows].max()
        assert len(facts["widths"]) == len(line.coords)
    steps = np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T)
    np.testing.assert_allclose(length, np.bincount(c.strand, steps, len(length)), rtol=1e-9)
    assert sum(len(line.coords) - 1 for line in lines) == len(c.graph.edges)


@pytest.mark.parametrize("name", CRACKS)
def test_svg_has_centrelines_and_true_outlines_by_generation(tmp_path: Path, name: str) -> None:
    c = CRACKS[name]()
    c.save(tmp_path / "crack.svg")
    root = ElementTree.parse(tmp_path / "crack.svg").getroot()
    groups = {group.attrib["id"]: group for group in root.findall(f"{NAME}g")}
    wanted = {f"-generation-{k}" for k in np.unique(c.generation)}
    for kind in ("outlines", "centrelines"):
        assert {group.attrib["id"].removeprefix(kind) for group in groups[kind]} == wanted
    lines = [path_points(path) for path in groups["centrelines"].iter(f"{NAME}path")]
    shapes = [path_points(path) for path in groups["outlines"].iter(f"{NAME}path")]
    steps = np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T)
    assert sum(shapely.LineString(line).length for line in lines) == pytest.approx(steps.sum())
    for line, shape in zip(lines, shapes, strict=True):
        assert len(shape) == 2 * len(line)
        # Opposite points of the outline have the centreline in their middle.
        np.testing.assert_allclose((shape[: len(line)] + shape[::-1][: len(line)]) / 2, line, atol=1e-12)
    # Area between centreline and width: trapezia, but for joints.
    area = sum(abs(shapely.Polygon(shape).area) for shape in shapes if len(shape) > 3)
    assert area == pytest.approx((steps * c.width.mean(axis=1)).sum(), rel=0.05)


@pytest.mark.parametrize("name", CRACKS)
def test_dxf_passes_the_audit_with_layers_and_widths(tmp_path: Path, name: str) -> None:
    c = CRACKS[name]()
    c.save(tmp_path / "crack.dxf")
    drawing = ezdxf.readfile(tmp_path / "crack.dxf")
    assert not drawing.audit().has_errors
    lines = list(drawing.modelspace())
    assert {line.dxf.layer for line in lines} == {f"generation-{k}" for k in np.unique(c.generation)}
    assert sum(len(line) - 1 for line in lines) == len(c.graph.edges)
    found = np.sort(
        np.concatenate([[row[2:4] for row in line.get_points("xyse")[:-1]] for line in lines] or [[]]), axis=None
    )
    np.testing.assert_allclose(found, np.sort(c.width, axis=None), rtol=1e-12, atol=1e-15)


def test_other_endings_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"'crack.pdf'; an ending of .svg, .dxf, .geojson is wanted"):
        cz.crack(n=9, rng=1).save("crack.pdf")
