"""Mazes over the cells of a diagram."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing import rng as _rng
from crazing.arguments import bounds_tuple, choice, count, number, period_pair
from crazing.diagram import Arrays, Diagram, as_tiling, bounds_of, tiled
from crazing.graph import PlanarGraph
from crazing.record import Record
from crazing.region import Region, as_region
from crazing.sheet import sheet

TREES = ("depth-first", "kruskal", "prim", "wilson")


@dataclass(frozen=True)
class MazeStatistics:
    """Counts of a maze. Made by :attr:`crazing.Maze.statistics`.

    Attributes
    ----------
    cells : int
        Cells; of a maze within a shape those that have an open door.
    dead_ends : int
        Cells with one open door.
    junctions : int
        Cells with three open doors or more.
    solution : int
        Cells on the way between the `ends`; 0 when there is none.
    winding : float
        Length of that way over the straight distance between its ends.
    """

    cells: int
    dead_ends: int
    junctions: int
    solution: int
    winding: float


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
        The spanning tree, two cells a passage, in the order of carving: parent and child, except of Kruskal's tree,
        which has no root.
    start : int
        The cell the search started from; -1 when there is no cell.
    bounds : (xmin, ymin, xmax, ymax)
        What the walls of Voronoi cells are clipped to; of a periodic maze, one period; within a shape, its box.
    region : Region or None
        The shape that the maze is within.
    rim : (k,) int32
        The cells that lie on the outline of the shape.
    """

    diagram: Diagram
    cells: str
    open: NDArray[np.bool_]
    passages: NDArray[np.int32]
    start: int
    bounds: tuple[float, float, float, float]
    region: Region | None = None
    rim: NDArray[np.int32] = field(default_factory=lambda: np.empty(0, dtype=np.int32))

    @cached_property
    def walls(self) -> PlanarGraph:
        """The shut doors: dual edges clipped to the bounds, or Delaunay edges.

        Vertices are those of `Diagram.voronoi`, or the sites. Walls of a periodic maze are those of one period, cut
        where they leave it and going on at the opposite side: pictures of it side by side fit. Within a shape they are
        the parts inside, and its outline with gaps at the `ends`.
        """
        d, shut = self.diagram, ~self.open
        if self.region is not None:
            return self._walls_within(self.region)
        if d.period is not None and self.cells == "delaunay":
            return tiled(d.sites, d.edges[shut], d.shifts[shut], d.period)
        if d.period is not None:
            return tiled(d.vertices, d.dual_edges[shut], d.dual_shifts[shut], d.period)
        if self.cells == "delaunay":
            return PlanarGraph(d.sites, d.edges[shut])
        vertices, edges, _ = _core.dual_edges(d.arrays, self.bounds, shut)
        return PlanarGraph(vertices, edges)

    def _walls_within(self, region: Region) -> PlanarGraph:
        d = self.diagram
        inner = _core.dual_edges_within(d.arrays, self.bounds, region.coords, region.offsets, ~self.open)
        others = [d.edges[(d.edges == end).any(axis=1)] for end in self.ends]
        pairs = [(d.sites[end], d.sites[rows[rows != end]]) for end, rows in zip(self.ends, others, strict=True)]
        outline = region.opened(pairs)
        vertices = np.concatenate([inner[0], outline.vertices])
        return PlanarGraph(vertices, np.concatenate([inner[1], outline.edges + np.int32(len(inner[0]))]))

    @cached_property
    def ends(self) -> tuple[int, ...]:
        """Entrance and exit: the two cells farthest apart, of those on the outline if the maze is within a shape.

        None where there are no two such cells that a way joins.
        """
        if self.region is None:
            way = self.longest()
            return (int(way[0]), int(way[-1])) if len(way) > 1 else ()
        # In a tree the cell farthest from any cell is an end of the longest way between cells of the rim.
        first = self._farthest(self.start)
        second = self._farthest(first)
        return (first, second) if first != second else ()

    def _farthest(self, source: int) -> int:
        away = self.distances(source)[self.rim]
        return int(self.rim[away.argmax()]) if len(away) and away.max() >= 0 else source

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
        return _core.solve(*self._doors, *ends)

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
        source = self.start if source is None else count(source, "source")
        if source < 0:  # There is no cell to start from.
            return np.empty(0, dtype=np.int32)
        return _core.distances(*self._doors, source)

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
    def _doors(self) -> tuple[Arrays, bool, NDArray[np.bool_]]:
        """The arguments that every search begins with."""
        return self.diagram.arrays, self.cells == "delaunay", self.open

    @property
    def size(self) -> int:
        """Number of cells."""
        return len(self.diagram.triangles if self.cells == "delaunay" else self.diagram.sites)

    @property
    def centres(self) -> NDArray[np.float64]:
        """(cells, 2) float64, a point of every cell: its site, or the centroid of its triangle.

        Of triangles of a periodic maze, which may lie across a seam, the Voronoi vertex.
        """
        if self.cells == "voronoi":
            return self.diagram.sites
        if self.diagram.period is not None:  # Where corners lie on either side of a seam there is no mean of them.
            return self.diagram.vertices
        return np.asarray(self.diagram.sites[self.diagram.triangles].mean(axis=1))

    def path(self, way: ArrayLike) -> PlanarGraph:
        """Draw a way: from cell to cell through the middle of each door.

        Parameters
        ----------
        way : (k,) array_like of int
            Cells, each the neighbour of the one before through an open door: what `solve` and `longest` give.

        Returns
        -------
        PlanarGraph
            Of a periodic maze, cut at the sides of the period and going straight from cell to cell.

        Raises
        ------
        ValueError
            If no open door joins two cells that follow one another.

        Examples
        --------
        >>> import crazing as cz
        >>> m = cz.maze([(float(i), 0.0) for i in range(4)], rng=0)
        >>> m.path([0, 1, 2]).length
        2.0
        """
        cells = np.asarray(way, dtype=np.int32)
        sides = self.diagram.dual_edges if self.cells == "delaunay" else self.diagram.edges
        rows = np.flatnonzero(self.open)
        door = {frozenset(pair): int(row) for row, pair in zip(rows, sides[rows].tolist(), strict=True)}
        steps = list(zip(cells[:-1].tolist(), cells[1:].tolist(), strict=True))
        for a, b in steps:
            if frozenset((a, b)) not in door:
                raise ValueError(f"way goes from cell {a} to {b}; no open door joins them")
        passed = np.array([door[frozenset(step)] for step in steps], dtype=np.intp)
        if self.diagram.period is not None:
            shifts = self.diagram.dual_shifts if self.cells == "delaunay" else self.diagram.shifts
            return tiled(self.centres, sides[passed], shifts[passed], self.diagram.period)
        points = np.empty((2 * len(passed) + 1, 2))
        points[::2] = self.centres[cells]
        points[1::2] = self._door_middles(passed)
        line = np.arange(len(points), dtype=np.int32)
        return PlanarGraph(points, np.column_stack([line[:-1], line[1:]]))

    def _door_middles(self, rows: NDArray[np.intp]) -> NDArray[np.float64]:
        """The middle of each door, of its longest part in the bounds; of a door beyond them its nearest end."""
        d = self.diagram
        if self.cells == "delaunay":
            return np.asarray(d.sites[d.edges[rows]].mean(axis=1))
        wanted = np.zeros(len(d.edges), dtype=bool)
        wanted[rows] = True
        if self.region is None:
            vertices, edges, parts = _core.dual_edges(d.arrays, self.bounds, wanted)
        else:
            rings = self.region.coords, self.region.offsets
            vertices, edges, parts, _ = _core.dual_edges_within(d.arrays, self.bounds, *rings, wanted)
        order = np.argsort(PlanarGraph(vertices, edges).lengths, kind="stable")
        middles = _nearest_ends(d)
        middles[parts[order]] = vertices[edges[order]].mean(axis=1)
        return np.asarray(middles[rows])

    def _way(self, solution: bool | ArrayLike) -> NDArray[np.int32] | None:
        """The way between the `ends` for True, none for False, else the cells given."""
        if isinstance(solution, (bool, np.bool_)):
            return self.solve(*self.ends) if solution and self.ends else None
        return np.asarray(solution, dtype=np.int32)

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
        sides = self.diagram.dual_edges if self.cells == "delaunay" else self.diagram.edges
        doors = np.bincount(sides[self.open].ravel(), minlength=self.size)
        reached = self.size if self.region is None else int((doors > 0).sum())
        way = self._way(True)
        counts = reached, int((doors == 1).sum()), int((doors > 2).sum())
        if way is None:
            return MazeStatistics(*counts, 0, 1.0)
        straight = float(np.linalg.norm(self.centres[way[-1]] - self.centres[way[0]]))
        return MazeStatistics(*counts, len(way), self.path(way).length / straight if straight else 1.0)

    def plot(
        self,
        ax: Any = None,
        *,
        solution: bool | ArrayLike = False,
        distances: bool | int = False,
        **line_style: Any,
    ) -> Any:
        """Draw the walls on Matplotlib axes.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            A new figure's by default.
        solution : bool or (k,) array_like of int
            Draw the way between the `ends`, or the way given, in red.
        distances : bool or int
            Colour a dot in every cell by its distance from `start`, or from the cell given.
        **line_style
            Of the walls, as for :meth:`crazing.PlanarGraph.plot`.

        Returns
        -------
        matplotlib.axes.Axes

        Examples
        --------
        >>> import crazing as cz
        >>> ax = cz.maze(cz.sample.uniform(50, rng=2), rng=2).plot(solution=True, distances=True, color="black")
        """
        ax = self.walls.plot(ax, **line_style)
        if distances is not False:
            away = self.distances(None if distances is True else distances)
            reached = away >= 0
            ax.scatter(*self.centres[reached].T, c=away[reached], s=9, zorder=0)
        way = self._way(solution)
        if way is not None:
            self.path(way).plot(ax, color="red")
        return ax

    def save(
        self,
        path: str | os.PathLike[str],
        *,
        page: ArrayLike = (210.0, 297.0),
        margin: float = 10.0,
        pen: float = 0.5,
        thickness: float | None = None,
        solution: bool | ArrayLike = False,
    ) -> None:
        """Write the walls as a page in millimetres; an existing file is replaced.

        Lines are joined as far as they go, none is there twice, and they follow one another so that a pen travels
        little: on to the nearest end that is left.

        Parameters
        ----------
        path : str or path-like
            Its ending decides the format: `.svg`, `.dxf` (needs ezdxf, the extra `cad`), `.pdf` or `.png` (need
            Matplotlib, the extra `plot`; 300 pixels an inch). Layers are named walls and solution.
        page : (width, height)
            Of the page, millimetres; A4 upright by default.
        margin : float
            Kept free on all sides, millimetres.
        pen : float
            Width of the lines, millimetres.
        thickness : float, optional
            Draw walls of this thickness, millimetres, as closed outlines (needs Shapely, the extra `graph`).
        solution : bool or (k,) array_like of int
            Draw the way between the `ends`, or the way given, as a layer of its own.

        Raises
        ------
        TypeError, ValueError
            If an argument is of the wrong type or out of range, or the ending is another.
        CrazingError
            If there is no wall to be drawn.
        OSError
            If the file cannot be written; what stood there before is then untouched.
        ImportError
            If a package that the format needs is not installed.

        Examples
        --------
        >>> import os, tempfile
        >>> import crazing as cz
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = os.path.join(folder, "maze.svg")
        ...     cz.maze(cz.sample.uniform(50, rng=2), rng=2).save(path, solution=True)
        ...     with open(path) as file:
        ...         print(file.readline()[:4])
        <svg
        """
        size = period_pair(page, "page")
        margin, pen = number(margin, "margin", low=0), number(pen, "pen", low=0)
        thickness = None if thickness is None else number(thickness, "thickness", low=1e-3)
        way = self._way(solution)
        drawn = None if way is None else self.path(way)
        sheet(self.walls, drawn, page=size, margin=margin, pen=pen, thickness=thickness).save(path)

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
        What the walls of Voronoi cells are clipped to. By default the bounding box of the points, grown by a tenth.
    period : (width, height), optional
        Carve on a torus: ways leave on one side and come in on the opposite one, see :func:`crazing.diagram`.
    within : optional
        Carve in a shape: its ring as a (k, 2) array, a list of rings (a point in an odd number of them is inside, so
        that a ring in a ring is a hole), a polygon of shapely or another object with `__geo_interface__`, GeoJSON, or
        a picture (a mask of bools, or an image whose border is outside; in pixels, y up). Walls are clipped to it, and
        only those that have a length inside are doors. A cell that the outline cuts into parts is still one cell.
    rng : int, numpy.random.Generator or None, optional
        Seed. The same seed gives the same maze on every platform.

    Returns
    -------
    Maze
        Depth-first truly: every shut door joins a cell and an ancestor of it in the tree of passages.

    Raises
    ------
    CrazingError
        If a coordinate is NaN or infinite, or `start` is no cell.
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
    delaunay = choice(cells, "cells", ("voronoi", "delaunay")) == "delaunay"
    choice(tree, "tree", TREES)
    diagram = as_tiling(points, period)
    if within is not None:
        if delaunay or bounds is not None or diagram.period is not None:
            raise ValueError("within is for Voronoi cells without bounds and period")
        return _within(diagram, as_region(within), tree, start, opening, _rng.key(rng))
    box = bounds_of(diagram, bounds)
    doors = None if diagram.period is None or delaunay else _torus_doors(diagram)
    carved = _core.carve(diagram.arrays, delaunay, doors, tree, start, opening, _rng.key(rng))
    return Maze(diagram, cells, *carved, box)


