"""Crusts and axes: against the literal definition on SciPy, known curves, and the laws."""

from __future__ import annotations

import pickle
from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import Delaunay, Voronoi, cKDTree

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


@pytest.mark.parametrize("order", list(permutations(("one-step", "two-pass", "edge-filter"))))
def test_what_one_method_found_serves_the_next(order: tuple[str, ...]) -> None:
    points = cz.sample.uniform(400, rng=5)
    shared = cz.diagram(points)
    for method in order:
        find = cz.crust if method == "two-pass" else cz.medial_axis
        assert find(shared, method=method) == find(points, method=method)
    assert pickle.loads(pickle.dumps(shared)) == shared


def gold_snoeyink(d: cz.Diagram) -> NDArray[np.bool_]:
    """The circle test in floating point, straight from its definition with positions t on the bisector."""
    p, q = d.sites[d.edges[:, 0]], d.sites[d.edges[:, 1]]
    normal = np.column_stack([p[:, 1] - q[:, 1], q[:, 0] - p[:, 0]]) / np.hypot(*(q - p).T)[:, None]
    middle, half = (p + q) / 2, np.hypot(*(q - p).T) / 2
    t = [((d.vertices[side] - middle) * normal).sum(axis=1) for side in d.dual_edges.T]
    hull = d.dual_edges[:, 1] < 0
    return np.where(hull, t[0] < 0, -t[0] * t[1] >= half**2)


@pytest.mark.parametrize(("n", "seed"), [*((400, seed) for seed in range(10)), (20_000, 0)])
def test_one_step_is_the_circle_test(n: int, seed: int) -> None:
    # Many are decided on all cores.
    d = cz.diagram(cz.sample.laplace(n, rng=seed))
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


def has_empty_circle(p: NDArray[np.float64], q: NDArray[np.float64], others: NDArray[np.float64]) -> bool:
    """Whether some circle through p and q holds none of the others inside: an edge of some Delaunay triangulation.

    A centre lies t half lengths off the middle, to the left; every other point bounds t from one side.
    """
    half = (q - p) / 2
    along, across = np.transpose((others - (p + q) / 2) @ np.column_stack([half, [-half[1], half[0]]])) / (half @ half)
    off = np.abs(across) > 1e-12
    if (np.abs(along[~off]) < 1 - 1e-12).any():
        return False
    bounds = (along[off] ** 2 + across[off] ** 2 - 1) / (2 * across[off])
    above, below = bounds[across[off] > 0], bounds[across[off] < 0]
    return bool(below.max(initial=-np.inf) <= above.min(initial=np.inf) + 1e-9)


@settings(max_examples=60, deadline=None)
@example(n=37, seed=37, snap=True)
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
    assert pairs(two.axis.edges) <= pairs(one.axis.edges)
    # The edge filter keeps every tie, a triangulation one of the diagonals.
    cloud = np.vstack([d.sites, np.unique(d.vertices, axis=0)])
    for row in pairs(two.axis.edges) - pairs(initial.axis.edges):
        p, q = d.vertices[list(row)]
        assert snap
        assert has_empty_circle(p, q, cloud[(cloud != p).any(axis=1) & (cloud != q).any(axis=1)])
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


def angles_of(d: cz.Diagram) -> NDArray[np.float64]:
    """For every edge the larger of the angles opposite it, in radians."""
    largest = np.zeros(len(d.edges))
    for side in d.dual_edges.T:
        corners = d.triangles[side]
        apex = np.where((corners[:, :, None] == d.edges[:, None, :]).any(axis=2), 0, corners).sum(axis=1)
        apex[side < 0] = 0
        a, b = (d.sites[d.edges[:, end]] - d.sites[apex] for end in (0, 1))
        angle = np.arctan2(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]), (a * b).sum(axis=1))
        largest = np.where(side >= 0, np.maximum(largest, angle), largest)
    return largest


@pytest.mark.parametrize("seed", range(5))
def test_gabriel_edges_are_those_whose_circle_is_empty(seed: int) -> None:
    d = cz.diagram(cz.sample.uniform(300, rng=seed))
    middle = d.sites[d.edges].mean(axis=1)
    distance, _ = cKDTree(d.sites).query(middle)
    empty = distance > 0.5 * d.delaunay.lengths * (1 - 1e-12)
    assert pairs(cz.crust(d, method="gabriel").edges) == pairs(d.edges[empty])
    assert pairs(d.edges[angles_of(d) <= np.pi / 2]) == pairs(d.edges[empty])


@pytest.mark.parametrize("seed", range(5))
def test_nn_is_dey_and_kumars_algorithm(seed: int) -> None:
    d = cz.diagram(cz.sample.uniform(200, rng=seed))
    neighbours: dict[int, list[int]] = {i: [] for i in range(len(d.sites))}
    for a, b in d.edges.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    expected = set()
    for p, others in neighbours.items():
        step = {q: d.sites[q] - d.sites[p] for q in others}
        q = min(others, key=lambda q: np.hypot(*step[q]))
        beyond = [s for s in others if step[s] @ step[q] < 0]
        for s in [q, *sorted(beyond, key=lambda s: np.hypot(*step[s]))[:1]]:
            expected.add((min(p, s), max(p, s)))
    assert pairs(cz.crust(d, method="nn").edges) == expected


