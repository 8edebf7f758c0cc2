"""Diagrams with constraints: the edges are there, the rest is Delaunay, and what cannot be is named."""

from __future__ import annotations

import time
from collections import Counter
from itertools import combinations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz


def crosses(points: np.ndarray, a: tuple[int, int], b: tuple[int, int]) -> bool:
    """Whether two segments share more than a point that is an end of one of them."""
    s, t = (shapely.LineString(points[list(ends)]) for ends in (a, b))
    met = shapely.intersection(s, t)
    if met.is_empty:
        return False
    return met.length > 0 or not any(met.equals(shapely.Point(points[i])) for i in (*a, *b))


def check(points: np.ndarray, constraints: list[tuple[int, int]], d: cz.Diagram) -> None:
    assert len(d.sites) + len(d.triangles) - len(d.edges) == 1
    whole = shapely.union_all([shapely.LineString(points[list(ends)]) for ends in constraints])
    kept = shapely.union_all(shapely.linestrings(d.sites[d.edges[d.constrained]]))
    assert whole.length == pytest.approx(kept.length) and whole.buffer(1e-9).covers(kept)
    # Edges without a constraint are locally Delaunay, which makes a constrained triangulation the one of Chew.
    for k in np.flatnonzero(~d.constrained & (d.dual_edges >= 0).all(axis=1)):
        right, left = d.dual_edges[k]
        apex = next(i for i in d.triangles[left] if i not in d.edges[k])
        radius = np.linalg.norm(d.sites[d.triangles[right][0]] - d.vertices[right])
        assert np.linalg.norm(d.sites[apex] - d.vertices[right]) >= radius * (1 - 1e-7)
    corners = d.sites[d.triangles]
    ahead, back = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas = (ahead[:, 0] * back[:, 1] - ahead[:, 1] * back[:, 0]) / 2
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(shapely.MultiPoint(points).convex_hull.area)
    quad = d.quad_edge
    np.testing.assert_array_equal(quad.rot(quad.onext(quad.rot(quad.onext(quad.all)))), quad.all)


lattices = st.lists(st.tuples(st.integers(0, 7), st.integers(0, 7)), min_size=4, max_size=24, unique=True)


@settings(max_examples=80, deadline=None)
@given(rows=lattices, seed=st.integers(0, 10**6), wanted=st.integers(1, 12))
def test_constraints_are_edges_or_two_that_cross_are_named(rows: list, seed: int, wanted: int) -> None:
    points = np.array(rows, dtype=float)
    rng = np.random.default_rng(seed)
    pairs = list(combinations(range(len(points)), 2))
    constraints = [pairs[i] for i in rng.choice(len(pairs), min(wanted, len(pairs)), replace=False)]
    bad = {frozenset((a, b)) for a, b in combinations(constraints, 2) if crosses(points, a, b)}
    if bad:
        with pytest.raises(cz.CrazingError, match="crosses or overlaps") as caught:
            cz.diagram(points, constraints=constraints)
        named = [
            int(word)
            for word in str(caught.value).replace("(", " ").replace(")", " ").replace(",", " ").split()
            if word.isdigit()
        ]
        assert frozenset((tuple(named[:2]), tuple(named[2:]))) in bad
        return
    d = cz.diagram(points, constraints=constraints)
    if len(d.triangles):
        check(points, constraints, d)
    else:
        assert d.constrained.any()


def test_constraints_that_are_edges_already_change_nothing() -> None:
    points = cz.sample.uniform(300, rng=1)
    plain = cz.diagram(points)
    some = cz.diagram(points, constraints=plain.edges[::7])
    for name in ("triangles", "edges", "dual_edges", "vertices"):
        np.testing.assert_array_equal(getattr(some, name), getattr(plain, name))
    assert np.flatnonzero(some.constrained).tolist() == list(range(0, len(plain.edges), 7))
    assert not plain.constrained.any()


def test_ten_thousand_constraints_in_a_comb_and_a_fan() -> None:
    rows = np.arange(10_000)
    x = np.repeat(np.arange(100.0), 100)
    feet = np.column_stack([x, np.tile(2.0 * np.arange(100), 100)])
    teeth = np.concatenate([feet, feet + np.array([0.5, 1.5])])
    among = np.column_stack([rows, rows + 10_000])
    d = cz.diagram(teeth, constraints=among)
    assert int(d.constrained.sum()) == 10_000
    turn = rows / 10_000 * 2 * np.pi
    wheel = np.vstack([np.column_stack([np.cos(turn), np.sin(turn)]), (0.0, 0.0)])
    spokes = np.column_stack([rows, np.full(10_000, 10_000)])
    assert int(cz.diagram(wheel, constraints=spokes).constrained.sum()) == 10_000
    with pytest.raises(cz.CrazingError, match=r"constraint \(\d+, \d+\) crosses or overlaps constraint \(0, 19999\)"):
        cz.diagram(teeth, constraints=np.concatenate([among, [[0, 19_999]]]))


