"""The laws of the steps: nothing ever crosses, with Shapely as the witness."""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray

import crazing as cz


def crossings(c: cz.Crack) -> int:
    """Pairs of edges that meet anywhere but at a common vertex; of a torus those of 3 x 3 copies."""
    around = (-1, 0, 1) if c.period else (0,)
    copies = [np.array((a, b), dtype=int) for a in around for b in around]
    period = np.array(c.period or (0, 0))
    segments = np.concatenate([c.segments + copy * period for copy in copies])
    turns = np.stack([np.zeros_like(c.shifts, dtype=int), c.shifts.astype(int)], axis=1)
    turns = np.concatenate([turns + copy for copy in copies])
    vertices = np.tile(c.graph.edges, (len(copies), 1))[:, :, None]
    ends = np.concatenate([vertices, turns], axis=2)
    lines = shapely.linestrings(segments)
    i, j = shapely.STRtree(lines).query(lines, predicate="intersects")
    i, j = i[i < j], j[i < j]
    common = (ends[i][:, :, None] == ends[j][:, None]).all(axis=-1)
    apart = ~common.any(axis=(1, 2))
    # Edges from one vertex lie on each other only if they leave it in one direction.
    side_i, side_j = common.any(axis=2).argmax(axis=1), common.any(axis=1).argmax(axis=1)
    step = segments[:, 1] - segments[:, 0]
    p, q = ((1 - 2 * side)[:, None] * step[row] for side, row in ((side_i, i), (side_j, j)))
    folded = (p[:, 0] * q[:, 1] == p[:, 1] * q[:, 0]) & ((p * q).sum(axis=1) > 0)
    return int((apart | folded | common.all(axis=2).all(axis=1)).sum())


PLACES = {
    "uniform": lambda seed: cz.sample.uniform(150, rng=seed),
    "grid": lambda seed: np.argwhere(np.ones((12, 12))) / 12.0,
    "nearly a grid": lambda seed: np.argwhere(np.ones((12, 12))) / 12.0 + cz.sample.normal(144, scale=1e-9, rng=seed),
    "clusters": lambda seed: np.concatenate(
        [
            cz.sample.normal(40, loc=(x, 0.5), scale=10.0**-k, rng=seed + k)
            for k, x in enumerate((0.5, 0.2, 0.7, 0.8), 1)
        ]
    ),
    "circle": lambda seed: 0.5 + 0.4 * np.exp(1j * np.arange(60) * np.pi / 30).view(float).reshape(-1, 2),
    "nearly a line": lambda seed: np.column_stack(
        [np.arange(80) / 80, 0.5 + cz.sample.normal(80, scale=1e-4, rng=seed)[:, 0]]
    ),
}


@pytest.mark.parametrize("period", [None, (1.0, 1.0), (1.0, 0.5)])
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("opening", [0.0, 0.6, 1.0])
def test_straightening_never_makes_a_crossing(place: str, period, opening: float) -> None:
    hard = {"rounds": 12, "pull": 1.0, "slide": 1.0, "clamp": 0.02}
    for seed in range(2):
        points = PLACES[place](seed)
        before = cz.crack(points, opening=opening, period=period, rng=seed)
        after = cz.crack(points, opening=opening, period=period, rng=seed, **hard)
        assert np.array_equal(before.graph.edges, after.graph.edges)
        assert crossings(before) == 0
        assert crossings(after) == 0


def test_straightening_makes_t_junctions_and_short_ways() -> None:
    def largest_angles(c: cz.Crack) -> NDArray[np.float64]:
        ends = np.concatenate([c.segments, c.segments[:, ::-1]])
        vertex = c.graph.edges.T.ravel()
        step = ends[:, 1] - ends[:, 0]
        angle = np.arctan2(step[:, 1], step[:, 0])
        three = np.flatnonzero(c.graph.degrees == 3)
        order = np.lexsort([angle, vertex])
        rows = angle[order][np.isin(vertex[order], three)].reshape(-1, 3)
        return np.degrees(np.diff(rows, axis=1, append=rows[:, :1] + 2 * np.pi)).max(axis=1)

    plain = cz.crack(n=2000, opening=0.57, rng=3)
    straight = cz.crack(n=2000, opening=0.57, rounds=5, rng=3)
    share = [(largest_angles(c) >= 155).mean() for c in (plain, straight)]
    assert share[0] < 0.4 and share[1] > 0.6
    assert straight.graph.length < 0.97 * plain.graph.length


def test_a_periodic_crack_is_closed_over_its_seams() -> None:
    c = cz.crack(n=400, opening=0.5, period=(2.0, 1.0), rng=5)
    assert (c.graph.vertices >= 0).all() and (c.graph.vertices < (2, 1)).all()
    assert c.shifts.any() and len(c.shifts) == len(c.graph.edges)
    walls = cz.maze(cz.sample.uniform(400, bounds=(0, 0, 2, 1), rng=np.random.default_rng(5)), period=(2, 1), rng=0)
    assert np.abs(c.segments[:, 1] - c.segments[:, 0]).max() < 0.5
    assert walls.bounds == c.bounds
    # No free tip at a seam: every end that is not a dead end goes on.
    assert (c.width[(c.graph.degrees == 1)[c.graph.edges]] == 0).all()
