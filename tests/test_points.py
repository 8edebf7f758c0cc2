"""What is no array of numbers and is taken as points: geometries, GeoJSON, diagrams; and what is taken as a shape."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crazing as cz

SQUARE = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0], [3.0, 2.5]]


def shapely(form: str) -> Any:
    geometry = pytest.importorskip("shapely")
    points = [geometry.Point(row) for row in SQUARE]
    forms = {
        "points": points,
        "array of points": geometry.points(SQUARE),
        "multipoint": geometry.MultiPoint(SQUARE),
        "geojson": geometry.MultiPoint(SQUARE).__geo_interface__,
        "features": {"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": p} for p in points]},
        "list of geojson": [point.__geo_interface__ for point in points],
    }
    return forms[form]


@pytest.mark.parametrize("form", ["points", "array of points", "multipoint", "geojson", "features", "list of geojson"])
def test_geometries_are_points(form: str) -> None:
    assert cz.diagram(shapely(form)) == cz.diagram(SQUARE)


@pytest.mark.parametrize("odd", [None, 5, "x"])
def test_an_odd_one_among_geometries_is_named(odd: Any) -> None:
    with pytest.raises(ValueError, match=f"points holds {odd!r} where positions are wanted"):
        cz.diagram([*shapely("points"), odd])


def test_a_diagram_of_another_period_is_refused() -> None:
    with pytest.raises(ValueError, match=r"period is \(7.0, 5.0\), that of the diagram given as points is None"):
        cz.diagram(cz.diagram(SQUARE), period=(7, 5))


def test_a_crack_over_a_periodic_diagram_is_periodic() -> None:
    points = cz.sample.uniform(40, rng=1)
    torus = cz.diagram(points, period=(1, 1))
    assert cz.crack(torus, rng=1) == cz.crack(points, period=(1, 1), rng=1)
    with pytest.raises(ValueError, match="bounds and period are both given"):
        cz.crack(torus, bounds=(0, 0, 1, 1), rng=1)


def test_polygons_come_from_files(tmp_path: Path) -> None:
    path = tmp_path / "shape.geojson"
    shape = {"type": "Polygon", "coordinates": [[[0, 0], [6, 0], [6, 2], [0, 2], [0, 0]]]}
    path.write_text(json.dumps({"type": "FeatureCollection", "features": [{"type": "Feature", "geometry": shape}]}))
    points = [6, 2] * cz.sample.uniform(40, rng=1)
    for name in (path, str(path)):
        assert cz.centerline(name) == cz.centerline(shape)
        assert cz.maze(points, within=name, rng=1) == cz.maze(points, within=shape, rng=1)
    with pytest.raises(FileNotFoundError, match=r"none\.geojson"):
        cz.centerline(tmp_path / "none.geojson")
    path.write_text("no")
    with pytest.raises(ValueError, match="is no GeoJSON"):
        cz.maze(points, within=path)


@pytest.mark.parametrize("kind", [bool, np.uint8, np.int64, float])
def test_masks_of_zero_and_one_are_shapes(kind: type) -> None:
    mask = np.zeros((20, 30))
    mask[4:15, 3:25] = 1
    points = [30, 20] * cz.sample.uniform(60, rng=1)
    assert cz.maze(points, within=mask.astype(kind), rng=1) == cz.maze(points, within=mask > 0, rng=1)


@pytest.mark.parametrize("call", [cz.sample.from_image, cz.measure, lambda name: cz.sample.from_density(name, 9)])
def test_a_name_of_a_picture_is_no_picture(call: Callable[[Any], Any]) -> None:
    for name in ("leaf.png", Path("leaf.png")):
        with pytest.raises(
            TypeError, match=r"(image|mask) is 'leaf.png'; pixels are wanted: crazing.images.read_image"
        ):
            call(name)
