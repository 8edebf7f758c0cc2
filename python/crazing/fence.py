"""The fence around a drawing: all triangles of a constrained Delaunay triangulation about its edges."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing.diagram import Diagram, diagram

if TYPE_CHECKING:
    from crazing.drawing import Fence, Net

Rows = NDArray[np.int64]


def fenced(net: Net, box: Sequence[float]) -> Fence:
    """The triangles about edges in the plane, in a box that holds them all: none leaves it."""
    vertices, edges, *_ = net
    xmin, ymin, xmax, ymax = box
    corners = [(xmin, ymin), (xmax, ymin), (xmax, ymax), (xmin, ymax)]
    taken = set(map(tuple, vertices[(vertices == (xmin, ymin)).any(axis=1) | (vertices == (xmax, ymax)).any(axis=1)]))
    anchors = np.array([corner for corner in corners if corner not in taken]).reshape(-1, 2)
    kites = _led(_kites(diagram(np.concatenate([vertices, anchors]), constraints=edges)), edges.astype(np.int64))
    return anchors, np.ascontiguousarray(kites, dtype=np.int32), np.zeros((0, 6), dtype=np.int8)


def fenced_torus(net: Net, low: tuple[float, float]) -> Fence:
    """The triangles about edges on a torus, cut open along the left and the lower side of the period from `low`.

    Vertices lie in that period, and edges that pass a side have a vertex there.
    """
    vertices, edges, shifts, period, _ = net
    sides = np.array([low, np.add(low, period)])
    if (vertices == sides[0]).all(axis=1).any():
        # A vertex in the corner, where an anchor has to be: nothing moves.
        shut = np.column_stack([edges, np.full_like(edges, -1)])
        return np.zeros((0, 2)), shut, np.zeros((len(edges), 6), dtype=np.int8)
    places, row_of, turn_of, place_of = _opened(vertices, sides)
    # The copy of each edge that lies in the period.
    both = np.stack([np.zeros_like(shifts, dtype=np.int64), shifts.astype(np.int64)], axis=1)
    middle = (vertices[edges] + both * period).mean(axis=1)
    turns = both - np.floor((middle - low) / period).astype(np.int64)[:, None]
    drawn = place_of[edges, turns[..., 0], turns[..., 1]]
    rims = [[_chain(places, axis, side) for side in sides[:, axis]] for axis in (0, 1)]
    d = diagram(places, constraints=np.concatenate([drawn, *(_pairs(chain) for rim in rims for chain in rim)]))
    kites = _led(_kites(d), drawn)
    turns = turn_of[kites]
    rim_of = {(int(a), int(b)): k for k, (a, b) in enumerate(np.sort(kites[:, :2], axis=1).tolist()) if -1 in kites[k]}
    kept = np.ones(len(kites), dtype=bool)
    for axis, (near, far) in enumerate(rims):
        for pairs in zip(_pairs(near), _pairs(far), strict=True):
            one, other = (rim_of[min(pair), max(pair)] for pair in np.stack(pairs).tolist())
            # What lies beyond a side is what its copy on the opposite side has on its inside.
            hole, third = kites[one].argmin(), kites[other, 2:].max()
            kites[one, hole], turns[one, hole] = third, turn_of[third]
            turns[one, hole, axis] -= 1
            kept[other] = False
    found = row_of[kites[kept]].astype(np.int32)
    moved = (turns[kept][:, 1:] - turns[kept][:, :1]).reshape(-1, 6)
    return sides[:1], np.ascontiguousarray(found), moved.astype(np.int8)


def _opened(vertices: NDArray[np.float64], sides: NDArray[np.float64]) -> tuple[NDArray[np.float64], Rows, Rows, Rows]:
    """Vertices and a corner as places of one period: those on its left and lower sides are on the opposite ones, too.

    The places; of each the row and the periods that it is away; and the place of each row so many periods away.
    """
    anchor = len(vertices)
    low = vertices == sides[0]
    pieces = [(np.arange(anchor), (0, 0)), (np.flatnonzero(low[:, 0]), (1, 0)), (np.flatnonzero(low[:, 1]), (0, 1))]
    pieces += [(np.array([anchor]), turn) for turn in ((0, 0), (1, 0), (0, 1), (1, 1))]
    row_of = np.concatenate([rows for rows, _ in pieces])
    turn_of = np.concatenate([np.full((len(rows), 2), turn) for rows, turn in pieces])
    places = np.where(turn_of == 1, sides[1], np.concatenate([vertices, sides[:1]])[row_of])
    place_of = np.full((anchor + 1, 2, 2), -1)
    place_of[row_of, turn_of[:, 0], turn_of[:, 1]] = np.arange(len(places))
    return places, row_of, turn_of, place_of


def _chain(places: NDArray[np.float64], axis: int, side: float) -> Rows:
    """The places on a side, in order."""
    on_side = np.flatnonzero(places[:, axis] == side)
    return on_side[np.argsort(places[on_side, 1 - axis])]


def _pairs(chain: Rows) -> Rows:
    return np.column_stack([chain[:-1], chain[1:]])


def _kites(d: Diagram) -> Rows:
    """The ends of every edge, and the corners to its left and right; -1 outside."""
    ends, sides = d.edges.astype(np.int64), d.dual_edges
    third = d.triangles.astype(np.int64)[sides].sum(axis=2) - ends.sum(axis=1)[:, None]
    third[sides < 0] = -1
    return np.column_stack([ends, third[:, ::-1]])


def _led(kites: Rows, edges: Rows) -> Rows:
    """Kites with those of some edges first, in their order and direction."""
    count = kites.max(initial=0) + 1
    name, wanted = (np.sort(pairs[:, :2], axis=1) @ (count, 1) for pairs in (kites, edges))
    order = np.argsort(name)
    rows = order[np.searchsorted(name[order], wanted)]
    own = kites[rows]
    turned = own[:, 0] != edges[:, 0]
    own[turned] = own[turned][:, [1, 0, 3, 2]]
    return np.concatenate([own, np.delete(kites, rows, axis=0)])
