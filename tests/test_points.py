"""What is no array of numbers and is taken as points: geometries, GeoJSON, diagrams."""

from __future__ import annotations

from typing import Any

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
