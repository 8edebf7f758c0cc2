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


def path_points(path: ElementTree.Element) -> list[NDArray[np.float64]]:
    """The points of every part of a path, y up."""
    parts = path.attrib["d"].replace("Z", "").removeprefix("M").split("M")
    return [np.array([place.split(" ") for place in part.split("L")], dtype=float) * (1, -1) for part in parts]


def strokes(segments: NDArray[np.float64], width: NDArray[np.float64]) -> shapely.Geometry:
    """Edges in their widths: each a trapezium with a disc at either end."""
    a, b = segments[:, 0], segments[:, 1]
    along = (b - a) / np.hypot(*(b - a).T)[:, None]
    across = along[:, ::-1] * (-1, 1)
    first, second = across * width[:, :1] / 2, across * width[:, 1:] / 2
    trapezia = shapely.polygons(np.stack([a + first, b + second, b - second, a - first], axis=1))
    return shapely.union_all([*trapezia, *shapely.buffer(shapely.points(segments), width / 2).ravel()])


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
    box = shapely.box(*json.loads((tmp_path / "crack.geojson").read_text())["bbox"])
    assert all(box.covers(line) for line in lines)


@pytest.mark.parametrize("name", CRACKS)
def test_svg_has_centrelines_and_true_outlines_by_generation(tmp_path: Path, name: str) -> None:
    c = CRACKS[name]()
    c.save(tmp_path / "crack.svg")
    root = ElementTree.parse(tmp_path / "crack.svg").getroot()
    groups = {group.attrib["id"]: group for group in root.findall(f"{NAME}g")}
    wanted = {f"-generation-{k}" for k in np.unique(c.generation)}
    for kind in ("outlines", "centrelines"):
        assert {group.attrib["id"].removeprefix(kind) for group in groups[kind]} == wanted
    lines = [path_points(path)[0] for path in groups["centrelines"].iter(f"{NAME}path")]
    shapes = [path_points(path) for path in groups["outlines"].iter(f"{NAME}path")]
    steps = np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T)
    assert sum(shapely.LineString(line).length for line in lines) == pytest.approx(steps.sum())
    assert len(lines) == len(shapes)
    if not len(lines):
        return
    drawn = shapely.union_all([shapely.Polygon(part).buffer(0) for parts in shapes for part in parts])
    if c.period is not None:
        moves = [(float(use.attrib["x"]), -float(use.attrib["y"])) for use in root.findall(f"{NAME}use")]
        assert len(moves) % 2 == 0
        drawn = shapely.union_all([shapely.affinity.translate(drawn, *move) for move in [(0, 0), *moves]])
    around = [0.0] if c.period is None else [-1.0, 0.0, 1.0]
    moves = [np.multiply((x, y), c.period or (0, 0)) for x in around for y in around]
    expected = shapely.union_all([strokes(c.segments + move, c.width) for move in moves])
    drawn, expected = (shapely.intersection(shape, shapely.box(*c.bounds)) for shape in (drawn, expected))
    # Mitres stand out a little, and round ends are polygons.
    assert shapely.symmetric_difference(drawn, expected).area < 0.01 * expected.area


def test_a_hairpin_is_as_wide_as_its_edges(tmp_path: Path) -> None:
    graph = cz.PlanarGraph([(0.1, 0.2), (0.9, 0.2), (0.1, 0.3)], [(0, 1), (1, 2)])
    c = cz.Crack(graph, np.full((2, 2), 0.04), np.zeros(2, np.int32), np.zeros(2, np.int32), (0, 0, 1, 1))
    c.save(tmp_path / "crack.svg")
    (path,) = ElementTree.parse(tmp_path / "crack.svg").getroot().find(f"{NAME}g").iter(f"{NAME}path")
    drawn = shapely.union_all([shapely.Polygon(part) for part in path_points(path)])
    assert drawn.area == pytest.approx(shapely.LineString(graph.vertices).buffer(0.02).area, rel=1e-3)


@pytest.mark.parametrize("name", CRACKS)
def test_dxf_passes_the_audit_with_layers_and_widths(tmp_path: Path, name: str) -> None:
    c = CRACKS[name]()
    c.save(tmp_path / "crack.dxf")
    drawing = ezdxf.readfile(tmp_path / "crack.dxf")
    assert not drawing.audit().has_errors
    assert drawing.units == 0
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


