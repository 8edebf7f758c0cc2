"""Strands as lines from end to end, and their outlines in true width."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from crazing.crack import Crack

#: An edge and which of its ends.
End: TypeAlias = tuple[int, int]

#: Cosine of the turn from which on an outline is parted.
BEND = 0.5
#: Turn of a side of a round corner: it is off by less than a hundredth of half the width.
FLAT = np.pi / 12
#: Of the width: what differs by less is one width.
_SAME = 1e-9
#: More ends of one strand at a vertex are not paired each with each.
_CROWD = 32


@dataclass(frozen=True, eq=False)
class Strand:
    """One crack from end to end.

    Attributes
    ----------
    points : (k, 2) float64
    width : (k,) float64
        At every point.
    number, generation, parent : int
    """

    points: NDArray[np.float64]
    width: NDArray[np.float64]
    number: int
    generation: int
    parent: int


def strands(crack: Crack) -> list[Strand]:
    """The strands in order; on a torus each from where it starts, on beyond the period.

    One is in several pieces where it grows, where it abuts itself, and where its width is another from edge to edge.
    """
    rows = defaultdict(list)
    for row, number in enumerate(crack.strand.tolist()):
        rows[number].append(row)
    segments, found = crack.segments, []
    # Lists: NumPy is slow number by number.
    edges, width = crack.graph.edges.tolist(), crack.width.tolist()
    for number in sorted(rows):
        about = number, int(crack.generation[rows[number][0]]), int(crack.parent[rows[number][0]])
        for line in _lines(rows[number], edges, width, segments):
            row, side = np.array(line).T
            found.append(Strand(*_along(crack, segments, row, side), *about))
    return found


def _lines(
    rows: list[int], edges: list[list[int]], width: list[list[float]], segments: NDArray[np.float64]
) -> Iterator[list[End]]:
    """The ends that the edges of one strand start from, line by line."""
    ends = defaultdict(list)
    for row in rows:
        for side, vertex in enumerate(edges[row]):
            ends[vertex].append((row, side))
    partner: dict[End, End] = {}
    for there in ends.values():
        for a, b in _pairs(there, segments):
            wide, thin = width[a[0]][a[1]], width[b[0]][b[1]]
            if a not in partner and b not in partner and abs(wide - thin) <= _SAME * max(*width[a[0]], *width[b[0]]):
                partner[a], partner[b] = b, a
    # From the tips; what is left are rings.
    starts = [end for _, there in sorted(ends.items()) for end in there if end not in partner]
    seen: set[int] = set()
    for row, side in [*starts, *((row, 0) for row in rows)]:
        line = []
        while row not in seen:
            seen.add(row)
            line.append((row, side))
            row, side = partner.get((row, 1 - side), (row, side))
        if line:
            yield line


def _pairs(there: list[End], segments: NDArray[np.float64]) -> list[tuple[End, End]]:
    """The pairs of ends at one vertex, the straightest first; of a crowd neighbours."""
    if len(there) > _CROWD:
        return list(zip(there[::2], there[1::2], strict=False))
    pairs = list(combinations(there, 2))

    def turn(pair: tuple[End, End]) -> float:
        (x, y), (u, v) = (segments[row, 1 - side] - segments[row, side] for row, side in pair)
        length = np.hypot(x, y) * np.hypot(u, v)
        return float((x * u + y * v) / length) if length else 1.0

    return sorted(pairs, key=turn) if len(pairs) > 1 else pairs


def _along(
    crack: Crack, segments: NDArray[np.float64], row: NDArray[np.intp], side: NDArray[np.intp]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points and widths along edges that start from these ends."""
    start, end = segments[row, side], segments[row, 1 - side]
    points = np.concatenate([start[:1], end])
    if crack.period is not None:
        points = np.cumsum(np.concatenate([start[:1], end - start]), axis=0)
    return points, np.concatenate([crack.width[row[:1], side[:1]], crack.width[row, 1 - side]])


