"""Drawings: cracks on their way through the steps, with the fence that keeps them from crossing."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments
from crazing.diagram import diagram
from crazing.fence import fenced
from crazing.graph import PlanarGraph
from crazing.record import Record

Bounds: TypeAlias = tuple[float, float, float, float]
#: Vertices, edges, shifts, period, cut.
Net: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int8], tuple[float, float], NDArray[np.bool_]]
#: Anchors, kites and shifts.
Fence: TypeAlias = tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int8]]


@dataclass(frozen=True, eq=False, repr=False)
class Drawing(Record):
    """Cracks on their way through the steps: edges, and what keeps them from crossing.

    Attributes
    ----------
    vertices : (v, 2) float64
        Positions; on a torus they may have left the period.
    edges : (e, 2) int32
        Rows of `vertices`.
    shifts : (e, 2) int8
        Periods that each edge crosses; no rows in the plane.
    period : (width, height)
        What is repeated; zeros in the plane.
    cut : (v,) bool
        Vertices on the bounds, where an edge was cut.
    bounds : (xmin, ymin, xmax, ymax)
        What the drawing is clipped to; on a torus one period.
    fence : tuple of arrays
        Anchors (a, 2) float64, points that stay; kites (k, 4) int32: `a`, `b` and the corners to the left and right of
        the edge from `a` to `b`, rows of vertices and then anchors, -1 for none; their shifts (k, 6) int8. Kite `k` is
        about edge `k`, more may follow. Vertices move only as long as the triangles of the kites keep their sense.
    partner : (2 e,) int32
        The end that each edge end continues into; end 2 k + i is end i of edge k; -1 for none.
    age : (e,) int32
        Of the crack of each edge, low is old; no rows where length decides.
    origin : (e,) int32
        The edge that each piece of a rough drawing is of; pieces of one edge follow one another. No rows where edges
        are whole.
    """

    vertices: NDArray[np.float64]
    edges: NDArray[np.int32]
    shifts: NDArray[np.int8]
    period: tuple[float, float]
    cut: NDArray[np.bool_]
    bounds: Bounds
    fence: Fence
    partner: NDArray[np.int32]
    age: NDArray[np.int32]
    origin: NDArray[np.int32] = field(default_factory=lambda: np.empty(0, dtype=np.int32))

    @property
    def net(self) -> Net:
        """Vertices, edges, shifts, period and cut, as the core takes them."""
        return self.vertices, self.edges, self.shifts, self.period, self.cut

    def __repr__(self) -> str:
        return f"Drawing({len(self.edges)} edges, bounds {self.bounds})"


def paired(net: Net, fence: Fence, bounds: Bounds) -> Drawing:
    """A drawing without age: at every vertex the edges that continue each other best are one crack."""
    return Drawing(*net, bounds, fence, _core.crack_pairs(net, np.pi), np.empty(0, dtype=np.int32))


def draw(graph: PlanarGraph, *, bounds: ArrayLike | None = None) -> Drawing:
    """Any drawing of straight edges that do not cross, ready for the steps.

    Parameters
    ----------
    graph : PlanarGraph
        In the plane. Vertices at one place are merged, those without an edge left out.
    bounds : (xmin, ymin, xmax, ymax), optional
        Vertices on their sides stay there; the box around the edges, grown by a tenth, by default.

    Returns
    -------
    Drawing
        Its fence is the constrained Delaunay triangulation about the edges.

    Raises
    ------
    CrazingError
        If edges cross or overlap.
    TypeError, ValueError
        If the bounds are none.

    Examples
    --------
    >>> import crazing as cz
    >>> zigzag = cz.PlanarGraph([(0, 0), (1, 1), (2, 0), (3, 1)], [(0, 1), (1, 2), (2, 3)])
    >>> straight = cz.steps.straighten(cz.steps.draw(zigzag), rounds=9)
    >>> bool(abs(straight.vertices - zigzag.vertices).max() > 0.2)
    True
    """
    small = arguments.of_kind(graph, "graph", PlanarGraph).compact()
    if bounds is None:
        low, high = (np.min(small.vertices, axis=0), np.max(small.vertices, axis=0)) if len(small.edges) else (0, 1)
        margin = 0.1 * (float(np.max(np.subtract(high, low))) or 1.0)
        bounds = (*np.subtract(low, margin) * np.ones(2), *np.add(high, margin) * np.ones(2))
    box = arguments.areal(arguments.bounds_tuple(bounds))
    places = diagram(small.vertices)
    vertices, edges = places.sites, places.site_of[small.edges]
    sides = np.reshape(box, (2, 2))
    cut = (vertices == sides[0]).any(axis=1) | (vertices == sides[1]).any(axis=1)
    net: Net = vertices, np.ascontiguousarray(edges), np.empty((0, 2), dtype=np.int8), (0.0, 0.0), cut
    low, high = (
        np.minimum(sides[0], vertices.min(axis=0, initial=np.inf)),
        np.maximum(sides[1], vertices.max(axis=0, initial=-np.inf)),
    )
    return paired(net, fenced(net, (*(1.5 * low - 0.5 * high), *(1.5 * high - 0.5 * low))), box)
