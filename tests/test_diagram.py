"""Diagrams against SciPy, the laws through Python, and what a user holds."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray
from scipy.spatial import Delaunay, Voronoi

import crazing as cz

Points = NDArray[np.float64]
lattices = hnp.arrays(np.int64, st.tuples(st.integers(0, 25), st.just(2)), elements=st.integers(-4, 4))
floats = hnp.arrays(
    np.float64,
    st.tuples(st.integers(0, 40), st.just(2)),
    elements=st.floats(allow_nan=False, allow_infinity=False),
)


def pairs(edges: NDArray[np.int32]) -> set[tuple[int, int]]:
    return {(min(a, b), max(a, b)) for a, b in edges.tolist()}


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize("draw", [cz.sample.uniform, cz.sample.normal, cz.sample.laplace])
def test_edges_triangles_and_vertices_are_scipys(draw, seed: int) -> None:
    points = draw(300, rng=seed)
    d = cz.diagram(points)
    theirs = Delaunay(points)
    assert {frozenset(t) for t in d.triangles.tolist()} == {frozenset(t) for t in theirs.simplices.tolist()}
    ridges = Voronoi(points)
    assert pairs(d.edges) == pairs(ridges.ridge_points)
    assert (d.dual_edges < 0).sum() == sum(-1 in r for r in ridges.ridge_vertices)
    order = np.lexsort(np.round(d.vertices, 6).T)
    other = np.lexsort(np.round(ridges.vertices, 6).T)
    scale = 1 + np.abs(ridges.vertices[other]).max(axis=1, keepdims=True)
    assert (np.abs(d.vertices[order] - ridges.vertices[other]) / scale).max() < 1e-4


def test_alignments() -> None:
    d = cz.diagram(cz.sample.uniform(500, rng=3))
    corners = d.sites[d.triangles]
    radii = np.linalg.norm(corners - d.vertices[:, None], axis=2)
    np.testing.assert_allclose(radii, radii[:, :1] * np.ones(3), rtol=1e-9)
    for (p, q), duals in zip(d.edges.tolist(), d.dual_edges.tolist(), strict=True):
        assert all({p, q} <= set(d.triangles[t].tolist()) for t in duals if t >= 0)
    assert len(d.sites) + len(d.triangles) - len(d.edges) == 1
    assert d.shifts.shape == d.edges.shape
    assert not d.shifts.any()


def test_utm_offset_keeps_every_vertex() -> None:
    # SciPy keeps 2 of these: spread of a metre at an offset of thousands of kilometres.
    points = cz.sample.uniform(400, bounds=(500000, 4600000, 500001, 4600001), rng=5)
    d = cz.diagram(points)
    assert len(d.sites) + len(d.triangles) - len(d.edges) == 1
    assert len(np.unique(d.vertices, axis=0)) == len(d.triangles)


@settings(max_examples=150, deadline=None)
@given(points=st.one_of(lattices, floats))
def test_any_input_gives_a_diagram(points: Points) -> None:
    d = cz.diagram(points)
    assert len(d.site_of) == len(points)
    assert len(d.sites) + len(d.triangles) - len(d.edges) == (1 if len(d.sites) else 0)
    assert np.isfinite(d.vertices).all()
    quad = d.quad_edge
    q = quad.all
    np.testing.assert_array_equal(quad.rot(quad.onext(quad.rot(quad.onext(q)))), q)
    np.testing.assert_array_equal(quad.rot(quad.rot(q)), quad.sym(q))
    np.testing.assert_array_equal(quad.origin(quad.onext(q)), quad.origin(q))


@settings(max_examples=60, deadline=None)
@given(points=lattices, seed=st.integers(0, 2**32 - 1))
def test_order_of_rows_changes_only_numbers(points: Points, seed: int) -> None:
    order = np.random.default_rng(seed).permutation(len(points))
    a, b = cz.diagram(points), cz.diagram(np.asarray(points)[order])

    def segments(d: cz.Diagram) -> set[frozenset[tuple[float, ...]]]:
        return {frozenset(map(tuple, ends)) for ends in d.sites[d.edges].tolist()}

    assert segments(a) == segments(b)


def test_voronoi_is_clipped_and_agrees_with_scipy() -> None:
    points = cz.sample.uniform(200, rng=9)
    d = cz.diagram(points)
    wide = d.voronoi((-1e6, -1e6, 1e6, 1e6))
    theirs = Voronoi(points)
    finite = np.array([r for r in theirs.ridge_vertices if -1 not in r])
    expected = np.linalg.norm(np.diff(theirs.vertices[finite], axis=1), axis=2).sum()
    ours = wide.lengths[(wide.edges < len(d.vertices)).all(axis=1)].sum()
    assert ours == pytest.approx(expected, rel=1e-6)
    unit = d.voronoi((0, 0, 1, 1))
    used = unit.vertices[np.unique(unit.edges)]
    assert used.min() >= -1e-12
    assert used.max() <= 1 + 1e-12


def test_cell_of_a_clipped_diagram_measures_the_square() -> None:
    # Each cell boundary of two points on a line through the square: the bisector cuts it in half.
    g = cz.diagram([(0.25, 0.5), (0.75, 0.5)]).voronoi((0, 0, 1, 1))
    np.testing.assert_allclose(np.sort(g.segments[0][:, 1]), [0, 1])
    np.testing.assert_allclose(g.segments[0][:, 0], 0.5)


def test_results_are_read_only_compare_and_pickle() -> None:
    d = cz.diagram(cz.sample.uniform(50, rng=1))
    again = pickle.loads(pickle.dumps(d))
    assert again == d
    assert copy.deepcopy(d) == d
    assert d != cz.diagram(cz.sample.uniform(50, rng=2))
    for array in (*d.arrays, *again.arrays, d.site_of):
        with pytest.raises(ValueError, match="read-only"):
            array[:1] = 0
    assert repr(d) == f"Diagram(50 sites, {len(d.edges)} edges, {len(d.triangles)} triangles)"


def test_input_is_not_frozen() -> None:
    points = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    cz.diagram(points)
    points[0] = 5.0


def test_a_made_up_diagram_is_refused_or_survived() -> None:
    d = cz.diagram(cz.sample.uniform(30, rng=4))
    wild = cz.Diagram(d.sites, d.site_of, d.triangles, d.vertices, d.edges + 1000, d.dual_edges)
    with pytest.raises(cz.CrazingError, match=r"edges\[0\] is"):
        cz.maze(wild)
    twisted = cz.Diagram(d.sites, d.site_of, d.triangles, d.vertices, d.edges[::-1], d.dual_edges)
    with pytest.raises(cz.CrazingError, match="contradicts"):
        _ = twisted.quad_edge
    cz.medial_axis(twisted, method="one-step")
    cz.maze(twisted, rng=1)
