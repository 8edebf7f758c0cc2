"""The walls of a maze as a drawing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from crazing import _core
from crazing.diagram import tiled
from crazing.graph import PlanarGraph

if TYPE_CHECKING:
    from crazing.maze import Maze


def walls(maze: Maze) -> PlanarGraph:
    """The shut doors; within a shape its outline too, with gaps at the ends."""
    d, shut = maze.diagram, ~maze.open
    if maze.plan is not None:
        return _triangles(maze) if maze.cells == "delaunay" else _cells(maze)
    if d.period is not None and maze.cells == "delaunay":
        return tiled(d.sites, d.edges[shut], d.shifts[shut], d.period)
    if d.period is not None:
        return tiled(d.vertices, d.dual_edges[shut], d.dual_shifts[shut], d.period)
    if maze.cells == "delaunay":
        return PlanarGraph(d.sites, d.edges[shut])
    vertices, edges, _ = _core.dual_edges(d.arrays, maze.bounds, shut)
    return PlanarGraph(vertices, edges)


def _triangles(maze: Maze) -> PlanarGraph:
    assert maze.plan is not None
    d = maze.diagram
    drawn = d.constrained | ((maze.plan.sides[:, 0] >= 0) & ~maze.plan.open)
    drawn = drawn.copy()
    drawn[[int(place) for _, place, _ in gaps(maze).values()]] = False
    return PlanarGraph(d.sites, d.edges[drawn])


def _cells(maze: Maze) -> PlanarGraph:
    assert maze.plan is not None and maze.region is not None
    shut = ~maze.plan.open
    vertices, edges, _ = _core.region_doors(maze.diagram.arrays, maze.region.rings, shut)
    outline = maze.region.opened([(start, end) for start, _, end in gaps(maze).values()])
    joined = np.concatenate([vertices, outline.vertices])
    return PlanarGraph(joined, np.concatenate([edges, outline.edges + np.int32(len(vertices))]))


def gaps(maze: Maze) -> dict[int, tuple[float, float, float]]:
    """For each end of a maze within a shape where its gap in the outline begins, has its middle, and ends.

    It is in the longest stretch of the outline that the cell has, and as wide as the widest of its doors at most. Of
    triangles the places are edges.
    """
    plan, region, found = maze.plan, maze.region, {}
    for cell in maze.ends if plan is not None and region is not None else ():
        assert plan is not None and region is not None
        arcs = plan.arcs[plan.rim == cell]
        if maze.cells == "delaunay":
            longest = arcs[np.argmax(maze.diagram.delaunay.lengths[arcs[:, 0].astype(int)])]
            found[cell] = (longest[0], longest[0], longest[0])
            continue
        doors = (plan.sides == cell).any(axis=1)
        vertices, edges, _ = _core.region_doors(maze.diagram.arrays, region.rings, doors)
        width = float(PlanarGraph(vertices, edges).lengths.max())
        found[cell] = region.middle(max(arcs, key=region.span), width)
    return found
