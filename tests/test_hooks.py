"""Parting cracks where they turn back: hooks go, bends stay, and what is left is as it was."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import crazing as cz
from crossings import crossings


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


def test_a_crack_that_turns_back_twice_within_its_reach_is_parted() -> None:
    """Over all of the reach it goes straight on."""
    points = [(0, -6), (0, -3), (0.1, 0), (0.12, 0.08), (0.48, -0.45), (0.8, 1.4), (1, 4), (1, 7)]
    edges = np.column_stack([np.arange(len(points) - 1), np.arange(1, len(points))])
    drawing = cz.steps.draw(cz.PlanarGraph(points, edges))
    found = cz.steps.part(drawing, hairpin=110, reach=2.5)
    assert 1 <= len(edges) - len(found.edges) <= 2


def ahead(drawing: cz.steps.Drawing, end: int, reach: float) -> np.ndarray:
    """The way to the place `reach` along a crack that is entered by an end of an edge."""
    at, run = np.zeros(2), 0.0
    for _ in range(len(drawing.edges)):
        edge, side = divmod(end, 2)
        step = drawing.vertices[drawing.edges[edge, 1 - side]] - drawing.vertices[drawing.edges[edge, side]]
        length = float(np.hypot(*step))
        part = min(1.0, (reach - run) / length)
        at, run = at + part * step, run + part * length
        end = int(drawing.partner[2 * edge + 1 - side])
        if end < 0 or run >= reach:
            break
    return at


@pytest.mark.parametrize("part_of_reach", [1.0, 0.5, 0.25])
def test_no_hook_is_left(part_of_reach: float) -> None:
    """None of two cracks with free tips, and none that is made where one of three cracks that met is left out."""
    turns = []
    for seed in range(6):
        bare = cz.steps.walls(cz.maze(cz.sample.uniform(200, rng=seed), rng=seed, opening=0.8, bounds=(0, 0, 1, 1)))
        left = cz.steps.part(cz.steps.straighten(bare, rounds=1), hairpin=100, reach=0.1)
        ends = left.edges.ravel()
        degrees = np.bincount(ends)
        whole = np.flatnonzero((degrees == 2) & ~left.cut)
        assert (np.bincount(ends, left.partner >= 0)[whole] == 2).all()
        for end, other in enumerate(left.partner):
            if other > end and not left.cut[ends[end]]:
                a, b = (ahead(left, int(first), part_of_reach * 0.1) for first in (end, other))
                cosine = float(a @ b / (np.hypot(*a) * np.hypot(*b)))
                turns.append(180 - np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    assert len(turns) > 300 and max(turns) < 100.001


def drawn(crack: cz.Crack) -> cz.steps.Drawing:
    """A pattern as a drawing whose cracks go on as its strands say."""
    ends = crack.graph.edges.ravel()
    order = np.lexsort((ends, np.repeat(crack.strand, 2)))
    strand, vertex = np.repeat(crack.strand, 2)[order], ends[order]
    first = np.flatnonzero((strand[1:] == strand[:-1]) & (vertex[1:] == vertex[:-1]))
    partner = np.full(len(ends), -1, dtype=np.int32)
    partner[order[first]], partner[order[first + 1]] = order[first + 1], order[first]
    return dataclasses.replace(cz.steps.draw(crack.graph), partner=partner)


def turns(recipe: cz.Recipe, seed: int, spacings: float, beyond: float = 0.0) -> list[float]:
    """How far cracks turn over so many spacings to both sides, of those so far from the middle."""
    bare = recipe.replace(roughness=0, rounding=0)
    # Where no crack is wider than another, one as thick as plates are apart tells how far that is.
    even = bare.replace(thickness=1, hierarchy=0, taper=0, abutting=1, unevenness=0, fade=0)
    pattern, reach = drawn(bare.crack(rng=seed)), spacings * even.crack(rng=seed).width.max()
    found = []
    for end in np.flatnonzero(pattern.partner > np.arange(len(pattern.partner))):
        if np.hypot(*(pattern.vertices[pattern.edges.ravel()[end]] - 0.5)) >= beyond:
            a, b = (ahead(pattern, int(first), reach) for first in (end, pattern.partner[end]))
            found.append(180 - float(np.degrees(np.arccos(np.clip(a @ b / (np.hypot(*a) * np.hypot(*b)), -1, 1)))))
    return found


def test_a_warp_leaves_no_hook() -> None:
    """Cracks that were parted first and then bent came out with one in every third picture of bark."""
    found = [turn for seed in range(8) for turn in turns(cz.preset("bark"), seed, 1.5)]
    assert len(found) > 1500 and max(found) < 85.001


def test_where_plates_are_larger_cracks_are_parted_over_a_longer_way() -> None:
    """Far from the blow cracks made a U about several plates, wider than the reach for those in the middle."""
    found = [turn for seed in range(8) for turn in turns(cz.preset("concrete-spall"), seed, 4, beyond=0.3)]
    assert len(found) > 800 and np.mean(np.array(found) > 90) < 0.005


def rows(drawing: cz.steps.Drawing, corners: np.ndarray) -> set[tuple[tuple[float, ...], ...]]:
    """Edges or kites by the places of their corners: those that lose all their edges are no vertices any more."""
    points = [*map(tuple, np.concatenate([drawing.vertices, drawing.fence[0]]).tolist()), ()]
    return {tuple(points[corner] for corner in row) for row in corners.tolist()}


@pytest.mark.parametrize("period", [None, (1.0, 0.5)])
def test_what_is_left_is_as_it_was(period) -> None:
    where = {"period": period} if period else {"bounds": (0, 0, 1, 1)}
    for seed in range(3):
        bare = cz.steps.walls(cz.maze(cz.sample.uniform(150, bounds=(0, 0, 1, 0.5), rng=seed), rng=seed, **where))
        left = cz.steps.part(bare, hairpin=90, reach=0.08)
        assert 0 < len(bare.edges) - len(left.edges) < 0.3 * len(bare.edges)
        assert rows(left, left.edges) <= rows(bare, bare.edges)
        assert np.bincount(left.edges.ravel(), minlength=len(left.vertices)).min() > 0
        # Partners are mutual, at one vertex; kites are about their edges, and all are there.
        paired = np.flatnonzero(left.partner >= 0)
        ends = left.edges.ravel()
        assert np.array_equal(left.partner[left.partner[paired]], paired)
        assert np.array_equal(ends[left.partner[paired]], ends[paired])
        assert np.array_equal(left.fence[1][: len(left.edges), :2], left.edges)
        assert rows(left, left.fence[1]) == rows(bare, bare.fence[1])


def test_the_knob_of_a_recipe_parts_and_leaves_no_crossing() -> None:
    base = {"n": 120, "opening": 0.8, "rounds": 4, "anisotropy": 3.0, "roughness": 0.05}
    for period in (None, (1.0, 1.0)):
        whole, parted = (cz.crack(**base, hairpin=angle, period=period, rng=2) for angle in (180.0, 90.0))
        assert whole == cz.crack(**base, period=period, rng=2)
        ends = [int((c.graph.degrees == 1).sum()) for c in (whole, parted)]
        assert ends[1] > ends[0] + 4
        assert crossings(parted) == 0


@pytest.mark.parametrize("fault", [{"hairpin": 181}, {"hairpin": -1}, {"reach": np.nan}, {"spacing": -1}])
def test_bad_numbers_are_named(fault) -> None:
    with pytest.raises(ValueError, match=next(iter(fault))):
        cz.steps.part(cz.steps.split(5, rng=1), **{"hairpin": 90, "reach": 0.1, **fault})
