"""Files read back by other programs' readers."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

import crazing as cz

SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def graph(rng: np.random.Generator) -> cz.PlanarGraph:
    """Chains, a ring of three, a loop, a doubled edge and a lonely vertex, at awkward coordinates."""
    vertices = rng.normal(size=(12, 2)) * 10.0 ** rng.integers(-8, 8, size=(12, 1))
    edges = [[0, 1], [1, 2], [3, 4], [4, 5], [5, 3], [6, 6], [7, 8], [8, 7], [9, 10], [9, 0]]
    return cz.PlanarGraph(vertices, edges)


def lines(graph: cz.PlanarGraph) -> list[list[list[float]]]:
    coords, offsets = graph.polylines()
    return [line.tolist() for line in np.split(coords, offsets[1:-1])] if len(offsets) > 1 else []


def drawn(path: str) -> list[list[list[float]]]:
    """The lines of an SVG path, y up."""
    parts = [re.split(r"[L ]", part) for part in path.split("M")[1:]]
    return [(np.array(part, dtype=float).reshape(-1, 2) * (1, -1)).tolist() for part in parts]


def box(svg: ElementTree.Element) -> NDArray[np.float64]:
    return np.array(svg.get("viewBox", "").split(), dtype=float)


def test_svg_keeps_every_bit(graph: cz.PlanarGraph, tmp_path: Path) -> None:
    graph.save(tmp_path / "drawing.SVG")
    root = ElementTree.parse(tmp_path / "drawing.SVG").getroot()
    (path,) = root.findall(f"{SVG}path")
    assert drawn(path.get("d", "")) == lines(graph)
    left, top, width, height = box(root)
    points = graph.compact().vertices * (1, -1)
    assert (points >= [left, top]).all()
    assert (points <= [left + width, top + height]).all()
    assert path.get("fill") == "none"
    assert root.findtext(f"{SVG}metadata") == f"crazing {cz.__version__}"


@given(title=st.text(), stroke=st.text())
def test_svg_stays_well_formed_whatever_its_words(title: str, stroke: str) -> None:
    text = cz.PlanarGraph([[0, 0], [1, 1]], [[0, 1]]).to_svg(title=title, stroke=stroke)
    root = ElementTree.fromstring(text.encode())
    if title.isprintable():
        assert (root.findtext(f"{SVG}title") or "") == title
    assert root.find(f"{SVG}path") is not None


@pytest.mark.parametrize("edges", [[], [[0, 0]], [[0, 1]]])
def test_svg_of_nothing_a_dot_or_a_level_line_has_a_box(edges: list[list[int]]) -> None:
    svg = ElementTree.fromstring(cz.PlanarGraph([[1, 2], [5, 2]], edges).to_svg())
    assert (box(svg)[2:] > 0).all()


def test_svg_shows_in_a_notebook_up_to_a_size() -> None:
    square = [[0, 0], [1, 0], [1, 1]]
    assert "<svg" in (cz.PlanarGraph(square, [[0, 1]])._repr_svg_() or "")
    assert cz.PlanarGraph(square, [[0, 1]] * 100_000)._repr_svg_() is None
    assert cz.PlanarGraph([[0, 0], [np.nan, 0]], [[0, 1]])._repr_svg_() is None
    assert cz.PlanarGraph([[-1e308, 0], [1e308, 0]], [[0, 1]])._repr_svg_() is None


def test_geojson_keeps_every_bit(graph: cz.PlanarGraph, tmp_path: Path) -> None:
    graph.save(str(tmp_path / "drawing.geojson"))
    feature = json.loads((tmp_path / "drawing.geojson").read_text())
    assert feature["type"] == "Feature"
    assert feature["geometry"] == {"type": "MultiLineString", "coordinates": lines(graph)}
    assert feature["properties"]["edges"] == len(graph.edges)
    shapely = pytest.importorskip("shapely")
    assert shapely.geometry.shape(feature["geometry"]).equals_exact(graph.to_shapely(), 0.0)


def test_dxf_keeps_every_bit_and_passes_the_audit(graph: cz.PlanarGraph, tmp_path: Path) -> None:
    ezdxf = pytest.importorskip("ezdxf")
    graph.save(tmp_path / "drawing.dxf")
    drawing = ezdxf.readfile(tmp_path / "drawing.dxf")
    assert not drawing.audit().errors
    # Data units may be any.
    assert drawing.units == 0
    found = []
    for entity in drawing.modelspace():
        assert entity.dxftype() == "LWPOLYLINE"
        points = [list(point) for point in entity.get_points("xy")]
        found.append([*points, points[0]] if entity.closed else points)
    assert found == lines(graph)


@pytest.mark.parametrize("ending", [".svg", ".geojson", ".dxf"])
def test_a_drawing_of_nothing_is_a_file(ending: str, tmp_path: Path) -> None:
    cz.PlanarGraph([], []).save(tmp_path / f"nothing{ending}")
    assert (tmp_path / f"nothing{ending}").stat().st_size


@pytest.mark.parametrize("ending", [".svg", ".geojson", ".dxf"])
@pytest.mark.parametrize("place", [np.nan, np.inf, 1.5e308])
def test_what_cannot_be_drawn_leaves_the_old_file(ending: str, place: float, tmp_path: Path) -> None:
    path = tmp_path / f"old{ending}"
    path.write_text("old")
    graph = cz.PlanarGraph([[0, 0], [-1.5e308, 0], [place, 1]], [[0, 1], [1, 2]])
    with pytest.raises(ValueError, match=r"finite|too far"):
        graph.save(path)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("name", ["drawing.png", "drawing", ".svg", "drawing.svg.txt"])
def test_other_endings_are_refused_by_name(name: str, graph: cz.PlanarGraph, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"\.svg, \.geojson, \.dxf is wanted"):
        graph.save(tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_a_folder_that_is_not_there_is_an_oserror(graph: cz.PlanarGraph, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        graph.save(tmp_path / "no" / "drawing.svg")


@pytest.mark.parametrize(("width", "kind"), [(-1, ValueError), (np.inf, ValueError), ("1", TypeError)])
def test_a_bad_width_is_refused(width: Any, kind: type[Exception]) -> None:
    with pytest.raises(kind, match="width"):
        cz.PlanarGraph([[0, 0], [1, 1]], [[0, 1]]).to_svg(width=width)