@pytest.mark.parametrize("ending", [".svg", ".dxf", ".geojson"])
@pytest.mark.parametrize(
    ("place", "width", "message"),
    [
        (np.nan, 0.1, r"vertices\[1\] is \(nan, 0.5\)"),
        (np.inf, 0.1, r"vertices\[1\] is \(inf, 0.5\)"),
        (0.5, np.nan, r"width\[0\] is \(nan, 0.1\)"),
        (0.5, -0.1, r"width\[0\] is \(-0.1, 0.1\)"),
    ],
)
def test_what_cannot_be_drawn_is_named_and_leaves_the_old_file(
    tmp_path: Path, ending: str, place: float, width: float, message: str
) -> None:
    graph = cz.PlanarGraph([(0.1, 0.5), (place, 0.5)], [(0, 1)])
    c = cz.Crack(graph, np.array([(width, 0.1)]), np.zeros(1, np.int32), np.zeros(1, np.int32), (0, 0, 1, 1))
    path = tmp_path / f"crack{ending}"
    path.write_text("old")
    with pytest.raises(ValueError, match=message):
        c.save(path)
    assert path.read_text() == "old"


@pytest.mark.parametrize("corner", [(543210.3, 5412345.7), (-543210.3, -5412345.7), (0.1, 5e6)])
def test_far_from_the_origin_places_are_numbers_of_single_precision(
    tmp_path: Path, corner: tuple[float, float]
) -> None:
    x, y = corner
    c = cz.crack(preset="rock", n=20, rng=3, bounds=(x, y, x + 150, y + 100))
    c.save(tmp_path / "crack.svg")
    root = ElementTree.parse(tmp_path / "crack.svg").getroot()
    group = root.find(f"{NAME}g[@id='centrelines']")
    assert group is not None
    move = np.array(group.attrib["transform"][len("translate(") : -1].split(), dtype=float) * (1, -1)
    found = np.concatenate([path_points(path)[0] for path in group.iter(f"{NAME}path")])
    # What a browser makes of them is off by less than a tenth of a pixel in a thousand.
    assert np.abs(found.astype(np.float32) - found).max() < 150 / 1e5
    # With the move they are the vertices to the last bit.
    np.testing.assert_array_equal(np.unique(found + move, axis=0), np.unique(c.graph.vertices, axis=0))
    c.graph.save(tmp_path / "graph.svg")
    assert (tmp_path / "graph.svg").read_text().count("transform") == 1
    again = cz.sample.from_svg(tmp_path / "graph.svg")
    np.testing.assert_array_equal(np.unique(again, axis=0), np.unique(c.graph.vertices, axis=0))


@pytest.mark.parametrize("period", [None, (2, 1)])
def test_drawings_have_the_size_that_is_asked_for(period, tmp_path):
    """A cutter takes lengths as they are: those of the file, times what the file says of its units."""
    crack = cz.crack(preset="glaze", n=40, period=period, bounds=None if period else (1, 2, 3, 3), rng=3)
    crack.save(tmp_path / "plain.svg")
    crack.save(tmp_path / "large.svg", millimetres=150)
    plain, large = (ElementTree.parse(tmp_path / f"{name}.svg").getroot() for name in ("plain", "large"))
    assert (large.attrib["width"], large.attrib["height"]) == ("300.0mm", "150.0mm")
    assert not {"width", "height"} & set(plain.attrib)
    assert large.attrib["viewBox"] == plain.attrib["viewBox"]
    left, right = ([path.attrib["d"] for path in root.iter(f"{NAME}path")] for root in (plain, large))
    assert left == right
    crack.save(tmp_path / "plain.dxf")
    crack.save(tmp_path / "large.dxf", millimetres=150)
    plain, large = (ezdxf.readfile(tmp_path / f"{name}.dxf") for name in ("plain", "large"))
    assert (plain.units, large.units) == (ezdxf.units.InsertUnits.Unitless, ezdxf.units.MM)
    for lines in zip(plain.modelspace(), large.modelspace(), strict=True):
        one, other = (np.array(line.get_points("xyse")) for line in lines)
        np.testing.assert_allclose(other, 150 * one, atol=1e-9)


@pytest.mark.parametrize(
    ("name", "millimetres", "told"),
    [("a.geojson", 5, "GeoJSON"), ("a.svg", 0, "millimetres is 0"), ("a.dxf", np.nan, "millimetres is nan")],
)
def test_a_size_that_cannot_be_is_told(name, millimetres, told, tmp_path):
    with pytest.raises(ValueError, match=told):
        cz.crack(n=20, rng=1).save(tmp_path / name, millimetres=millimetres)
    assert not list(tmp_path.iterdir())
