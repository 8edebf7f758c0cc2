"""The cells and doors of a maze within a shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.diagram import Diagram, diagram, unconstrained
from crazing.errors import CrazingError
from crazing.record import Record
from crazing.region import Region

#: Most pieces of the outline of a shape for every point and corner of it.
_SLENDER = 64


@dataclass(frozen=True, eq=False, repr=False)
class Plan(Record):
    """Cells and doors within a shape.

    Attributes
    ----------
    sides : (doors, 2) int32
        The cells on either side of every door; -1 twice where there is none. Door `k` is at edge `k` of the diagram:
        the first piece of it in the shape. Then come the further pieces of edges that the outline cuts more than once.
    rows : (further,) int32
        The edge of every further door.
    parts : (further parts,) int32
        A Voronoi cell that the outline cuts into parts is as many cells. The first, that with the first door, has the
        number of its site; these are the sites of the others, which are numbered on from the last site.
    rim : (arcs,) int32
        The cells on the outer rings of the outline, once for every stretch of it that they have.
    arcs : (arcs, 2) float64
        From where to where each stretch runs: number of a side, and part of it. Of triangles, the edge, twice.
    open : (doors,) bool
        Whether each door is open.
    """

    sides: NDArray[np.int32]
    rows: NDArray[np.int32]
    parts: NDArray[np.int32]
    rim: NDArray[np.int32]
    arcs: NDArray[np.float64]
    open: NDArray[np.bool_]

    def carved(self, open_doors: NDArray[np.bool_]) -> Plan:
        """The same with doors opened."""
        return Plan(self.sides, self.rows, self.parts, self.rim, self.arcs, open_doors)

    def edges_open(self, edges: int) -> NDArray[np.bool_]:
        """Whether any door at each edge of the diagram is open."""
        found = self.open[:edges].copy()
        found[self.rows[self.open[edges:]]] = True
        return found

    def pieces(self, doors: NDArray[np.intp], edges: int) -> NDArray[np.int32]:
        """(k, 2), the edge of each door, and which piece of it that is."""
        further = np.maximum(doors - edges, 0)
        rows = np.where(doors < edges, doors, np.append(self.rows, 0)[np.minimum(further, len(self.rows))])
        number = np.where(doors < edges, 0, further - np.searchsorted(self.rows, rows) + 1)
        return np.column_stack([rows, number]).astype(np.int32)


def voronoi_plan(diagram: Diagram, region: Region) -> Plan:
    """The parts of Voronoi cells in a shape."""
    parts, rows, sides, rim, arcs, outer = _core.region_cells(unconstrained(diagram).arrays, region.rings)
    return Plan(sides, rows, parts, rim[outer], arcs[outer], np.zeros(len(sides), dtype=bool))


def triangulated(points: NDArray[np.float64], region: Region) -> Diagram:
    """The triangulation of points and the corners of a shape, with its sides as constraints.

    Sides are cut into pieces about as long as the edges inside, or triangles there would be as long as the sides.
    """
    inside = max(int(region.contains(points).sum()), 1) if len(points) else 1
    a, b = np.moveaxis(region.outline.segments, 1, 0)
    # From a corner of it: of a small shape far from the origin the products would be all rounding.
    p, q = a - a[0], b - a[0]
    area = 0.5 * float((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum())
    lengths = region.outline.lengths
    # Of a shape like a hair the pieces would be without number.
    apart = max(float(np.sqrt(max(area, 0.0) / inside)), float(lengths.sum()) / (_SLENDER * (inside + len(lengths))))
    pieces = np.maximum(np.rint(lengths / apart), 1).astype(np.intp)
    try:
        return _along(points, region, pieces)
    except CrazingError:
        # Points between the corners are rounded, and may leave a side that touches another.
        return _along(points, region, np.ones_like(pieces))


def _along(points: NDArray[np.float64], region: Region, pieces: NDArray[np.intp]) -> Diagram:
    a, b = np.moveaxis(region.outline.segments, 1, 0)
    side = np.repeat(np.arange(len(pieces)), pieces)
    first = np.concatenate([[0], np.cumsum(pieces)])
    part = ((np.arange(len(side)) - first[side]) / pieces[side])[:, None]
    corners = a[side] + part * (b - a)[side]
    following = np.arange(1, len(side) + 1)
    following[first[region.offsets[1:]] - 1] = first[region.offsets[:-1]]
    rows = len(points) + np.column_stack([np.arange(len(side)), following])
    return diagram(np.concatenate([points, corners]), constraints=rows)


def delaunay_plan(diagram: Diagram) -> Plan:
    """The triangles in a shape, whose outline are the constraints of the diagram."""
    depth = np.append(_core.depths(diagram.arrays, np.ascontiguousarray(diagram.constrained)), 0)
    inside = depth[diagram.dual_edges] % 2 == 1
    door = inside.all(axis=1) & ~diagram.constrained
    # Outer rings part the inside from what can be reached from infinity.
    rim_edges = np.flatnonzero(diagram.constrained & (depth[diagram.dual_edges].min(axis=1) == 0))
    rim = diagram.dual_edges[rim_edges, inside[rim_edges].argmax(axis=1)]
    arcs = np.repeat(rim_edges[:, None], 2, axis=1).astype(np.float64)
    none = np.empty(0, dtype=np.int32)
    sides = np.where(door[:, None], diagram.dual_edges, np.int32(-1))
    return Plan(sides, none, none, rim, arcs, np.zeros(len(sides), dtype=bool))
