"""Measuring on a torus: what one period measures is what the middle one of 3 x 3 copies measures in the plane."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import crazing as cz

PERIOD = (1.0, 0.75)


def unwrapped(c: cz.Crack) -> cz.PlanarGraph:
    """3 x 3 copies as one drawing of the plane, from (0, 0) to three periods."""
    vertices = len(c.graph.vertices)
    copies = np.array([(i, j) for i in range(3) for j in range(3)])
    places = np.concatenate([c.graph.vertices + copy * PERIOD for copy in copies])
    ends = []
    for copy in copies:
        to = copy + c.shifts.astype(int)
        # What leaves the 3 x 3 is cut off: it is far from the middle.
        inside = ((to >= 0) & (to < 3)).all(axis=1)
        first = c.graph.edges[inside, 0] + vertices * (copy[0] * 3 + copy[1])
        last = c.graph.edges[inside, 1] + vertices * (to[inside, 0] * 3 + to[inside, 1])
        ends.append(np.column_stack([first, last]))
    return cz.PlanarGraph(places, np.concatenate(ends))


@pytest.mark.parametrize(
    "how",
    [
        {"opening": 0.0},
        {"opening": 0.7, "rounds": 3, "roughness": 0.03},
        {"opening": 0.5, "rounds": 3, "stubs": 0.5},
        {"generator": "splitting"},
        {"generator": "impact"},
    ],
)
def test_nodes_and_angles_are_those_of_the_middle_copy(how) -> None:
    c = cz.crack(n=80, period=PERIOD, rng=3, **how)
    torus = cz.measure(c, reach=0.004)
    width, height = PERIOD
    middle = cz.measure(
        unwrapped(c), bounds=(width - height, 0, 2 * width + height, 3 * height), border=height, reach=0.004
    )
    # Only nodes at least one height from these bounds count: those of the middle copy.
    assert (torus.nodes, torus.junctions) == (middle.nodes, middle.junctions) and torus.junctions > 20
    for name in ("i_nodes", "y_nodes", "x_nodes", "mean_degree", "connections_per_branch", "t_share", "near_right"):
        assert getattr(torus, name) == pytest.approx(getattr(middle, name), nan_ok=True), name
    for name in ("near_even", "angle_sd", "largest_angle", "smallest_angle", "mosaic_n", "mosaic_v"):
        assert getattr(torus, name) == pytest.approx(getattr(middle, name), nan_ok=True), name


@pytest.mark.parametrize("how", [{"opening": 0.0}, {"opening": 0.5, "rounds": 3, "roughness": 0.05}, {"stubs": 1.0}])
def test_cells_of_a_connected_pattern_share_out_the_period(how) -> None:
    for seed in range(3):
        c = cz.crack(n=60, period=PERIOD, rng=seed, **{"generator": "maze", "opening": 0.3, **how})
        found = cz.measure(c)
        assert found.components == 1
        assert found.cells * found.cell_area == pytest.approx(PERIOD[0] * PERIOD[1], rel=1e-12)
        # Euler on a torus: vertices - edges + cells = 0.
        assert found.loops == found.cells + 1
        assert found.length == pytest.approx(np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T).sum())


def boxes_by_points(drawing: cz.PlanarGraph, corner: np.ndarray, size: np.ndarray, smallest: float) -> float:
    """Slope of log boxes over log size, of points a hundredth of the smallest box apart on every edge."""
    ends = drawing.segments - corner
    near = ((ends.max(axis=1) >= 0) & (ends.min(axis=1) <= size)).all(axis=1)
    steps = [np.linspace(0, 1, 2 + int(100 * np.hypot(*(b - a)) / smallest))[:, None] for a, b in ends[near]]
    points = np.concatenate([a + step * (b - a) for step, (a, b) in zip(steps, ends[near], strict=True)])
    counts = []
    for side in smallest * 2.0 ** np.arange(5):
        met = np.floor(points / side)
        whole = ((met >= 0) & ((met + 1) * side <= size)).all(axis=1)
        counts.append(len(np.unique(met[whole] @ (1, 1j))))
    return float(-np.polyfit(np.arange(5), np.log2(counts), 1)[0])


@pytest.mark.parametrize("seed", range(3))
def test_boxes_are_those_of_one_period_whichever_way_edges_run(seed: int) -> None:
    c = cz.crack(n=40, period=PERIOD, opening=0.5, rng=seed)
    found = cz.measure(c)
    lowest, period = c.graph.vertices[np.unique(c.graph.edges)].min(axis=0), np.array(PERIOD)
    by_points = boxes_by_points(unwrapped(c), lowest + period, period, found.segment_length / 16)
    # A box that an edge only just clips may lie between two points.
    assert found.box_dimension == pytest.approx(by_points, abs=2e-3)
    turned = np.random.default_rng(seed).random(len(c.graph.edges)) < 0.5
    edges = np.where(turned[:, None], c.graph.edges[:, ::-1], c.graph.edges)
    shifts = np.where(turned[:, None], -c.shifts, c.shifts)
    same = dataclasses.replace(c, graph=cz.PlanarGraph(c.graph.vertices, edges), shifts=shifts)
    assert cz.measure(same).box_dimension == found.box_dimension


def test_what_goes_round_the_torus_closes_no_cell() -> None:
    band = cz.Crack(
        cz.PlanarGraph([(0.1, 0.5), (0.6, 0.5)], [(0, 1), (1, 0)]),
        np.ones((2, 2)),
        np.zeros(2, np.int32),
        np.zeros(2, np.int32),
        (0, 0, 1, 1),
        (1.0, 1.0),
        np.array([(0, 0), (1, 0)], np.int8),
    )
    found = cz.measure(band)
    assert (found.loops, found.cells, found.length) == (1, 0, pytest.approx(1))


def test_an_island_is_not_taken_off_the_cell_around_it() -> None:
    ring = [(0, 0), (4, 0), (4, 4), (0, 4)]
    island = [(1, 1), (2, 1), (2, 2)]
    edges = [(i, (i + 1) % 4) for i in range(4)] + [(4 + i, 4 + (i + 1) % 3) for i in range(3)]
    found = cz.measure(cz.PlanarGraph([*ring, *island], edges))
    assert (found.cells, found.components) == (2, 2)
    # 16 and a half, though the cell between them has 15.5: the island's outline is no part of the cell's own.
    assert found.cell_area * 2 == pytest.approx(16.5)
