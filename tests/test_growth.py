"""Growth: nothing at 0, all at 1, never less than before, older cracks first."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
import shapely

import crazing as cz

PLACES = [
    {"preset": "glaze", "n": 60},
    {"preset": "glaze", "n": 60, "period": (2, 1)},
    {"preset": "painting-flemish", "n": 80},
    {"preset": "painting-flemish", "n": 80, "period": (1, 1)},
    {"preset": "glass-impact", "n": 60},
    {"n": 100},
]


def steps(c: cz.Crack) -> np.ndarray:
    return np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T)


@pytest.mark.parametrize("place", PLACES)
def test_a_pattern_grows_from_nothing_to_all(place) -> None:
    c = cz.crack(rng=5, **place)
    ages = np.linspace(0, 1, 9)
    grown = [c.at(age) for age in ages]
    lengths = [steps(g).sum() for g in grown]
    assert lengths[0] == 0 and grown[-1] == c
    assert (np.diff(lengths) > 0).all()
    # What is there is a part of the whole: its length is where tips have arrived, edge by edge.
    when = c.arrivals
    assert when.min() == 0 and when.max() == 1
    low, high = when.min(axis=1), when.max(axis=1)
    for age, length in zip(ages[1:-1], lengths[1:-1], strict=True):
        part = np.clip((age - low) / (high - low), 0, 1)
        assert length == pytest.approx((part * steps(c)).sum())
    for before, after in pairwise(grown):
        assert before.width.max(initial=0) <= after.width.max(initial=0) + 1e-15


@pytest.mark.parametrize("place", PLACES)
def test_tips_end_on_their_edge_with_no_width(place) -> None:
    c = cz.crack(rng=6, **place)
    grown = c.at(0.4)
    assert grown.width.min() == 0 and (grown.width >= 0).all()
    assert len(grown.shifts) == len(grown.graph.edges) == len(grown.parent)
    # No edge is longer than the longest, in particular none runs the wrong way around a torus.
    assert steps(grown).max() <= steps(c).max() * (1 + 1e-9)


@pytest.mark.parametrize("place", PLACES)
def test_an_earlier_pattern_is_within_a_later_one_and_its_vertices_within_the_period(place) -> None:
    c = cz.crack(rng=6, **place)
    turns = [(0, 0)] if c.period is None else [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)]
    covered = []
    for age in (*np.linspace(0.05, 0.95, 11), 1.0):
        grown = c.at(float(age))
        if c.period is not None:
            home = grown.graph.vertices - c.bounds[:2]
            assert (home >= 0).all() and (home < c.period).all()
        copies = [grown.segments + np.multiply(turn, c.period or (0, 0)) for turn in turns]
        covered.append((grown.segments, shapely.union_all(shapely.linestrings(np.concatenate(copies)))))
    for (segments, _), (_, later) in pairwise(covered):
        # Of lines, but for rounding; of their widths the test above.
        assert shapely.distance(shapely.points(segments.reshape(-1, 2)), later).max() < 1e-12
        assert shapely.distance(shapely.points(segments.mean(axis=1)), later).max() < 1e-12


@pytest.mark.parametrize("place", PLACES)
def test_no_strand_starts_before_its_parent_is_there_or_before_older_ones(place) -> None:
    in_order = []
    for seed in range(7, 15):
        c = cz.crack(rng=seed, **place)
        starts = np.full(int(c.strand.max()) + 1, np.inf)
        np.minimum.at(starts, c.strand, c.arrivals.min(axis=1))
        parent = np.full(len(starts), -1)
        parent[c.strand] = c.parent
        children = np.flatnonzero(parent >= 0)
        assert (starts[children] >= starts[parent[children]]).all()
        in_order.append(np.corrcoef(np.arange(len(starts)), starts)[0, 1])
    # One pattern of a few dozen strands has .43 to .86.
    assert np.mean(in_order) > 0.5