@pytest.mark.parametrize("seed", range(5))
def test_poles_are_the_farthest_vertices(seed: int) -> None:
    d = cz.diagram(cz.sample.uniform(100, rng=seed))
    hull = set(d.edges[d.dual_edges[:, 1] < 0].ravel().tolist())
    thesis, amenta = (cz.poles(d, variant=variant) for variant in ("thesis", "amenta"))
    for site in range(len(d.sites)):
        corners = np.flatnonzero((d.triangles == site).any(axis=1))
        step = d.vertices[corners] - d.sites[site]
        first = np.argmax(np.hypot(*step.T))
        along = step @ step[first]
        second = np.argmin(along) if len(corners) > 1 else None
        assert thesis[site].tolist() == [corners[first], -1 if second is None else corners[second]]
        if site in hull:
            assert amenta[site, 0] == -1
            continue
        behind = np.where(along < 0, np.hypot(*step.T), -1)
        assert amenta[site].tolist() == [corners[first], corners[np.argmax(behind)] if behind.max() > 0 else -1]


@pytest.mark.parametrize("variant", ["thesis", "amenta"])
def test_axis_of_poles_joins_poles(variant: str) -> None:
    d = cz.diagram(flower(300))
    s = cz.medial_axis(d, method="poles", variant=variant)
    poles = cz.poles(d, variant=variant)
    assert set(s.axis.edges.ravel().tolist()) <= set(poles.ravel().tolist()) - {-1}
    assert s.crust_mask is None
    assert s.axis_mask is None
    assert len(s.crust.edges) == 300
    # The same edges by the definition, on SciPy.
    used = np.unique(poles[poles >= 0])
    simplices = Delaunay(np.vstack([d.sites, d.vertices[used]])).simplices
    edges = np.vstack([simplices[:, [0, 1]], simplices[:, [1, 2]], simplices[:, [2, 0]]])
    expected = pairs(used[edges[(edges >= 300).all(axis=1)] - 300])
    assert len(pairs(s.axis.edges) ^ expected) <= 0.01 * len(expected)


@pytest.mark.parametrize("method", ["initial", "poles", "edge-filter", "one-step"])
def test_nested_skeletons_grow_by_their_vertices(method: str) -> None:
    points = cz.sample.uniform(75, rng=2)
    everywhere = (-np.inf, -np.inf, np.inf, np.inf)
    free = cz.nested(points, iterations=3, method=method, bounds=everywhere)
    for before, after in pairwise(free):
        assert len(after.diagram.sites) == len(before.diagram.sites) + len(before.diagram.vertices)
    assert free[0] == cz.medial_axis(points, method=method)
    for default in cz.nested(points, iterations=3, method=method):
        low, high = points.min(axis=0), points.max(axis=0)
        margin = (high - low) / 2 * (1 + 1e-12)
        assert (default.diagram.sites >= low - margin).all()
        assert (default.diagram.sites <= high + margin).all()
        assert default.method == method


def test_nested_of_a_grid_feeds_each_vertex_back_once() -> None:
    first, second = cz.nested(np.array([(x, y) for x in range(8) for y in range(8)]), iterations=2, bounds=(0, 0, 7, 3))
    assert len(second.diagram.sites) == len(first.diagram.sites) + 7 * 3


def test_nested_refuses_nonsense() -> None:
    for iterations in (0, -1):
        with pytest.raises(ValueError, match="iterations is"):
            cz.nested(flower(30), iterations=iterations)
    for bounds in ((0, 0, 0, 1), (0, 0, np.nan, 1), (0, 0, 1)):
        with pytest.raises(ValueError, match="bounds"):
            cz.nested(flower(30), iterations=2, bounds=bounds)


@pytest.mark.parametrize(
    "points", [flower(3000), np.indices((40, 30)).reshape(2, -1).T / 7, flower(3)], ids=["curve", "grid", "triangle"]
)
def test_what_was_found_before_changes_nothing(points: NDArray[np.float64]) -> None:
    first = cz.medial_axis(cz.diagram(points), method="one-step")
    known = cz.diagram(points)
    crusts = [cz.crust(known, method="one-step"), cz.crust(known, method="two-pass")]
    again = cz.medial_axis(known, method="one-step")
    assert np.array_equal(first.crust.edges, crusts[0].edges)
    for one, other in ((first.crust, again.crust), (first.axis, again.axis)):
        assert np.array_equal(one.edges, other.edges)
    assert np.array_equal(first.axis_mask, again.axis_mask)
    alone, after = (cz.medial_axis(diagram, method="edge-filter") for diagram in (cz.diagram(points), known))
    assert np.array_equal(alone.crust.edges, crusts[1].edges)
    assert np.array_equal(alone.axis.edges, after.axis.edges)
