"""Mazes over the cells of a diagram."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, rng as _rng
from crazing.arguments import count, number
from crazing.diagram import Diagram, as_diagram, bounds_of
from crazing.graph import PlanarGraph
from crazing.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Maze(Record):
    """A maze: which doors between neighbouring Voronoi cells are open. Made by :func:`crazing.maze`.

    Attributes
    ----------
    diagram : Diagram
        Whose cells these are.
    open : (m,) bool
        Whether the door of edge `k` is open. Dual edges without length are no doors: a cell cannot be left through a
        point.
    passages : (cells - components, 2) int32
        The spanning tree of the search, parent and child, in the order of carving.
    start : int
        The cell the search started from; -1 when there is no cell.
    bounds : (xmin, ymin, xmax, ymax)
        What `walls` is clipped to.
    """

    diagram: Diagram
    open: NDArray[np.bool_]
    passages: NDArray[np.int32]
    start: int
    bounds: tuple[float, float, float, float]

    @cached_property
    def walls(self) -> PlanarGraph:
        """The shut doors as line segments, clipped to the bounds; vertices as in `Diagram.voronoi`."""
        vertices, edges, _ = _core.dual_edges(self.diagram.arrays, self.bounds, ~self.open)
        return PlanarGraph(vertices, edges)

    def plot(self, ax: Any = None, **line_style: Any) -> Any:
        """Draw the walls; see :meth:`crazing.PlanarGraph.plot`."""
        return self.walls.plot(ax, **line_style)

    def __repr__(self) -> str:
        return f"Maze({len(self.diagram.sites)} cells, {int(self.open.sum())} open doors, start {self.start})"


def maze(
    points: ArrayLike | Diagram,
    *,
    start: int | None = None,
    opening: float = 1.0,
    bounds: ArrayLike | None = None,
    rng: _rng.RNG = None,
) -> Maze:
    """A maze over the Voronoi cells of points, carved by depth-first search.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        One cell a distinct point. Points on one line are fine.
    start : int, optional
        The cell (site) to start from; drawn by default.
    opening : float, optional
        The share of the passages whose door is really opened, from 0 (every wall stands) to 1 (the thesis: one way
        between any two cells).
    bounds : (xmin, ymin, xmax, ymax), optional
        What the walls are clipped to. By default the bounding box of the points, grown by a tenth.
    rng : int, numpy.random.Generator or None, optional
        Seed. The same seed gives the same maze on every platform.

    Returns
    -------
    Maze
        Truly depth-first: every shut door joins a cell and an ancestor of it in the tree of passages.

    Raises
    ------
    CrazingError
        If a coordinate is NaN or infinite, or `start` is no cell.

    Notes
    -----
    Source: thesis, section 7.1.

    Examples
    --------
    >>> import crazing as cz
    >>> m = cz.maze(cz.sample.uniform(100, rng=1), rng=1)
    >>> m.passages.shape, int(m.open.sum())
    ((99, 2), 99)
    """
    if start is not None:
        start = count(start, "start")
    opening = number(opening, "opening", low=0, high=1)
    diagram = as_diagram(points)
    box = bounds_of(diagram, bounds)
    return Maze(diagram, *_core.voronoi_maze(diagram.arrays, start, opening, _rng.key(rng)), box)
