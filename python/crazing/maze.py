"""Mazes over the cells of a diagram."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing import rng as _rng
from crazing.arguments import bounds_tuple, choice, count, number, points_array
from crazing.diagram import Diagram, as_tiling, bounds_of, unconstrained
from crazing.errors import CrazingError
from crazing.graph import PREVIEW_EDGES, PlanarGraph
from crazing.maze_drawing import Drawing
from crazing.maze_statistics import MazeStatistics, statistics
from crazing.record import Record
from crazing.region import Region, as_region
from crazing.walls import walls
from crazing.within import Plan, delaunay_plan, triangulated, voronoi_plan

TREES = ("depth-first", "kruskal", "prim", "wilson")


@dataclass(frozen=True, eq=False, repr=False)
class Maze(Drawing, Record):
    """A maze: which doors between neighbouring cells are open. Made by :func:`crazing.maze`.

    Attributes
    ----------
    diagram : Diagram
        Whose cells these are.
    cells : {"voronoi", "delaunay"}
        What a cell is: the Voronoi cell of a site, or a Delaunay triangle.
    open : (m,) bool
        Whether the door at edge `k` of the diagram is open. Dual edges without length within the bounds are no doors
        of Voronoi cells (a cell cannot be left through a point), edges of the hull no doors of triangles. Within a
        shape whose outline cuts an edge into several doors, whether any of them is.
    passages : (cells - components, 2) int32
        The spanning tree, two cells a passage, in the order of carving: parent and child, except of Kruskal's tree,
        which has no root.
    start : int
        The cell the search started from; -1 when there is no cell.
    bounds : (xmin, ymin, xmax, ymax)
        What the walls of Voronoi cells are clipped to; of a periodic maze, one period; within a shape, its box.
    region : Region or None
        The shape that the maze is within.
    plan : Plan or None
        Within a shape: its cells and doors, of which there may be more than sites and edges.
    """

    diagram: Diagram
    cells: str
    open: NDArray[np.bool_]
    passages: NDArray[np.int32]
    start: int
    bounds: tuple[float, float, float, float]
    region: Region | None = None
    plan: Plan | None = None

    @cached_property
    def walls(self) -> PlanarGraph:
        """The shut doors: dual edges clipped to the bounds, or Delaunay edges.

        Vertices are those of `Diagram.voronoi`, or the sites. Walls of a periodic maze are those of one period, cut
        where they leave it and going on at the opposite side: pictures of it side by side fit. Within a shape they are
        the parts inside, and its outline with gaps at the `ends`.
        """
        return walls(self)

    @cached_property
    def ends(self) -> tuple[int, ...]:
        """Entrance and exit: the two cells farthest apart, of those on the outline if the maze is within a shape.

        Where shut doors have parted such a maze, those of its part that has most cells on the outline. None where no
        way joins two such cells.
        """
        if self.plan is None:
            way = self.longest()
            return (int(way[0]), int(way[-1])) if len(way) > 1 else ()
        # In a tree the cell farthest from any cell is an end of the longest way between cells of the rim.
        first = self._farthest(self._entered)
        second = self._farthest(first)
        return (first, second) if first != second else ()

    @property
    def rim(self) -> NDArray[np.int32]:
        """(k,) int32, the cells on the outline of the shape, holes left out."""
        return np.unique(self.plan.rim) if self.plan is not None else np.empty(0, dtype=np.int32)

    @property
    def _entered(self) -> int:
        """A cell of the part with most cells of the rim: the start, if that part holds it."""
        (size, sides), is_open = self._doors
        labels, count = _core.graph_components(size, np.compress(is_open, sides, axis=0))
        rim = self.rim[labels[self.rim] >= 0]
        sizes = np.bincount(labels[rim], minlength=count)
        own = labels[self.start]
        if not len(rim) or (own >= 0 and sizes[own] == sizes.max()):
            return self.start
        return int(rim[labels[rim] == sizes.argmax()][0])

    def _farthest(self, source: int) -> int:
        rim = self.rim
        away = self.distances(source)[rim] if len(rim) else rim
        return int(rim[away.argmax()]) if len(away) and away.max() >= 0 else source

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
        return _core.solve(*self._doors, self._cell(source, "source"), self._cell(target, "target"))

    def distances(self, source: int | None = None) -> NDArray[np.int32]:
        """Count the doors between a cell and every other.

        Parameters
        ----------
        source : int, optional
            A cell; by default `start`.

        Returns
        -------
        (cells,) int32
            Open doors to pass on the shortest way; -1 where none leads.

        Raises
        ------
        CrazingError
            If `source` is no cell.

        Examples
        --------
        >>> import crazing as cz
        >>> m = cz.maze([(float(i), 0.0) for i in range(4)], rng=0)
        >>> m.distances(1)
        array([1, 0, 1, 2], dtype=int32)
        """
        source = self.start if source is None else self._cell(source, "source")
        if source < 0:  # There is no cell to start from.
            return np.empty(0, dtype=np.int32)
        return _core.distances(*self._doors, source)

    def _cell(self, value: Any, name: str) -> int:
        cell = count(value, name)
        if cell >= self.size:
            raise CrazingError(f"{name} is {cell}; a cell from 0 to less than {self.size} is wanted")
        return cell

    def longest(self) -> NDArray[np.int32]:
        """Find the longest way that the maze has: its ends make the hardest entrance and exit.

        Returns
        -------
        (k,) int32
            The cells along it.

        Examples
        --------
        >>> import crazing as cz
        >>> m = cz.maze(cz.sample.uniform(50, rng=2), rng=2)
        >>> way = m.longest()
        >>> bool(len(way) == m.distances(way[0]).max() + 1)
        True
        """
        return _core.longest(*self._doors)

    @property
    def sides(self) -> NDArray[np.int32]:
        """(doors, 2) int32, the cells on either side of every door; -1 is none. Row `k` is edge `k` of the diagram."""
        if self.plan is not None:
            return self.plan.sides
        return self.diagram.dual_edges if self.cells == "delaunay" else self.diagram.edges

    @property
    def _doors(self) -> tuple[tuple[int, NDArray[np.int32]], NDArray[np.bool_]]:
        """The arguments that every search begins with."""
        return (self.size, self.sides), self.open if self.plan is None else self.plan.open

    @property
    def size(self) -> int:
        """Number of cells."""
        further = 0 if self.plan is None else len(self.plan.parts)
        return len(self.diagram.triangles if self.cells == "delaunay" else self.diagram.sites) + further

    @property
    def centres(self) -> NDArray[np.float64]:
        """(cells, 2) float64, a point for every cell: its site, or the centroid of its triangle.

        Of triangles of a periodic maze, which may lie across a seam, the Voronoi vertex. Within a shape, the parts of
        a cell have its one site, which may lie outside.
        """
        if self.cells == "voronoi":
            further = [] if self.plan is None else [self.diagram.sites[self.plan.parts]]
            return np.concatenate([self.diagram.sites, *further])
        if self.diagram.period is not None:  # Where corners lie on either side of a seam there is no mean of them.
            return self.diagram.vertices
        return np.asarray(self.diagram.sites[self.diagram.triangles].mean(axis=1))

    @property
    def statistics(self) -> MazeStatistics:
        """What makes a maze hard: its dead ends, junctions, and the way between its `ends`.

        Returns
        -------
        MazeStatistics

        Examples
        --------
        >>> import crazing as cz
        >>> cz.maze([(float(i), 0.0) for i in range(4)], rng=0).statistics
        MazeStatistics(cells=4, dead_ends=2, junctions=0, solution=4, winding=1.0)
        """
        return statistics(self)

    def _repr_svg_(self) -> str | None:
        return self.walls._repr_svg_() if len(self.open) <= PREVIEW_EDGES else None

    def __repr__(self) -> str:
        return f"Maze({self.size} {self.cells} cells, {int(self.open.sum())} open doors, start {self.start})"


def maze(
    points: ArrayLike | Diagram,
    *,
    cells: str = "voronoi",
    tree: str = "depth-first",
    start: int | None = None,
    opening: float = 1.0,
    bounds: ArrayLike | None = None,
    period: ArrayLike | None = None,
    within: Any = None,
    rng: _rng.RNG = None,
) -> Maze:
    """Carve a maze through the cells of a diagram: one way between any two cells.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        One Voronoi cell a distinct point.
    cells : {"voronoi", "delaunay"}
        What a cell is. The two are one algorithm with the columns of the edge table exchanged. Points on one line have
        Voronoi cells, but no triangles.
    tree : {"depth-first", "kruskal", "prim", "wilson"}
        How the tree of passages grows. Depth-first has long winding ways and few dead ends, Prim many short ones,
        Kruskal lies between; Wilson draws every spanning tree with the same chance, and takes the longest.
    start : int, optional
        The cell to start from; drawn by default. Kruskal's tree does not depend on it.
    opening : float, optional
        The share of the passages whose door is really opened, from 0 (every wall stands) to 1 (the thesis: one way
        between any two cells).
    bounds : (xmin, ymin, xmax, ymax), optional
        The page: walls of Voronoi cells are clipped to it, and none of what lies beyond is a door, so that every way
        stays on it. By default the bounding box of the points, grown by a tenth. Cells of points outside may have no
        door. The sides of the page are no walls; for an outline with an entrance and an exit give it as `within`.
    period : (width, height), optional
        Carve on a torus: ways leave on one side and come in on the opposite one, see :func:`crazing.diagram`.
    within : optional
        Carve in a shape: its ring as a (k, 2) array, a list of rings (a point in an odd number of them is inside, so
        that a ring in a ring is a hole), a polygon of shapely or another object with `__geo_interface__`, GeoJSON or
        the name of such a file, or a picture (a mask of bools or of 0 and 1, or an image whose border is outside; in
        pixels, y up). Voronoi walls are clipped to it, and what has a length inside is a door; each part of a cell
        that the outline cuts is a cell of its own.
        Where a corner of the shape lies exactly on a wall, walls count as moved right by next to nothing, and up by
        nothing beside that: one that the corner touches from the right is met there, and two doors; from the left it
        is free, and one.
        Triangles are those of the points and the corners of the shape, its sides being constraints (cut into pieces
        about as long as the edges inside, by sites that come after the points). Sides may touch, not cross or overlap.
    rng : int, numpy.random.Generator or None, optional
        Seed. The same seed gives the same maze on every platform.

    Returns
    -------
    Maze
        Depth-first truly: every shut door joins a cell and an ancestor of it in the tree of passages.

    Raises
    ------
    CrazingError
        If a coordinate is NaN or infinite, `start` is no cell, or sides of `within` cross or overlap.
    TypeError, ValueError
        If an argument is of the wrong type or out of range.

    Notes
    -----
    Source: thesis, sections 7.1 and 7.2. Kruskal 1956; Prim 1957; Wilson: Generating Random Spanning Trees More
    Quickly than the Cover Time (1996).

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
    choice(cells, "cells", ("voronoi", "delaunay"))
    choice(tree, "tree", TREES)
    if within is not None:
        if bounds is not None or period is not None:
            raise ValueError("within goes without bounds and period")
        return _within(points, as_region(within), cells, tree, start, opening, _rng.key(rng))
    diagram = as_tiling(points, period)
    box = bounds_of(diagram, bounds)
    if cells == "delaunay":
        sides, doors = (len(diagram.triangles), diagram.dual_edges), np.ones(len(diagram.edges), dtype=bool)
    else:
        unconstrained(diagram)
        sides = len(diagram.sites), diagram.edges
        doors = _torus_doors(diagram) if diagram.period is not None else _core.voronoi_doors(diagram.arrays, box)
    _check_start(start, sides[0])
    carved = _core.carve(sides, doors, tree, start, False, opening, _rng.key(rng))
    return Maze(diagram, cells, *carved, box)


