"""Curves through all samples: manifolds, corners, closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import crazing as cz


def pairs(edges: NDArray[np.int32]) -> set[tuple[int, int]]:
    return {(min(a, b), max(a, b)) for a, b in edges.tolist()}


def ring(n: int) -> set[tuple[int, int]]:
    return {(min(i, (i + 1) % n), max(i, (i + 1) % n)) for i in range(n)}


def sampled(corners: list[tuple[float, float]], parts: int) -> NDArray[np.float64]:
    """A polygon with each side in as many parts."""
    ends = np.array(corners, dtype=float)
    share = np.linspace(0, 1, parts, endpoint=False)[None, :, None]
    return (ends[:, None] + share * (np.roll(ends, -1, axis=0) - ends)[:, None]).reshape(-1, 2)


@pytest.mark.parametrize("width", [4.0, 2.0, 1.0, 0.5])
def test_a_wedge_keeps_its_acute_corner(width: float) -> None:
    points = sampled([(0, width / 2), (4, 0), (0, -width / 2)], 30)
    assert pairs(cz.curve(points).edges) == ring(len(points))


def test_a_star_of_twelve_is_one_ring_where_the_crust_is_not() -> None:
    turn = np.arange(24) * np.pi / 12
    radius = np.where(np.arange(24) % 2, 0.5, 1.0)
    points = sampled(list(zip(radius * np.cos(turn), radius * np.sin(turn), strict=True)), 12)
    assert pairs(cz.curve(points).edges) == ring(len(points))
    assert pairs(cz.crust(points, method="one-step").edges) != ring(len(points))


def test_two_rings_and_an_open_line_stay_apart() -> None:
    t = np.linspace(0, 2 * np.pi, 80, endpoint=False)
    circle = np.column_stack([np.cos(t), np.sin(t)])
    line = np.column_stack([np.linspace(-4, 4, 90), np.full(90, 6.0) + 0.1 * np.sin(np.linspace(-4, 4, 90))])
    graph = cz.curve(np.vstack([circle, 3 * circle, line]))
    assert graph.components == 3
    assert sorted(np.unique(graph.degrees, return_counts=True)[1].tolist()) == [2, 248]


@settings(max_examples=60, deadline=None)
@given(n=st.integers(3, 60), seed=st.integers(0, 10**6), snap=st.booleans())
def test_a_curve_is_a_manifold_of_delaunay_edges(n: int, seed: int, snap: bool) -> None:
    points = cz.sample.uniform(n, rng=seed)
    d = cz.diagram(np.round(points * 6) if snap else points)
    if not len(d.triangles):
        with pytest.raises(cz.DegenerateInputError):
            cz.curve(d)
        return
    graph = cz.curve(d)
    assert graph.degrees.max(initial=0) <= 2
    assert pairs(graph.edges) <= pairs(d.edges)
    assert graph == cz.curve(d)


def test_the_unit_does_not_matter() -> None:
    points = sampled([(0, 1), (4, 0), (0, -1)], 30)
    for scale in (2.0**-300, 2.0**20, 2.0**300):
        assert pairs(cz.curve(points * scale).edges) == ring(len(points))