def outlines(strand: Strand) -> list[NDArray[np.float64]]:
    """Closed outlines, (k, 2) float64 each, that together are a strand: left side there, right side back, round ends.

    An edge is the convex hull of the discs at its ends, as in pictures. A strand is parted where it turns by more than
    60 degrees. Every outline is a sum of pieces that all run clockwise, so that the nonzero rule fills it: where edges
    are shorter than wide, its inner side touches the middle line between them.
    """
    step = np.diff(strand.points, axis=0)
    moves = (step != 0).any(axis=1)
    if not moves.any():
        return _disc(strand.points[0], strand.width.max() / 2)
    with np.errstate(invalid="ignore"):
        along = step / np.hypot(*step.T)[:, None]
        bends = ~((along[1:] * along[:-1]).sum(axis=1) >= BEND)
    cuts = np.flatnonzero(bends | ~moves[1:] | ~moves[:-1]) + 1
    pieces = zip([0, *cuts.tolist()], [*cuts.tolist(), len(step)], strict=True)
    return [_outline(strand.points[a : b + 1], strand.width[a : b + 1] / 2) for a, b in pieces if moves[a]]


def _disc(centre: NDArray[np.float64], half: float) -> list[NDArray[np.float64]]:
    if not half:
        return []
    turn = np.arange(round(2 * np.pi / FLAT)) * -FLAT
    return [centre + half * np.column_stack([np.cos(turn), np.sin(turn)])]


def _outline(points: NDArray[np.float64], half: NDArray[np.float64]) -> NDArray[np.float64]:
    step = np.diff(points, axis=0)
    length, heading = np.hypot(*step.T), np.arctan2(step[:, 1], step[:, 0])
    # A line that touches both discs leans towards the smaller; where one disc holds the other, it is the larger disc.
    lean = np.arcsin(np.clip((half[:-1] - half[1:]) / length, -1, 1))
    bend = (np.diff(heading) + np.pi) % (2 * np.pi) - np.pi
    half_side = length * np.cos(lean) / 2
    room = np.minimum(half_side[1:], half_side[:-1])
    left = _side(points, half, heading + (np.pi / 2 - lean), np.diff(lean) - bend, room, -1)
    right = _side(points, half, heading - (np.pi / 2 - lean), np.diff(lean) + bend, room, 1)
    ends = (
        _cap(points[-1], half[-1], heading[-1] + (np.pi / 2 - lean[-1]), np.pi - 2 * lean[-1]),
        _cap(points[0], half[0], heading[0] - (np.pi / 2 - lean[0]), np.pi + 2 * lean[0]),
    )
    return np.concatenate([left, ends[0], right[::-1], ends[1]])


def _side(
    points: NDArray[np.float64],
    half: NDArray[np.float64],
    towards: NDArray[np.float64],
    turn: NDArray[np.float64],
    room: NDArray[np.float64],
    sense: int,
) -> NDArray[np.float64]:
    """One side of a line: what it is towards from the line, and how far that turns outwards at every inner point."""
    out, inner = half[1:-1], np.cos(turn / 2)
    is_flat = (turn <= FLAT) & (turn >= -np.pi / 2) & ((turn >= 0) | (np.tan(-turn / 2) * out <= room))
    # One point where the two lines meet, an arc, or in to the middle line and out again.
    parts = np.where(is_flat, 1, np.where(turn < 0, 3, np.ceil(turn / FLAT).astype(np.intp) + 1))
    row = np.repeat(np.arange(len(parts)), parts)
    place = np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)
    part = np.where(is_flat[row], 0.5, place / np.maximum(parts[row] - 1, 1))
    far = np.where(is_flat[row], 1 / np.where(is_flat, inner, 1)[row], (turn[row] > 0) | (place != 1))
    # The first and the last point have one direction only.
    angle = np.concatenate([towards[:1], towards[row] + sense * turn[row] * part, towards[-1:]])
    away = np.concatenate([half[:1], far * out[row], half[-1:]])
    at = np.concatenate([[0], row + 1, [len(points) - 1]])
    return np.asarray(points[at] + away[:, None] * np.column_stack([np.cos(angle), np.sin(angle)]))


def _cap(centre: NDArray[np.float64], half: float, towards: float, turn: float) -> NDArray[np.float64]:
    """What lies between a point beside the end of a line and the one opposite, clockwise; nothing about a tip."""
    sides = max(int(np.ceil(turn / FLAT - _SAME)), 1) if half else 1
    angle = towards - turn * np.arange(1, sides) / sides
    return np.asarray(centre + half * np.column_stack([np.cos(angle), np.sin(angle)]))
