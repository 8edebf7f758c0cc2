"""The steps of a crack, from drawing to drawing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.crack import Crack
from crazing.graph import PlanarGraph
from crazing.maze import Maze
from crazing.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Net(Record):
    """A drawing in the plane or on a torus; see `Crack`.

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
    """

    vertices: NDArray[np.float64]
    edges: NDArray[np.int32]
    shifts: NDArray[np.int8]
    period: tuple[float, float]
    cut: NDArray[np.bool_]

    @property
    def arrays(self) -> Arrays:
        """What the core takes."""
        return self.vertices, self.edges, self.shifts, self.period, self.cut


Arrays = tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int8], tuple[float, float], NDArray[np.bool_]]
#: Anchors, kites and shifts: triangles about the edges that stay as they lie while vertices move.
Fence = tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int8]]


def walls(maze: Maze) -> tuple[Net, Fence]:
    """The walls of a maze of Voronoi cells, and the fence that its cells are."""
    d = maze.diagram
    if d.period is None:
        net, fence = _core.crack_walls(d.arrays, maze.open, maze.bounds)
    else:
        shifts = np.ascontiguousarray(d.shifts), np.ascontiguousarray(d.dual_shifts)
        net, fence = _core.crack_walls_on_torus(d.arrays, maze.open, *shifts, d.period)
    return Net(*net), fence


def pairs(net: Net) -> NDArray[np.int32]:
    """(2 e,) int32, the end that each edge end continues into; end 2 k + i is end i of edge k; -1 is none."""
    return _core.crack_pairs(net.arrays)


def straightened(
    net: Net, partner: NDArray[np.int32], fence: Fence, *, rounds: int, pull: float, slide: float, clamp: float
) -> Net:
    """The drawing with its strands straighter."""
    return replace(net, vertices=_core.crack_straighten(net.arrays, partner, fence, rounds, pull, slide, clamp))


def widened(
    net: Net,
    partner: NDArray[np.int32],
    bounds: tuple[float, float, float, float],
    width: float,
    hierarchy: float,
    taper: float,
) -> Crack:
    """The drawing as a crack."""
    widths, strand, generation, parent = _core.crack_widths(net.arrays, partner, width, hierarchy, taper)
    vertices, edges, shifts, period, _ = _core.crack_wrap(net.arrays)
    graph = PlanarGraph(vertices, edges)
    if not any(period):
        return Crack(graph, widths, strand, generation, bounds, parent=parent)
    return Crack(graph, widths, strand, generation, bounds, period, shifts, parent)
