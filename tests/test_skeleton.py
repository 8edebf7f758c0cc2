"""Crusts and axes: against the literal definition on SciPy, known curves, and the laws."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import Delaunay, Voronoi

import crazing as cz


def flower(n: int) -> NDArray[np.float64]:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    r = 1000 * (1 + 0.3 * np.cos(5 * t) + 0.1 * np.cos(13 * t))
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


def pairs(edges: NDArray[np.int32]) -> set[tuple[int, int]]:
    return {(min(a, b), max(a, b)) for a, b in edges.tolist()}


def literal(points: NDArray[np.float64]) -> tuple[set[tuple[int, int]], set[tuple[int, int]]]:
    """Crust and initial axis as the thesis words them, on SciPy; the axis as pairs of rows of SciPy's vertices."""
    vertices = Voronoi(points).vertices
    simplices = Delaunay(np.vstack([points, vertices])).simplices
    edges = np.vstack([simplices[:, [0, 1]], simplices[:, [1, 2]], simplices[:, [2, 0]]])
    n = len(points)
    return pairs(edges[(edges < n).all(axis=1)]), pairs(edges[(edges >= n).all(axis=1)] - n)


@pytest.mark.parametrize("seed", range(10))
def test_two_pass_and_initial_are_the_literal_definition(seed: int) -> None:
    points = cz.sample.uniform(150, rng=seed)
    crust, axis = literal(points)
    d = cz.diagram(points)
    assert pairs(cz.crust(d).edges) == crust
    theirs = Voronoi(points).vertices
    nearest = [int(np.abs(theirs - v).sum(axis=1).argmin()) for v in d.vertices]
    initial = cz.medial_axis(d, method="initial")
    ours = {(min(nearest[a], nearest[b]), max(nearest[a], nearest[b])) for a, b in initial.axis.edges.tolist()}
    # Qhull drops a few triangles between far vertices; what it has, we have.
    assert len(ours ^ axis) <= 0.01 * len(axis)


def gold_snoeyink(d: cz.Diagram) -> NDArray[np.bool_]:
    """The circle test in floating point, straight from its definition with positions t on the bisector."""
    p, q = d.sites[d.edges[:, 0]], d.sites[d.edges[:, 1]]
    normal = np.column_stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]]) / np.hypot(*(q - p).T)[:, None]
    middle, half = (p + q) / 2, np.hypot(*(q - p).T) / 2
    t = [((d.vertices[side] - middle) * normal).sum(axis=1) for side in d.dual_edges.T]
    hull = d.dual_edges[:, 1] < 0
    return np.where(hull, t[0] < 0, -t[0] * t[1] >= half**2)


@pytest.mark.parametrize("seed", range(10))
def test_one_step_is_the_circle_test(seed: int) -> None:
    d = cz.diagram(cz.sample.laplace(400, rng=seed))
    s = cz.medial_axis(d, method="one-step")
    np.testing.assert_array_equal(s.crust_mask, gold_snoeyink(d))
    assert pairs(s.crust.edges) == pairs(d.edges[gold_snoeyink(d)])


@pytest.mark.parametrize("method", ["two-pass", "one-step"])
@pytest.mark.parametrize("n", [50, 400, 5000])
def test_smooth_curves_are_reconstructed_exactly(method: str, n: int) -> None:
    expected = {(min(i, (i + 1) % n), max(i, (i + 1) % n)) for i in range(n)}
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    assert pairs(cz.crust(np.column_stack([3 * np.cos(t), np.sin(t)]), method=method).edges) == expected
    if n >= 400:
        assert pairs(cz.crust(flower(n), method=method).edges) == expected


def test_axis_of_an_ellipse_is_its_segment() -> None:
    a, b, n = 2.0, 1.0, 4000
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    axis = cz.medial_axis(np.column_stack([a * np.cos(t), b * np.sin(t)])).axis
    ends = axis.vertices[axis.edges].reshape(-1, 2)
    inside = ends[(ends[:, 0] / a) ** 2 + (ends[:, 1] / b) ** 2 < 1]
    assert np.abs(inside[:, 1]).max() < 1e-4
    assert np.abs(inside[:, 0]).max() == pytest.approx((a * a - b * b) / a, abs=2e-3)


@settings(max_examples=60, deadline=None)
@given(n=st.integers(3, 80), seed=st.integers(0, 10**6), snap=st.booleans())
def test_nesting_of_crusts_and_axes(n: int, seed: int, snap: bool) -> None:
    points = cz.sample.uniform(n, rng=seed)
    d = cz.diagram(np.round(points * 8) if snap else points)
    if not len(d.triangles):
        with pytest.raises(cz.DegenerateInputError):
            cz.crust(d)
        return
    one, two, initial = (cz.medial_axis(d, method=m) for m in ("one-step", "edge-filter", "initial"))
    assert (one.crust_mask ^ one.axis_mask).all()
    assert not (two.crust_mask & ~one.crust_mask).any()
    assert not (two.axis_mask & ~one.axis_mask).any()
    assert pairs(two.axis.edges) <= pairs(initial.axis.edges) & pairs(one.axis.edges)
    assert initial.crust_mask is None
    assert initial.axis_mask is None
    for s in (one, two, initial):
        assert (s.axis.lengths > 0).all()


def test_grid_axis_has_no_zero_length_edge_and_49_vertices() -> None:
    s = cz.medial_axis(np.array([(x, y) for x in range(8) for y in range(8)]), method="one-step")
    assert len(np.unique(s.diagram.vertices, axis=0)) == 49
    assert (s.axis.lengths > 0).all()


def test_quarter_turns_scales_and_offsets_change_nothing() -> None:
    points = np.round(cz.sample.uniform(300, rng=8) * 2**20)
    crust = cz.crust(points, method="one-step")
    turned = cz.crust(np.column_stack([-points[:, 1], points[:, 0]]), method="one-step")
    for other in (
        turned,
        cz.crust(points * 2.0**-300, method="one-step"),
        cz.crust(points + 2.0**40, method="one-step"),
    ):
        assert pairs(other.edges) == pairs(crust.edges)
