"""Points on polygons and SVG paths, beside Shapely and closed forms."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import crazing as cz

pytest.importorskip("svgpathtools")

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