def _within(
    diagram: Diagram, region: Region, tree: str, start: int | None, opening: float, key: tuple[int, int]
) -> Maze:
    box = bounds_tuple(region.bounds, "the extent of within")
    everything = np.ones(len(diagram.edges), dtype=bool)
    found = _core.dual_edges_within(diagram.arrays, box, region.coords, region.offsets, everything)
    rows, cut = found[2], found[3]
    doors = np.zeros(len(diagram.edges), dtype=bool)
    doors[rows] = True
    inside = np.unique(diagram.edges[rows])
    if start is None and len(inside):
        start = int(inside[key[0] * len(inside) >> 64])
    carved = _core.carve(diagram.arrays, False, doors, tree, start, opening, key)
    rim = np.unique(diagram.edges[cut[doors[cut]]]).astype(np.int32)
    return Maze(diagram, "voronoi", *carved, box, region, rim)


def _torus_doors(diagram: Diagram) -> NDArray[np.bool_]:
    """Whether each dual edge has a length: it may join a vertex to a copy of itself, which is no point."""
    right, left = diagram.vertices[diagram.dual_edges[:, 0]], diagram.vertices[diagram.dual_edges[:, 1]]
    return np.asarray((right != left).any(axis=1) | diagram.dual_shifts.any(axis=1))


def _nearest_ends(diagram: Diagram) -> NDArray[np.float64]:
    """For each dual edge the end nearer to the two sites; their middle where both ends are at infinity."""
    middles = diagram.sites[diagram.edges].mean(axis=1)
    if not len(diagram.vertices):
        return np.asarray(middles)
    ends = diagram.vertices[diagram.dual_edges]
    away = np.hypot(*np.moveaxis(ends - middles[:, None], 2, 0))
    away[diagram.dual_edges < 0] = np.inf
    nearest = ends[np.arange(len(ends)), away.argmin(axis=1)]
    return np.asarray(np.where(np.isfinite(away.min(axis=1))[:, None], nearest, middles))