def test_a_fan_across_a_ladder_is_inserted_in_far_less_than_its_square() -> None:
    n = 4000
    along = np.arange(n, dtype=float)
    rails = [np.column_stack([along, np.full(n, side)]) for side in (1.0, -1.0)]
    ends = np.column_stack([np.full(n, n + 1.0), np.linspace(-0.5, 0.5, n)])
    points = np.vstack([*rails, (-1.0, 0.0), ends])
    fan = np.column_stack([np.full(n, 2 * n), 2 * n + 1 + np.arange(n)])

    def cost(constraints) -> float:
        start = time.process_time()
        d = cz.diagram(points, constraints=constraints)
        assert set(map(tuple, np.sort(constraints, axis=1))) <= set(map(tuple, np.sort(d.edges[d.constrained], axis=1)))
        return time.process_time() - start

    # In the order of the fan it took some hundred times what a tenth of it did.
    assert cost(fan) < 60 * max(cost(fan[::10]), 0.02)


def test_chains_of_rows_are_constraints_and_rings_close() -> None:
    points = cz.sample.uniform(200, bounds=(0, 0, 1, 1), rng=3)
    square = [(-1.0, -1.0), (2.0, -1.0), (2.0, 2.0), (-1.0, 2.0)]
    rows = np.concatenate([square, points])
    by_chain = cz.diagram(rows, constraints=[[0, 1, 2, 3, 0]])
    assert by_chain == cz.diagram(rows, constraints=[(0, 1), (1, 2), (2, 3), (3, 0)])
    assert by_chain == cz.diagram(rows, constraints=[[0, 1, 2], [2, 3, 0]])
    assert Counter(by_chain.constrained.tolist())[True] == 4


def test_a_constraint_through_sites_and_one_between_copies() -> None:
    d = cz.diagram([(0, 0), (1, 0), (2, 0), (3, 0), (1, 2), (1, -2), (0, 0)], constraints=[(6, 3)])
    assert sorted(map(sorted, d.edges[d.constrained].tolist())) == [[0, 1], [1, 2], [2, 3]]
    line = cz.diagram([(float(i), 0.0) for i in range(6)], constraints=[(1, 4)])
    assert line.edges[line.constrained].tolist() == [[1, 2], [2, 3], [3, 4]]


BAD = {
    "a loop": ([(1, 1)], cz.CrazingError, r"constraints\[0\] is \(1, 1\), one place"),
    "copies": ([(0, 4)], cz.CrazingError, r"constraints\[0\] is \(0, 4\), one place"),
    "no row": ([(0, 9)], ValueError, r"constraints\[0\] is \(0, 9\); indices from 0"),
    "crossing": ([(0, 2), (1, 3)], cz.CrazingError, r"constraint \(0, 2\) crosses or overlaps constraint \(1, 3\)"),
    "twice": ([(0, 2), (2, 0)], cz.CrazingError, "crosses or overlaps"),
    "fractions": ([(0.5, 1.5)], TypeError, "constraints has dtype float64"),
    "one number": (3, ValueError, "constraints"),
    "triangles": (np.zeros((2, 3, 2), dtype=int), ValueError, "constraints"),
}


@pytest.mark.parametrize("name", BAD)
def test_bad_constraints_are_named(name: str) -> None:
    constraints, error, message = BAD[name]
    with pytest.raises(error, match=message):
        cz.diagram([(0, 0), (1, 0), (1, 1), (0, 1), (0, 0)], constraints=constraints)


def test_what_needs_a_voronoi_diagram_refuses_one_with_constraints() -> None:
    d = cz.diagram([(0, 0), (2, -1), (4, 0), (2, 1)], constraints=[(0, 2)])
    for call in (cz.crust, cz.medial_axis, cz.maze, lambda d: d.voronoi()):
        with pytest.raises(ValueError, match="constraints"):
            call(d)
    assert len(cz.maze(d, cells="delaunay", rng=1).passages) == 1
    with pytest.raises(ValueError, match="constraints and period"):
        cz.diagram([(0, 0), (1, 0), (0, 1)], constraints=[(0, 1)], period=(2, 2))


def test_no_constraints_are_none() -> None:
    points = cz.sample.uniform(30, rng=1)
    assert cz.diagram(points, constraints=[]) == cz.diagram(points)
