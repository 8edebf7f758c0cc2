"""Diagrams and mazes on a torus: law 10 with SciPy as the witness, and pictures that tile."""

from __future__ import annotations

import pickle

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import crazing as cz

Edge = tuple[int, int, int, int]


def lowest(a: int, b: int, dx: int, dy: int) -> Edge:
    return min((a, b, dx, dy), (b, a, -dx, -dy))


def edges(d: cz.Diagram) -> list[Edge]:
    return sorted(lowest(*row) for row in np.hstack([d.edges, d.shifts]).tolist())


def by_copies(points: NDArray[np.float64], period: tuple[float, float]) -> set[Edge]:
    """The edges that SciPy finds at the middle one of 3 x 3 copies."""
    shifts = sorted(((a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)), key=lambda s: s != (0, 0))
    copies = np.vstack([points + np.multiply(s, period) for s in shifts])
    found = set()
    n = len(points)
    for triangle in Delaunay(copies).simplices.tolist():
        for i, j in zip(triangle, triangle[1:] + triangle[:1], strict=True):
            if min(i, j) < n:
                (a, b), (c, e) = shifts[i // n], shifts[j // n]
                found.add(lowest(i % n, j % n, c - a, e - b))
    return found


@settings(max_examples=60, deadline=None)
@given(n=st.integers(1, 400), seed=st.integers(0, 10**6), height=st.sampled_from([1.0, 0.25, 3.0]))
def test_law_10_by_scipy(n: int, seed: int, height: float) -> None:
    period = (1.0, height)
    # Far from a grid, so that there is no tie for SciPy to decide.
    points = cz.sample.uniform(n, bounds=(0, 0, *period), rng=seed)
    d = cz.diagram(points, period=period)
    if n > 1:  # Copies of one site are a lattice.
        assert edges(d) == sorted(by_copies(points, period))
    assert len(d.sites) + len(d.triangles) == len(d.edges)
    assert (d.dual_edges >= 0).all()
    np.testing.assert_allclose(d.sites, points, atol=1e-15)


@pytest.mark.parametrize("draw", [cz.sample.normal, cz.sample.laplace])
def test_points_from_anywhere_are_moved_into_the_period(draw) -> None:
    points = draw(2000, rng=3)
    d = cz.diagram(points, period=(2.0, 3.0))
    assert edges(d) == sorted(by_copies(np.mod(points, (2.0, 3.0)), (2.0, 3.0)))
    for inside in (d.sites, d.vertices):
        assert (inside >= 0).all() and (inside < (2.0, 3.0)).all()


@pytest.mark.parametrize("centre", [(0.0, 0.0), (20.0, 20.0), (0.0, 13.0)])
@pytest.mark.parametrize("draw", [cz.sample.normal, cz.sample.laplace])
def test_points_heaped_up_in_a_wide_period(draw, centre: tuple[float, float]) -> None:
    points = np.mod(draw(3000, rng=4) + centre, 40.0)
    d = cz.diagram(points, period=(40, 40))
    assert edges(d) == sorted(by_copies(points, (40.0, 40.0)))


def test_alignments() -> None:
    d = cz.diagram(cz.sample.uniform(500, rng=3), period=(1, 1))
    apart = d.sites[d.triangles] - d.vertices[:, None]
    radii = np.linalg.norm(apart - np.rint(apart), axis=2)  # Small beside the period here.
    np.testing.assert_allclose(radii, radii[:, :1] * np.ones(3), rtol=1e-9)
    for (p, q), duals in zip(d.edges.tolist(), d.dual_edges.tolist(), strict=True):
        assert all({p, q} <= set(d.triangles[t].tolist()) for t in duals)
    step = d.sites[d.edges[:, 1]] + d.shifts - d.sites[d.edges[:, 0]]
    dual = d.vertices[d.dual_edges[:, 1]] + d.dual_shifts - d.vertices[d.dual_edges[:, 0]]
    assert np.abs((step * dual).sum(axis=1)).max() < 1e-12
    assert (step[:, 0] * dual[:, 1] - step[:, 1] * dual[:, 0] >= 0).all()
    area = np.abs(step[:, 0] * dual[:, 1] - step[:, 1] * dual[:, 0]).sum() / 2
    assert area == pytest.approx(1.0)  # The kites of edges and dual edges pave the torus.


@pytest.mark.parametrize("side", [1, 2, 3, 8, 30])
def test_lattices_aligned_with_the_period(side: int) -> None:
    points = [(x, y) for x in range(side) for y in range(side)]
    d = cz.diagram(points, period=(side, side))
    assert len(d.edges) == 3 * side**2
    step = d.sites[d.edges[:, 1]] + side * d.shifts - d.sites[d.edges[:, 0]]
    assert set(map(tuple, np.abs(step).tolist())) == {(0, 1), (1, 0), (1, 1)}
    assert (step.prod(axis=1) >= 0).all(), "every diagonal rises"
    m = cz.maze(d, rng=1)
    assert len(m.passages) == side**2 - 1
    assert not m.open[step.prod(axis=1) != 0].any(), "no door through a corner"


def test_without_a_period_nothing_crosses_and_a_periodic_record_pickles() -> None:
    plane = cz.diagram(cz.sample.uniform(9, rng=1))
    assert plane.period is None and not plane.shifts.any() and not plane.dual_shifts.any()
    torus = cz.diagram(plane.sites, period=(1, 1))
    assert pickle.loads(pickle.dumps(torus)) == torus != plane
    assert (torus.period, torus.shifts.dtype, torus.shifts.shape) == ((1.0, 1.0), np.int8, torus.edges.shape)


def crossings(walls: cz.PlanarGraph, axis: int, side: float) -> list[float]:
    used = walls.vertices[np.unique(walls.edges)]
    return sorted(used[used[:, axis] == side][:, 1 - axis].tolist())


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
@pytest.mark.parametrize("n", [1, 3, 40, 900])
def test_walls_tile(cells: str, n: int) -> None:
    m = cz.maze(cz.sample.uniform(n, bounds=(0, 0, 2, 1), rng=n), cells=cells, period=(2, 1), rng=n)
    assert m.bounds == (0.0, 0.0, 2.0, 1.0)
    walls = m.walls
    assert (walls.vertices >= 0).all() and (walls.vertices <= (2, 1)).all()
    for axis, side in ((0, 2.0), (1, 1.0)):
        assert crossings(walls, axis, 0.0) == crossings(walls, axis, side)
    d, shut = m.diagram, ~m.open
    if cells == "voronoi":
        step = d.vertices[d.dual_edges[:, 1]] + d.dual_shifts * d.period - d.vertices[d.dual_edges[:, 0]]
    else:
        step = d.sites[d.edges[:, 1]] + d.shifts * d.period - d.sites[d.edges[:, 0]]
    assert walls.length == pytest.approx(np.linalg.norm(step[shut], axis=1).sum())


def test_ways_go_round_the_torus() -> None:
    m = cz.maze(cz.sample.uniform(900, rng=1), period=(1, 1), rng=4)
    tree = nx.Graph(m.passages.tolist())
    assert nx.is_tree(tree) and len(tree) == 900
    assert m.diagram.shifts[m.open].any(), "a passage crosses the seam"
    a, b = m.longest()[[0, -1]].tolist()
    assert len(m.solve(a, b)) == len(m.longest())


def test_drawings_of_one_period_have_every_edge_once() -> None:
    d = cz.diagram(cz.sample.uniform(50, rng=2), period=(1, 1))
    step = d.sites[d.edges[:, 1]] + d.shifts - d.sites[d.edges[:, 0]]
    assert d.delaunay.length == pytest.approx(np.linalg.norm(step, axis=1).sum())
    dual = d.vertices[d.dual_edges[:, 1]] + d.dual_shifts - d.vertices[d.dual_edges[:, 0]]
    assert d.voronoi().length == pytest.approx(np.linalg.norm(dual, axis=1).sum())
