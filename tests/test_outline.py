"""Points on polygons and SVG paths, beside Shapely and closed forms."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import crazing as cz

svgpathtools = pytest.importorskip("svgpathtools")

SHAPE = shapely.box(0, 0, 10, 4) - shapely.Point(5, 2).buffer(1)
CIRCLE = "M 3 0 A 3 3 0 0 1 -3 0 A 3 3 0 0 1 3 0 Z"


def test_points_lie_on_the_boundary_and_every_form_gives_the_same(tmp_path: Path) -> None:
    path = tmp_path / "shape.geojson"
    feature = {"type": "Feature", "properties": {}, "geometry": SHAPE.__geo_interface__}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}))
    points = cz.sample.from_polygon(SHAPE, n=200)
    assert len(points) == 200
    assert shapely.distance(SHAPE.boundary, shapely.points(points)).max() < 1e-12
    rings = [np.array(ring.coords) for ring in (SHAPE.exterior, *SHAPE.interiors)]
    for form in (SHAPE.__geo_interface__, feature, path, str(path), rings):
        np.testing.assert_array_equal(cz.sample.from_polygon(form, n=200), points)


def test_spacing_is_kept_and_corners_are_the_default() -> None:
    square = [(0, 0), (2, 0), (2, 2), (0, 2), (0, 0)]
    np.testing.assert_array_equal(cz.sample.from_polygon(square), square[:4])
    points = cz.sample.from_polygon(square, spacing=0.5)
    np.testing.assert_allclose(np.hypot(*(np.roll(points, -1, axis=0) - points).T), 0.5)


def test_an_arc_of_svg_is_round_and_up() -> None:
    points = cz.sample.from_svg(CIRCLE, n=300)
    np.testing.assert_allclose(np.hypot(*points.T), 3, atol=0.005)
    assert cz.sample.from_svg("M0 0 L1 5 L2 0 Z")[:, 1].tolist() == [0, -5, 0]


def test_open_paths_keep_both_ends_and_files_give_all_paths(tmp_path: Path) -> None:
    np.testing.assert_allclose(cz.sample.from_svg("M0 0 H4", n=3), [(0, 0), (2, 0), (4, 0)])
    path = tmp_path / "two.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{CIRCLE}"/><path d="M9 9 h4 v4 z"/></svg>')
    points = cz.sample.from_svg(path, spacing=0.5)
    assert (points[:, 0] > 8).any() and (points[:, 0] < 0).any()


def picture(tmp_path: Path, inner: str, attributes: str = "") -> Path:
    path = tmp_path / "picture.svg"
    names = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
    path.write_text(f"<svg {names} {attributes}>{inner}</svg>")
    return path


NESTED = """
<g transform="translate(5 -3) rotate(30)"><g transform="scale(2, 0.5)">
<path transform="skewX(20)" d="M0 0 C 1 2 3 4 5 0 L 7 1 Q 8 8 9 1 Z"/>
<rect x="1" y="2" width="3" height="4" transform="matrix(1 .5 -.5 1 2 2)"/></g>
<polyline points="0,0 3,1 4,4" transform="rotate(90 1 2) skewY(-10)"/></g>
<line x1="1" y1="2" x2="3" y2="5"/><polygon points="0 0 2 0 1 1" transform="scale(-3)"/>
"""


def test_transforms_are_those_of_the_svg_library(tmp_path: Path) -> None:
    path = picture(tmp_path, NESTED)
    theirs = svgpathtools.Document(str(path)).paths()
    assert len(theirs) == 5
    for line in theirs:
        # Bézier curves keep their parameter when they are moved, so that the very points are known.
        wanted = [segment.point(i / 32) for segment in line for i in range(0, 32, 32 if len(segment) == 2 else 1)]
        wanted = np.array([(point.real, -point.imag) for point in wanted])
        away = np.hypot(*(wanted[:, None] - cz.sample.from_svg(path)).T).min(axis=0)
        assert away.max() < 1e-12


def test_a_circle_becomes_the_ellipse_it_is_drawn_as(tmp_path: Path) -> None:
    path = picture(tmp_path, '<g transform="rotate(90)"><circle r="2" transform="translate(7 1) scale(3 1)"/></g>')
    x, y = cz.sample.from_svg(path).T
    # Scaled, moved, and turned by a quarter with y down: about (-1, 7) there.
    np.testing.assert_allclose(((x + 1) / 2) ** 2 + ((y + 7) / 6) ** 2, 1, atol=1e-12)


def test_copies_inner_pictures_definitions_and_what_is_hidden(tmp_path: Path) -> None:
    square = '<path id="a" d="M0 0 H1 V1 H0 Z"/>'
    hidden = f'<g display="none">{square}</g><g style="fill:red; display: none">{square}</g>'
    assert cz.sample.from_svg(picture(tmp_path, hidden + '<path d="M3 3 H4"/>')).tolist() == [[3, -3], [4, -3]]
    defined = f"<defs>{square}<symbol id='b'><path d='M5 5 H6'/></symbol></defs>"
    copies = '<use href="#a" x="10" transform="scale(2)"/><use xlink:href="#b" y="1"/>'
    points = cz.sample.from_svg(picture(tmp_path, defined + copies))
    assert points.tolist() == [[20, 0], [22, 0], [22, -2], [20, -2], [5, -6], [6, -6]]
    inner = '<svg x="10" y="20" width="40" height="20" viewBox="1 1 2 2"><path d="M1 1 H3 V3"/></svg>'
    points = cz.sample.from_svg(picture(tmp_path, inner, 'viewBox="0 0 100 100" width="7cm"'))
    # Ten times as large, and in the middle of forty.
    assert points.tolist() == [[20, -20], [40, -20], [40, -40]]


@pytest.mark.parametrize(
    "inner",
    [
        '<path d="M0 0 H1" transform="turn(3)"/>',
        '<use href="#nowhere"/>',
        '<g id="a"><use href="#a"/><use href="#a"/></g>',
        '<circle r="wide"/>',
        "<g>",
        "",
    ],
)
def test_a_picture_that_makes_no_sense_is_refused(tmp_path: Path, inner: str) -> None:
    with pytest.raises(ValueError, match=r"SVG|empty"):
        cz.sample.from_svg(picture(tmp_path, inner))


@pytest.mark.parametrize(
    ("call", "argument", "error"),
    [
        ("from_polygon", [(0, 0), (1, 1)], ValueError),
        ("from_polygon", {"type": "Point", "coordinates": (0, 0)}, ValueError),
        ("from_polygon", [(0, 0), (1, 0), (float("nan"), 1)], cz.CrazingError),
        ("from_polygon", "no such file", OSError),
        ("from_svg", "no such file", OSError),
        ("from_svg", "M", ValueError),
        ("from_svg", "M 0 0 L x", ValueError),
    ],
)
def test_what_is_no_outline_is_refused(call: str, argument: Any, error: type[Exception]) -> None:
    with pytest.raises(error):
        getattr(cz.sample, call)(argument)


def test_number_and_spacing_exclude_one_another() -> None:
    with pytest.raises(ValueError, match="only one"):
        cz.sample.from_polygon(SHAPE, n=5, spacing=1.0)
