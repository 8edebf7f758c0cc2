"""The cells of a maze as areas to be filled."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.extras import require
from crazing.region import Region

if TYPE_CHECKING:
    from crazing.maze import Maze

Line = NDArray[np.float64]


@dataclass(frozen=True)
class Mosaic:
    """Areas in data units: inside an area is what its rings wind about (the rule that graphics call nonzero)."""

    cells: NDArray[np.int32]
    #: The rings of every area.
    areas: list[list[Line]]
    #: The rings that all areas are to be clipped to; None where they need not be.
    clip: list[Line] | None


def mosaic(maze: Maze, wanted: NDArray[np.bool_]) -> Mosaic:
    """The areas of the wanted cells.

    Voronoi cells are polygons within the bounds; on a torus, all copies that reach into the period. Of a cell that the
    outline of a shape cuts into parts, each is an area of its own.
    """
    if maze.diagram.period is not None:
        return _tiled(maze, wanted)
    if maze.cells == "delaunay":
        rows = np.flatnonzero(wanted).astype(np.int32)
        return Mosaic(rows, [[corners] for corners in maze.diagram.sites[maze.diagram.triangles[rows]]], None)
    if maze.region is not None:
        return _within(maze, maze.region, wanted)
    return Mosaic(*_polygons(maze, None, maze.bounds, wanted), None)


def fill(ax: Any, mosaic: Mosaic, values: NDArray[np.int32]) -> None:
    """Draws the areas on Matplotlib axes below all else, coloured by the value of their cell."""
    collections, paths = require("matplotlib.collections", "plot"), require("matplotlib.path", "plot")
    drawn = [compound(paths.Path, rings) for rings in mosaic.areas]
    # Edges of the same colour, or the page would shine through between neighbours.
    areas = collections.PathCollection(drawn, array=values[mosaic.cells], edgecolors="face", linewidths=0.4, zorder=0)
    ax.add_collection(areas, autolim=False)
    if mosaic.clip is not None:
        areas.set_clip_path(compound(paths.Path, mosaic.clip), ax.transData)


def compound(path: Any, rings: list[Line]) -> Any:
    """Rings as one path of Matplotlib."""
    return path.make_compound_path(*(path(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))


def _polygons(
    maze: Maze, steps: Line | None, bounds: tuple[float, float, float, float], wanted: NDArray[np.bool_]
) -> tuple[NDArray[np.int32], list[list[Line]]]:
    coords, offsets = _core.mosaic(maze.diagram.arrays, steps, bounds)
    sites = len(maze.diagram.sites)
    rows = np.flatnonzero(wanted[:sites] & (np.diff(offsets) > 0)).astype(np.int32)
    return rows, [[coords[offsets[row] : offsets[row + 1]]] for row in rows.tolist()]


def _tiled(maze: Maze, wanted: NDArray[np.bool_]) -> Mosaic:
    d = maze.diagram
    assert d.period is not None
    period = np.array(d.period)
    if maze.cells == "delaunay":
        rows = np.flatnonzero(wanted).astype(np.int32)
        areas = [[corners] for corners in _triangles(maze)[rows]]
    else:
        width, height = d.period
        rows, areas = _polygons(maze, d.shifts * period, (-width, -height, width, height), wanted)
    low = np.array([ring.min(axis=0) for (ring,) in areas]).reshape(-1, 2)
    high = np.array([ring.max(axis=0) for (ring,) in areas]).reshape(-1, 2)
    cells, copies = [], []
    for shift in ((a, b) for a in (-1, 0, 1) for b in (-1, 0, 1)):
        step = shift * period
        inside = np.flatnonzero(((high + step > 0) & (low + step < period)).all(axis=1))
        cells.append(rows[inside])
        copies += [[areas[row][0] + step] for row in inside.tolist()]
    frame = np.array([(0, 0), (1, 0), (1, 1), (0, 1)]) * period
    return Mosaic(np.concatenate(cells), copies, [frame])


def _triangles(maze: Maze) -> Line:
    """(t, 3, 2), the corners of the triangles of a torus, counter-clockwise, not torn apart by the seams."""
    d = maze.diagram
    start = d.sites[d.edges[:, 0]]
    step = d.sites[d.edges[:, 1]] + d.shifts * np.array(d.period) - start
    # Every edge once for the triangle on its left, and turned round for that on its right.
    triangle = np.concatenate([d.dual_edges[:, 1], d.dual_edges[:, 0]])
    order = np.argsort(triangle, kind="stable").reshape(-1, 3)
    step = np.concatenate([step, -step])[order]
    start = np.concatenate([start, d.sites[d.edges[:, 1]]])[order[:, 0]]
    first, second, third = np.moveaxis(step, 1, 0)
    # The side after the first is the one that turns left.
    turns_left = first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0
    following = np.where(turns_left[:, None], second, third)
    return np.stack([start, start + first, start + first + following], axis=1)


def _within(maze: Maze, region: Region, wanted: NDArray[np.bool_]) -> Mosaic:
    assert maze.plan is not None
    clip = [region.coords[a:b] for a, b in pairwise(region.offsets.tolist())]
    sites = len(maze.diagram.sites)
    parted = np.zeros(maze.size, dtype=bool)
    parted[maze.plan.parts] = True
    parted[sites:] = True
    rows, areas = _polygons(maze, None, region.bounds, wanted & ~parted)
    borders = _borders(maze, region, wanted & parted)
    cells = np.concatenate([rows, np.array(list(borders), dtype=np.int32)])
    return Mosaic(cells, areas + list(borders.values()), clip)


def _borders(maze: Maze, region: Region, wanted: NDArray[np.bool_]) -> dict[int, list[Line]]:
    """Triangles from one corner of each part to every piece of its border: it is what they wind about."""
    assert maze.plan is not None
    pieces: dict[int, list[Line]] = {cell: [] for cell in np.flatnonzero(wanted).tolist()}
    everything = np.ones(len(maze.plan.sides), dtype=bool)
    vertices, edges, doors = _core.region_doors(maze.diagram.arrays, region.rings, everything)
    sides = maze.plan.sides[doors]
    # A door runs with its first cell on the left.
    for side, ends in ((0, edges), (1, edges[:, ::-1])):
        for row in np.flatnonzero(wanted[sides[:, side]] & (sides[:, side] >= 0)).tolist():
            pieces[int(sides[row, side])].append(vertices[ends[row]])
    _, _, _, cells, arcs, _ = _core.region_cells(maze.diagram.arrays, region.rings)
    for row in np.flatnonzero(wanted[cells]).tolist():
        pieces[int(cells[row])].append(region.along(*arcs[row].tolist()))
    return {
        cell: [np.vstack([lines[0][0], ends]) for line in lines for ends in pairwise(line)]
        for cell, lines in pieces.items()
        if lines
    }
