"""Mazes on Matplotlib axes and on paper."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.arguments import cell_row, number, period_pair
from crazing.graph import PlanarGraph
from crazing.mosaic import fill, mosaic
from crazing.path import path
from crazing.sheet import sheet

if TYPE_CHECKING:
    from crazing.maze import Maze


class Drawing:
    """What a maze does with its walls, ways and distances: draw them."""

    @property
    def _maze(self) -> Maze:
        return cast("Maze", self)

    def path(self, way: ArrayLike) -> PlanarGraph:
        """Draw a way: from cell to cell through the middle of each door.

        Parameters
        ----------
        way : (k,) array_like of int
            Cells, each the neighbour of the one before through an open door: what `solve` and `longest` give.

        Returns
        -------
        PlanarGraph
            It meets no wall. Within a shape, a way between the `ends` begins and ends in the gaps of the outline. Of
            a periodic maze it is cut at the sides of the period.

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
        return path(self._maze, cell_row(way, "way", self._maze.size))

    def _way(self, solution: bool | ArrayLike) -> NDArray[np.int32] | None:
        """The way between the `ends` for True, none for False, else the cells given."""
        if isinstance(solution, (bool, np.bool_)):
            maze = self._maze
            return maze.solve(*maze.ends) if solution and maze.ends else None
        return cell_row(solution, "solution", self._maze.size)

    def _away(self, distances: bool | int) -> NDArray[np.int32]:
        """The distance of every cell from the start for True, else from the cell given."""
        return self._maze.distances(None if isinstance(distances, (bool, np.bool_)) else distances)

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
            Fill every cell by its distance from `start`, or from the cell given; those out of reach stay empty. Further
            keywords such as `cmap` may be set on the collection, which is the first of the axes.
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
        ax = self._maze.walls.plot(ax, **line_style)
        if distances is not False:
            away = self._away(distances)
            fill(ax, mosaic(self._maze, away >= 0), away)
        way = self._way(solution)
        if way is not None:
            # Doors of cells at the rim may lie far beyond the bounds: what is shown are the walls.
            shown = ax.dataLim.frozen()
            self.path(way).plot(ax, color="red")
            ax.dataLim.set(shown)
            ax.autoscale_view()
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
        distances: bool | int = False,
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
        distances : bool or int
            Fill every cell by its distance from `start`, or from the cell given, from pale to dark: a layer of its own,
            below the others. Not in DXF, which has lines only.

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
        page_of_maze = sheet(self._maze.walls, drawn, page=size, margin=margin, pen=pen, thickness=thickness)
        if distances is not False:
            away = self._away(distances)
            page_of_maze = page_of_maze.filled(mosaic(self._maze, away >= 0), away)
        page_of_maze.save(path)
