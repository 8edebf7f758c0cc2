"""Mazes over the cells of a diagram."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing import rng as _rng
from crazing.arguments import choice, count, number
from crazing.diagram import Diagram, as_diagram, bounds_of
from crazing.graph import PlanarGraph
from crazing.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Maze(Record):
    """A maze: which doors between neighbouring cells are open. Made by :func:`crazing.maze`.

    Attributes
    ----------
    diagram : Diagram
        Whose cells these are.
    cells : {"voronoi", "delaunay"}
        What a cell is: the Voronoi cell of a site, or a Delaunay triangle.
    open : (m,) bool
        Whether the door at edge `k` of the diagram is open. Dual edges without length are no doors of Voronoi cells (a
        cell cannot be left through a point), edges of the hull no doors of triangles.
    passages : (cells - components, 2) int32
        The spanning tree of the search, parent and child, in the order of carving.
    start : int
        The cell the search started from; -1 when there is no cell.
    bounds : (xmin, ymin, xmax, ymax)
        What the walls of Voronoi cells are clipped to.
    """

    diagram: Diagram
    cells: str
    open: NDArray[np.bool_]
    passages: NDArray[np.int32]
    start: int
    bounds: tuple[float, float, float, float]

    @cached_property
    def walls(self) -> PlanarGraph:
        """The shut doors: dual edges clipped to the bounds, or Delaunay edges.

        Vertices are those of `Diagram.voronoi`, or the sites.
        """
        if self.cells == "delaunay":
            return PlanarGraph(self.diagram.sites, self.diagram.edges[~self.open])
        vertices, edges, _ = _core.dual_edges(self.diagram.arrays, self.bounds, ~self.open)
        return PlanarGraph(vertices, edges)

    def solve(self, source: int, target: int) -> NDArray[np.int32]:
        """Find the shortest way through open doors, breadth-first.

        Parameters
        ----------
        source, target : int
            Cells: rows of the diagram's sites, or of its triangles.

        Returns
        -------
        (k,) int32
            The cells from `source` to `target`, both included; empty when no way leads there.

        Raises
        ------
        CrazingError
            If either is no cell.

        Examples
        --------
        >>> import crazing as cz
        >>> m = cz.maze(cz.sample.uniform(50, rng=2), rng=2)
        >>> way = m.solve(0, 40)
        >>> int(way[0]), int(way[-1])
        (0, 40)
        """
        ends = count(source, "source"), count(target, "target")
        return _core.solve(self.diagram.arrays, self.cells == "delaunay", self.open, *ends)

    def plot(self, ax: Any = None, **line_style: Any) -> Any:
        """Draw the walls on Matplotlib axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            A new figure's by default.
        **line_style
            As for :meth:`crazing.PlanarGraph.plot`.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> import crazing as cz
        >>> ax = cz.maze(cz.sample.uniform(50, rng=2), rng=2).plot(color="black")
        """
        return self.walls.plot(ax, **line_style)

    def __repr__(self) -> str:
        size = len(self.diagram.triangles if self.cells == "delaunay" else self.diagram.sites)
        return f"Maze({size} {self.cells} cells, {int(self.open.sum())} open doors, start {self.start})"


def maze(
    points: ArrayLike | Diagram,
    *,
    cells: str = "voronoi",
    start: int | None = None,
    opening: float = 1.0,
    bounds: ArrayLike | None = None,
    rng: _rng.RNG = None,
) -> Maze:
    """Carve a maze through the cells of a diagram by depth-first search.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        One Voronoi cell a distinct point.
    cells : {"voronoi", "delaunay"}
        What a cell is. The two are one algorithm with the columns of the edge table exchanged. Points on one line have
        Voronoi cells, but no triangles.
    start : int, optional
        The cell to start from; drawn by default.
    opening : float, optional
        The share of the passages whose door is really opened, from 0 (every wall stands) to 1 (the thesis: one way
        between any two cells).
    bounds : (xmin, ymin, xmax, ymax), optional
        What the walls of Voronoi cells are clipped to. By default the bounding box of the points, grown by a tenth.
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
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Notes
    -----
    Source: thesis, sections 7.1 and 7.2.

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
    delaunay = choice(cells, "cells", ("voronoi", "delaunay")) == "delaunay"
    diagram = as_diagram(points)
    box = bounds_of(diagram, bounds)
    carved = _core.carve(diagram.arrays, delaunay, start, opening, _rng.key(rng))
    return Maze(diagram, cells, *carved, box)
