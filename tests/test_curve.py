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


def crossings(vertices: NDArray[np.float64], edges: NDArray[np.int32]) -> int:
    """Pairs of edges with a point in common that is the end of neither, each pair held to each."""
    first, second = (vertices[edges[index]] for index in np.triu_indices(len(edges), 1))

    def side(line: NDArray[np.float64], point: NDArray[np.float64]) -> NDArray[np.float64]:
        along, aside = line[:, 1] - line[:, 0], point - line[:, 0]
        return np.sign(along[:, 0] * aside[:, 1] - along[:, 1] * aside[:, 0])

    apart = [side(a, b[:, 0]) * side(a, b[:, 1]) for a, b in ((first, second), (second, first))]
    return int(((apart[0] < 0) & (apart[1] < 0)).sum())


def test_a_curve_may_pass_across_edges_of_the_diagram() -> None:
    across = 0
    for seed in range(4):
        d = cz.diagram(cz.sample.uniform(400, rng=seed))
        graph = cz.curve(d)
        across += len(pairs(graph.edges) - pairs(d.edges))
        assert crossings(graph.vertices, graph.edges) == 0
        assert graph.degrees.max() <= 2
    assert across > 10


@settings(max_examples=60, deadline=None)
@given(n=st.integers(3, 60), seed=st.integers(0, 10**6), snap=st.booleans())
def test_a_curve_is_a_manifold_without_crossings(n: int, seed: int, snap: bool) -> None:
    points = cz.sample.uniform(n, rng=seed)
    d = cz.diagram(np.round(points * 6) if snap else points)
    if not len(d.triangles):
        with pytest.raises(cz.DegenerateInputError):
            cz.curve(d)
        return
    graph = cz.curve(d)
    assert graph.degrees.max(initial=0) <= 2
    delaunay = pairs(d.edges)
    across = np.array([pair not in delaunay for pair in map(tuple, np.sort(graph.edges, axis=1).tolist())], dtype=bool)
    assert not (across[:-1] & ~across[1:]).any(), "those across come last"
    assert crossings(d.sites, graph.edges) == 0
    assert graph == cz.curve(d)


def test_the_unit_does_not_matter() -> None:
    points = sampled([(0, 1), (4, 0), (0, -1)], 30)
    for scale in (2.0**-300, 2.0**20, 2.0**300):
        assert pairs(cz.curve(points * scale).edges) == ring(len(points))


@pytest.mark.parametrize("n", [300, 900])
def test_the_order_of_the_samples_does_not_matter_nor_a_quarter_turn(n: int) -> None:
    # Points on no curve are amiss everywhere: the search for better edges has its say at all of them.
    points = np.random.default_rng(n).random((n, 2))
    expected = pairs(cz.curve(points).edges)
    order = np.random.default_rng(1).permutation(n)
    assert pairs(order[cz.curve(points[order]).edges]) == expected
    for turned in (points[:, ::-1] * (-1, 1), points * (-1, 1), points * 1024):
        assert pairs(cz.curve(turned).edges) == expected
