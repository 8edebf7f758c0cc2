"""Stubs: short branches of their own, with Shapely as the witness that nothing crosses."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import crazing as cz
from crossings import crossings
from test_steps import PLACES, topology

MANY = {"stubs": 2.0, "stub_length": 0.2, "stub_spread": 0.5}
HARD = {"roughness": 0.6, "hurst": 0.4, "grain": 0.05, "warp": 0.5}


@pytest.mark.parametrize("period", [None, (1.0, 0.5)])
@pytest.mark.parametrize("generator", ["maze", "splitting", "impact"])
def test_stubs_add_ends_and_junctions_and_nothing_else(generator: str, period) -> None:
    for seed in range(2):
        where = {"period": period, "rng": seed, "n": 90, "rounds": 3, "generator": generator}
        where |= {"opening": 0.5} if generator == "maze" else {}
        bare, grown, rough = cz.crack(**where), cz.crack(**where, **MANY), cz.crack(**where, **MANY, **HARD)
        ends, junctions, pieces, loops = topology(bare)
        count = topology(grown)[0] - ends
        assert count > 5
        assert topology(grown) == (ends + count, junctions + count, pieces, loops)
        assert topology(rough)[2:] == (pieces, loops)
        assert crossings(grown) == crossings(rough) == 0
        assert grown.strand.max() == bare.strand.max() + count
        # What was there is there, and as it was.
        assert set(map(tuple, bare.graph.vertices)) <= set(map(tuple, grown.graph.vertices))
        assert grown.graph.length > bare.graph.length


@pytest.mark.parametrize("place", PLACES)
def test_stubs_of_hostile_places_never_cross(place: str) -> None:
    for period in (None, (1.0, 1.0)):
        c = cz.crack(PLACES[place](1), opening=0.5, period=period, rng=1, rounds=5, **{**MANY, **HARD})
        assert crossings(c) == 0


def test_stubs_are_at_right_angles_as_long_as_asked_and_within_the_bounds() -> None:
    bare = cz.steps.walls(cz.maze(cz.sample.uniform(1500, rng=3), bounds=(0, 0, 1, 1), rng=3))
    grown = cz.steps.stubs(bare, rate=0.5, length=0.1, spread=0.0, lean=0.0, unit=0.026, rng=5)
    degrees = np.bincount(grown.edges.ravel())
    new = np.flatnonzero((grown.edges >= len(bare.vertices)).all(axis=1) & (degrees[grown.edges[:, 1]] == 1))
    stubs = grown.vertices[grown.edges[new]]
    step = stubs[:, 1] - stubs[:, 0]
    np.testing.assert_allclose(np.hypot(*step.T), 0.0026, rtol=1e-9)
    assert ((stubs >= 0) & (stubs <= 1)).all()
    # The edges at each foot.
    for foot, way in zip(grown.edges[new, 0], step, strict=True):
        at = grown.vertices[grown.edges[(grown.edges == foot).any(axis=1)]]
        cosines = (at[:, 1] - at[:, 0]) @ way / np.hypot(*(at[:, 1] - at[:, 0]).T) / np.hypot(*way)
        assert np.sort(np.abs(cosines)) == pytest.approx([0, 0, 1], abs=1e-6)
    # As many on either side, and about as many as tried: length over unit, times the rate.
    tried = 0.5 * cz.PlanarGraph(bare.vertices, bare.edges).length / 0.026
    assert 0.5 * tried < len(new) < 1.05 * tried


def test_a_stub_hangs_on_the_strand_that_it_grew_from_and_runs_out() -> None:
    c = cz.crack(generator="splitting", n=40, rng=2, stubs=1.0, stub_length=0.15)
    tips = np.flatnonzero(c.graph.degrees == 1)
    ends = c.graph.edges[:, 1]
    stub = np.flatnonzero(np.isin(ends, tips) & (np.bincount(c.strand)[c.strand] == 1) & (c.width[:, 1] == 0))
    assert len(stub) > 20
    assert c.parent is not None
    for k in stub:
        parent = c.parent[k]
        here = (c.graph.edges == c.graph.edges[k, 0]).any(axis=1)
        assert set(c.strand[here]) == {parent, c.strand[k]}
        assert c.generation[k] == c.generation[c.strand == parent][0] + 1
        assert c.width[k, 0] < c.width[here].max()
    # The youngest of all: they come last when the pattern grows.
    assert min(c.strand[stub]) > max(set(c.strand) - set(c.strand[stub]))


def test_without_stubs_nothing_changes_and_with_them_no_other_chance() -> None:
    base = {"n": 80, "opening": 0.6, "rounds": 3, "warp": 0.1, "rng": 4}
    plain = cz.crack(**base)
    assert cz.crack(**base, stub_length=0.7, stub_spread=1.0) == plain
    grown = cz.crack(**base, stubs=0.5)
    assert set(map(tuple, plain.graph.vertices)) < set(map(tuple, grown.graph.vertices))
    # A generator that is shared goes on as before.
    first, second = np.random.default_rng(1), np.random.default_rng(1)
    cz.crack(n=20, rng=first), cz.crack(n=20, stub_length=0.4, rng=second)
    assert first.random() == second.random()


def test_a_drawing_that_is_rough_has_no_room() -> None:
    rough = cz.steps.roughen(cz.steps.split(20, rng=1), roughness=0.05, unit=0.2, rng=1)
    again = cz.steps.stubs(rough, rate=5, length=0.01, unit=0.2, rng=1)
    assert np.array_equal(again.edges, rough.edges)


@pytest.mark.parametrize("fault", [{"rate": -1}, {"length": np.nan}, {"spread": 9}, {"lean": 90}, {"unit": 0}])
def test_bad_numbers_are_named(fault) -> None:
    with pytest.raises(ValueError, match=next(iter(fault))):
        cz.steps.stubs(cz.steps.split(5, rng=1), **{"rate": 1, "length": 0.1, "unit": 0.2, **fault})
    assert {field.name for field in dataclasses.fields(cz.Recipe)} > {"stubs", "stub_length", "stub_spread"}
