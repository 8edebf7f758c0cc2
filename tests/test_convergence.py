"""The inner axis approaches the true one as samples double, at the order that theory gives; distances by Shapely."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

import crazing as cz

Points = NDArray[np.float64]
SIZES = 64, 128, 256


def ellipse(n: int) -> Points:
    t = (np.arange(n) + 0.5) * 2 * np.pi / n
    return np.stack([np.cos(t), 0.6 * np.sin(t)], axis=1)


def annulus(n: int) -> Points:
    rings = [shapely.Point(0, 0).buffer(r, quad_segs=k // 4).exterior for r, k in ((1.0, 2 * n), (0.5, n))]
    return np.concatenate([shapely.get_coordinates(ring)[:-1] for ring in rings])


def rectangle(n: int) -> Points:
    ring = shapely.box(-1, -0.5, 1, 0.5).exterior
    return shapely.get_coordinates(shapely.line_interpolate_point(ring, (np.arange(n) + 0.5) * ring.length / n))


ARMS = [[(0.5 * x, 0), (x, y)] for x in (-1, 1) for y in (-0.5, 0.5)]
SHAPES = {
    "ellipse": (ellipse, shapely.LineString([(-0.64, 0), (0.64, 0)]), 1.9, 2.1),
    "annulus": (annulus, shapely.Point(0, 0).buffer(0.75, quad_segs=200).exterior, 1.8, 2.2),
    "rectangle": (rectangle, shapely.MultiLineString([[(-0.5, 0), (0.5, 0)], *ARMS]), 0.8, 1.2),
}


@pytest.mark.parametrize("method", ["edge-filter", "one-step"])
@pytest.mark.parametrize("name", SHAPES)
def test_the_axis_converges_at_its_order(name: str, method: str) -> None:
    outline: Callable[[int], Points]
    outline, truth, low, high = SHAPES[name]

    def distance(n: int) -> float:
        axis = cz.medial_axis(outline(n), method=method).inner
        found = shapely.MultiLineString(list(axis.segments))
        return float(shapely.hausdorff_distance(found, shapely.segmentize(truth, 0.01)))

    distances = [distance(n) for n in SIZES]
    order = -np.polyfit(np.log(SIZES), np.log(distances), 1)[0]
    assert low < order < high, distances
