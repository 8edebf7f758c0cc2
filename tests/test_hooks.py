"""Parting cracks where they turn back: hooks go, bends stay, and what is left is as it was."""

from __future__ import annotations

import numpy as np
import pytest

import crazing as cz
from test_steps import crossings


def turned(degrees: float, pieces: int) -> cz.PlanarGraph:
    """Two arms of 6 that turn by an angle, in a number of corners 0.3 apart."""
    heading = np.radians(np.concatenate([[0.0] * 6, np.linspace(0, degrees, pieces + 1)[1:], [degrees] * 5]))
    length = np.where(np.arange(len(heading)) < 6, 1.0, np.where(np.arange(len(heading)) < 5 + pieces, 0.3, 1.0))
    steps = np.column_stack([np.cos(heading), np.sin(heading)]) * length[:, None]
    points = np.concatenate([[(0.0, 0.0)], np.cumsum(steps, axis=0)])
    return cz.PlanarGraph(points, np.column_stack([np.arange(len(steps)), np.arange(1, len(steps) + 1)]))


@pytest.mark.parametrize("pieces", [1, 2, 3])
def test_a_hook_is_parted_once_and_a_bend_is_not(pieces: int) -> None:
    for degrees, gaps in ((60, 0), (100, 0), (160, 1), (170, 1)):
        graph = turned(degrees, pieces)
        drawing = cz.steps.draw(graph)
        found = cz.steps.part(drawing, hairpin=130, reach=2.5)
        assert len(drawing.edges) - len(found.edges) == gaps, degrees
        if gaps:
            # One of the edges at the turn.
            gone = set(map(tuple, drawing.edges)) - set(map(tuple, found.edges))
            assert {vertex for edge in gone for vertex in edge} & set(range(4, 9))
        assert len(cz.steps.part(drawing, hairpin=180, reach=2.5).edges) == len(drawing.edges)


@pytest.mark.parametrize("period", [None, (1.0, 0.5)])
def test_what_is_left_is_as_it_was(period) -> None:
    where = {"period": period} if period else {"bounds": (0, 0, 1, 1)}
    for seed in range(3):
        bare = cz.steps.walls(cz.maze(cz.sample.uniform(150, bounds=(0, 0, 1, 0.5), rng=seed), rng=seed, **where))
        left = cz.steps.part(bare, hairpin=90, reach=0.08)
        assert 0 < len(bare.edges) - len(left.edges) < 0.3 * len(bare.edges)
        assert set(map(tuple, left.edges)) <= set(map(tuple, bare.edges))
        assert np.bincount(left.edges.ravel(), minlength=len(left.vertices)).min() > 0
        # Partners are mutual, at one vertex; kites are about their edges, and all are there.
        paired = np.flatnonzero(left.partner >= 0)
        ends = left.edges.ravel()
        assert np.array_equal(left.partner[left.partner[paired]], paired)
        assert np.array_equal(ends[left.partner[paired]], ends[paired])
        assert np.array_equal(left.fence[1][: len(left.edges), :2], left.edges)
        assert set(map(tuple, left.fence[1])) == set(map(tuple, bare.fence[1]))


def test_the_knob_of_a_recipe_parts_and_leaves_no_crossing() -> None:
    base = {"n": 120, "opening": 0.8, "rounds": 4, "anisotropy": 3.0, "roughness": 0.05}
    for period in (None, (1.0, 1.0)):
        whole, parted = (cz.crack(**base, hairpin=angle, period=period, rng=2) for angle in (180.0, 90.0))
        assert whole == cz.crack(**base, period=period, rng=2)
        ends = [int((c.graph.degrees == 1).sum()) for c in (whole, parted)]
        assert ends[1] > ends[0] + 4
        assert crossings(parted) == 0


@pytest.mark.parametrize("fault", [{"hairpin": 181}, {"hairpin": -1}, {"reach": np.nan}])
def test_bad_numbers_are_named(fault) -> None:
    with pytest.raises(ValueError, match=next(iter(fault))):
        cz.steps.part(cz.steps.split(5, rng=1), **{"hairpin": 90, "reach": 0.1, **fault})
