"""Diagrams that have every side of given rings, and what lies within rings that touch."""

from __future__ import annotations

from itertools import pairwise, product

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.diagram import Diagram, diagram
from crazing.polygons import Ring

#: Rounds of halving boundary edges that the triangulation lacks; each halves the gap that can be told apart.
ROUNDS = 24
#: Rounds that plain polygons need, and so many times their points in all; more is a reason to look for faults.
QUICK, GROWTH = 8, 4
#: Points that all rounds together may take, whatever there were at first: more is a wait of a minute.
CROWD = 4_000_000

Mask = NDArray[np.bool_]
Floats = NDArray[np.float64]


def conforming(rings: list[Ring], rounds: int) -> tuple[Diagram, Mask, list[Ring]] | None:
    """A diagram that has every side of the rings, which of its edges these are, and the rings as they were halved.

    None if it takes more rounds, or too many points: the rings cross, overlap, or nearly touch.
    """
    total = sum(map(len, rings))
    left = GROWTH * total + 4000 if rounds == QUICK else max(rounds * total // 2, CROWD)
    for _ in range(rounds):
        found = diagram(np.concatenate(rings))
        starts = np.cumsum([0, *map(len, rings)], dtype=np.int64)
        # Without duplicates a site is its row; where rings touch, it has several ends.
        is_plain = len(found.sites) == total
        if is_plain:
            boundary = _core.ring_edges(found.arrays, starts)
            if np.count_nonzero(boundary) == total:
                return found, boundary, rings
        ends = np.concatenate([np.roll(np.arange(a, b), -1) for a, b in pairwise(starts)])
        edges, sides = _keys(found.edges), _keys(np.column_stack([found.site_of, found.site_of[ends]]))
        if not is_plain:
            boundary = _among(edges, sides)
        missing = ~_among(sides, edges)
        if not missing.any():
            return found, boundary, rings
        pieces = np.split(missing, starts[1:-1])
        rings = [_halved(ring, part) for ring, part in zip(rings, pieces, strict=True)]
        left -= total
        total = sum(map(len, rings))
        if total > left:
            break
    return None


def is_touched(found: Diagram, boundary: Mask) -> bool:
    """Whether any site has not two sides: rings meet there, or one passes through it twice."""
    if np.count_nonzero(boundary) == len(found.sites) == len(found.site_of):
        # Every point of the rings has a place to itself.
        return False
    return bool((np.bincount(found.edges[boundary].ravel(), minlength=len(found.sites)) != 2).any())


def within(found: Diagram, boundary: Mask, rings: list[Ring]) -> tuple[Mask, Floats, Floats]:
    """Whether each dual edge is inside rings that may touch, its arc residual, and the length of that arc.

    A site where rings touch stands in several places; the residual is the least between any two of them.
    """
    depth = np.append(_core.depths(found.arrays, boundary), 0)
    inside = (depth[found.dual_edges] % 2 == 1).all(axis=1) & ~boundary
    along, length, ring_of = _travelled(rings)
    order = np.argsort(found.site_of, kind="stable")
    first = np.searchsorted(found.site_of[order], np.arange(len(found.sites) + 1))

    def spans(rows: NDArray[np.intp], others: NDArray[np.intp]) -> tuple[Floats, Floats]:
        way = np.abs(along[rows] - along[others]) / length[rows]
        residual = np.where(ring_of[rows] == ring_of[others], np.minimum(way, 1 - way), np.inf)
        return residual, residual * length[rows]

    residual, arc = spans(*order[first[found.edges]].T)
    several = np.diff(first) > 1
    for k in np.flatnonzero(several[found.edges].any(axis=1) & inside).tolist():
        places = np.array([*product(*(order[first[site] : first[site + 1]] for site in found.edges[k]))])
        parts, arcs = spans(*places.T)
        least = parts.argmin()
        residual[k], arc[k] = parts[least], arcs[least]
    return inside, residual, arc


def with_feet(found: Diagram, boundary: Mask, rings: list[Ring], kept: Mask) -> list[Ring] | None:
    """The rings with more points where the kept axis leaves them, None where it does not.

    In a strait narrower than points are apart, one of them sees a side opposite under an obtuse angle, and the centre
    of their circle lies beyond that side. With the foot of the point on the side the angle is a right one: the strait
    needs no more points the narrower it is.
    """
    out = _core.beyond(found.arrays, boundary, kept)
    if not len(out):
        return None
    edges, third = found.edges[out[:, 0]], found.sites[out[:, 1]]
    ends = found.sites[edges]
    step = ends[:, 1] - ends[:, 0]
    part = ((third - ends[:, 0]) * step).sum(axis=1) / (step**2).sum(axis=1)
    feet = ends[:, 0] + part[:, None] * step
    # Where there is no number between them, that is all.
    fresh = (feet[:, None] != ends).any(axis=2).all(axis=1)
    if not fresh.any():
        return None
    edges, feet = edges[fresh], feet[fresh]
    keys = _keys(edges)
    order = np.argsort(keys, kind="stable")
    keys, feet = keys[order], feet[order]
    finer, start = [], 0
    for ring in rings:
        sites = found.site_of[start : start + len(ring)]
        own = _keys(np.column_stack([sites, np.roll(sites, -1)]))
        place = np.searchsorted(keys[:-1], own)
        side = np.flatnonzero(keys[place] == own)
        finer.append(np.insert(ring, side + 1, feet[place[side]], axis=0))
        start += len(ring)
    return finer


def _travelled(rings: list[Ring]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.intp]]:
    """Of every row, ring after ring: how far along its ring it stands, the length of that ring, and which it is."""
    sizes = [len(ring) for ring in rings]
    steps = [side_lengths(ring) for ring in rings]
    along = np.concatenate([np.cumsum(step) - step for step in steps])
    return along, np.repeat([step.sum() for step in steps], sizes), np.repeat(np.arange(len(rings)), sizes)


def side_lengths(ring: Ring) -> NDArray[np.float64]:
    """(k,), the length of every side of a ring, from each corner to the next."""
    steps = np.empty_like(ring)
    np.subtract(ring[1:], ring[:-1], out=steps[:-1])
    np.subtract(ring[0], ring[-1], out=steps[-1])
    return np.asarray(np.hypot(*steps.T))


def _among(keys: NDArray[np.int64], known: NDArray[np.int64]) -> Mask:
    """Which of the keys are known; by sorting, as NumPy hashes to tell this and takes ten times as long."""
    ordered = np.sort(known)
    return np.asarray(ordered[np.searchsorted(ordered[:-1], keys)] == keys)


def _halved(ring: Ring, sides: Mask) -> Ring:
    middle = ring + 0.5 * (np.roll(ring, -1, axis=0) - ring)
    return np.insert(ring, np.flatnonzero(sides) + 1, middle[sides], axis=0)


def _keys(ends: NDArray[np.int32]) -> NDArray[np.int64]:
    """One number an edge, the same in both directions."""
    sorted_ends = np.sort(ends, axis=1).astype(np.int64)
    return np.asarray(sorted_ends[:, 0] << 32 | sorted_ends[:, 1])
