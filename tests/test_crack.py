"""Crack patterns: what they are made of, and that a seed means one pattern."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

import crazing as cz


def on_bounds(c: cz.Crack) -> NDArray[np.bool_]:
    xmin, ymin, xmax, ymax = c.bounds
    x, y = c.graph.vertices.T
    return (x == xmin) | (x == xmax) | (y == ymin) | (y == ymax)


@pytest.mark.parametrize("draw", [cz.sample.uniform, cz.sample.normal, cz.sample.laplace])
def test_thesis_pattern_is_the_walls_of_the_maze(draw) -> None:
    d = cz.diagram(draw(300, rng=2))
    bounds = (*d.sites.min(axis=0), *d.sites.max(axis=0))
    seed = np.random.default_rng(3)
    c = cz.crack(d, bounds=bounds, rng=3)
    walls = cz.maze(d, bounds=bounds, rng=seed).walls
    assert c.graph.length == pytest.approx(walls.length)
    assert len(c.graph.edges) == len(walls.edges)
    # A forest: no loop, whatever the distribution.
    assert len(c.graph.edges) == len(c.graph.vertices) - c.graph.components
    assert c.graph.degrees.min() == 1


def test_free_tips_taper_to_nothing_and_cut_ends_do_not() -> None:
    c = cz.crack(n=300, rng=7)
    tip = (c.graph.degrees == 1)[c.graph.edges]
    cut = on_bounds(c)[c.graph.edges]
    assert (c.width[tip & ~cut] == 0).all()
    assert (c.width[~tip | cut] > 0).all()
    assert (tip & ~cut).sum() > 20


def test_width_rises_with_strand_length_and_blunt_means_blunt() -> None:
    c = cz.crack(n=300, rng=7, width=0.01, taper=0, hierarchy=0)
    assert (c.width == 0.01).all()
    c = cz.crack(n=300, rng=7, width=0.01, taper=0, hierarchy=0.5)
    strands = int(c.strand.max()) + 1
    length = np.bincount(c.strand, c.graph.lengths, strands)
    width = np.zeros(strands)
    np.maximum.at(width, c.strand, c.width.max(axis=1))
    assert (np.diff(length) <= 1e-12).all()
    np.testing.assert_allclose(width, 0.01 * np.sqrt(length / length[0]), rtol=1e-12)


def test_strands_are_paths_and_generations_start_at_the_longest() -> None:
    c = cz.crack(n=400, opening=0.6, rng=1)
    for strand in range(int(c.strand.max()) + 1):
        g = nx.MultiGraph(c.graph.edges[c.strand == strand].tolist())
        assert nx.is_connected(g)
        assert max(dict(g.degree).values()) <= 4
    assert c.generation[c.strand == 0].tolist() == [0] * int((c.strand == 0).sum())
    assert c.generation.min() == 0
    assert c.generation.max() < 40


def test_opening_closes_loops() -> None:
    loops = []
    for opening in (0.0, 0.3, 0.6, 0.9, 1.0):
        g = cz.crack(n=500, opening=opening, rng=5).graph
        loops.append(len(g.edges) - len(g.vertices) + g.components)
    assert loops == sorted(loops, reverse=True)
    assert loops[0] > 300
    assert loops[-1] == 0


def test_a_seed_is_one_pattern() -> None:
    assert cz.crack(rng=7) == cz.crack(n=300, rng=7)
    assert cz.crack(rng=7) != cz.crack(rng=8)


@pytest.mark.parametrize("n", [2, 10, 400])
def test_plates_at_the_sides_are_as_large_as_others(n: int) -> None:
    points = cz.sample.uniform(n, bounds=(5, 5, 9, 7), rng=2)
    low, high = points.min(axis=0), points.max(axis=0)
    spacing = np.sqrt(np.prod(high - low) / n)
    margin = min(spacing / 2, 0.1 * (high - low).max())
    np.testing.assert_allclose(cz.crack(points, rng=1).bounds, (*(low - margin), *(high + margin)))


def test_points_on_a_line_have_an_area_about_them() -> None:
    assert cz.crack([(0.0, 0), (1, 0), (2, 0)], rng=1).bounds == (-0.2, -0.2, 2.2, 0.2)


def test_bounds_clip() -> None:
    c = cz.crack(cz.sample.laplace(300, rng=1), bounds=(-1, -1, 1, 1), rng=1)
    assert np.abs(c.graph.vertices).max() <= 1
    assert on_bounds(c).any()


@pytest.mark.parametrize("points", [[], [(0, 0)], [(0, 0), (1, 0)], [(0, 0), (1, 1), (2, 2)], [(3, 3)] * 5])
def test_too_few_points_make_few_cracks(points: list[tuple[float, float]]) -> None:
    c = cz.crack(points, rng=0)
    assert len(c.graph.edges) == 0


def test_points_and_n_exclude_each_other() -> None:
    with pytest.raises(ValueError, match="points and n are both given"):
        cz.crack([(0, 0), (1, 0), (0, 1)], n=5)


@pytest.mark.parametrize("anisotropy", [1.0, 2.0])
def test_points_on_a_torus_are_relaxed_and_stretched_as_in_the_plane(anisotropy: float) -> None:
    """They were refused: the box about them was no period, and bounds could not be given beside one."""
    points = cz.sample.uniform(150, bounds=(0, 0, 2, 1), rng=1)
    how = {"opening": 0.0, "period": (2.0, 1.0), "anisotropy": anisotropy, "rng": 1}
    plain, relaxed = (cz.crack(points, relax=relax, **how) for relax in (0, 4))
    assert plain.bounds == relaxed.bounds == (0, 0, 2, 1)
    # With every plate closed: Euler on a torus, e - v = cells.
    assert all(len(c.graph.edges) - len(c.graph.vertices) == 150 for c in (plain, relaxed))
    areas = [cz.measure(c).cell_cv for c in (plain, relaxed)]
    assert areas[1] < 0.6 * areas[0]


def test_points_of_ones_own_are_relaxed_where_plates_are_stretched() -> None:
    points = cz.sample.uniform(200, rng=2)
    how = {"opening": 0.0, "anisotropy": 2.0, "bounds": (0, 0, 1, 1), "rng": 1}
    plain, relaxed = (cz.measure(cz.crack(points, relax=relax, **how)) for relax in (0, 5))
    assert relaxed.cell_cv < 0.6 * plain.cell_cv


@pytest.mark.parametrize("points", [[], [(0, 0)], [(0, 0), (1, 0)], [(3, 3)] * 5])
def test_few_points_are_relaxed_to_few_cracks(points: list[tuple[float, float]]) -> None:
    assert len(cz.crack(points, relax=1, rng=0).graph.edges) == 0


def test_geometries_are_relaxed() -> None:
    points = cz.sample.uniform(50, rng=1)
    assert cz.crack(shapely.MultiPoint(points), relax=1, rng=1) == cz.crack(points, relax=1, rng=1)


@pytest.mark.parametrize("anisotropy", [1.0, 3.0])
def test_bounds_about_points_are_the_same_whether_plates_are_stretched_or_not(anisotropy: float) -> None:
    points = cz.sample.uniform(60, bounds=(5, 5, 9, 7), rng=2)
    c = cz.crack(points, anisotropy=anisotropy, angle=30, rng=1)
    assert c.bounds == cz.crack(points, rng=1).bounds
    assert on_bounds(c).any()