def _within(
    points: ArrayLike | Diagram,
    region: Region,
    cells: str,
    tree: str,
    start: int | None,
    opening: float,
    key: tuple[int, int],
) -> Maze:
    box = bounds_tuple(region.bounds, "the extent of within")
    if isinstance(points, Diagram) and points.period is not None:
        raise ValueError("within goes without bounds and period")
    if cells == "delaunay":
        diagram = triangulated(points.sites if isinstance(points, Diagram) else points_array(points), region)
        plan = delaunay_plan(diagram)
    else:
        diagram = as_tiling(points, None)
        plan = voronoi_plan(diagram, region)
    count = len(diagram.triangles) if cells == "delaunay" else len(diagram.sites) + len(plan.parts)
    doors = np.ones(len(plan.sides), dtype=bool)
    _check_start(start, count)
    open_doors, passages, first = _core.carve((count, plan.sides), doors, tree, start, True, opening, key)
    plan = plan.carved(open_doors)
    return Maze(diagram, cells, plan.edges_open(len(diagram.edges)), passages, first, box, region, plan)


def _check_start(start: int | None, cells: int) -> None:
    if start is not None and start >= cells:
        raise CrazingError(f"start is {start}; the cell of one of {cells}, counted from 0, is wanted")


def _torus_doors(diagram: Diagram) -> NDArray[np.bool_]:
    """Whether each dual edge has a length: it may join a vertex to a copy of itself, which is no point."""
    right, left = diagram.vertices[diagram.dual_edges[:, 0]], diagram.vertices[diagram.dual_edges[:, 1]]
    return np.asarray((right != left).any(axis=1) | diagram.dual_shifts.any(axis=1))
