"""A way through a maze as a line that meets no wall."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.diagram import Diagram, tiled
from crazing.graph import PlanarGraph
from crazing.walls import gaps

if TYPE_CHECKING:
    from crazing.maze import Maze


def path(maze: Maze, way: NDArray[np.int32]) -> PlanarGraph:
    """The line along the cells of `way`: from a point of every cell to the middle of the door, and on."""
    doors = passed(maze, way)
    if maze.diagram.period is not None:
        return _around(maze, way, doors)
    if maze.plan is not None and maze.cells == "voronoi":
        return _line(_routed(maze, way, doors))
    points = np.empty((2 * len(way) - 1 if len(way) else 0, 2))
    points[::2] = maze.centres[way]
    points[1::2] = _door_middles(maze, doors)
    if maze.cells == "voronoi" and len(doors):
        points = _on_page(points, maze.bounds)
    if _enters(maze, way):
        ends = [maze.diagram.sites[maze.diagram.edges[int(gaps(maze)[int(way[i])][1])]].mean(axis=0) for i in (0, -1)]
        points = np.vstack([ends[0], points, ends[1]])
    return _line(points)


def passed(maze: Maze, way: NDArray[np.int32]) -> NDArray[np.intp]:
    """The open door between each cell of a way and the next."""
    open_doors = maze.open if maze.plan is None else maze.plan.open
    doors = np.flatnonzero(open_doors)

    def keys(pairs: NDArray[np.int32]) -> NDArray[np.int64]:
        low, high = np.sort(pairs.astype(np.int64), axis=1).T
        return np.asarray(low * maze.size + high)

    of_doors = keys(maze.sides[doors])
    order = np.argsort(of_doors, kind="stable")
    steps = np.column_stack([way[:-1], way[1:]])
    wanted = keys(steps)
    at = np.searchsorted(of_doors[order], wanted)
    found = order[np.minimum(at, len(order) - 1)] if len(order) else np.zeros(len(steps), dtype=np.intp)
    good = of_doors[found] == wanted if len(order) else np.zeros(len(steps), dtype=bool)
    if not good.all():
        a, b = steps[int(good.argmin())].tolist()
        raise ValueError(f"way goes from cell {a} to {b}; no open door joins them")
    return np.asarray(doors[found] if len(order) else found)


def _line(points: NDArray[np.float64]) -> PlanarGraph:
    row = np.arange(len(points), dtype=np.int32)
    return PlanarGraph(points, np.column_stack([row[:-1], row[1:]]))


def _on_page(points: NDArray[np.float64], bounds: tuple[float, float, float, float]) -> NDArray[np.float64]:
    """The same, but for sites beyond the bounds: the way goes straight from door to door, or begins and ends at one."""
    low, high = np.reshape(bounds, (2, 2))
    is_within = np.asarray(((points >= low) & (points <= high)).all(axis=1))
    is_within[1::2] = True
    return np.asarray(np.compress(is_within, points, axis=0))


def _enters(maze: Maze, way: NDArray[np.int32]) -> bool:
    """Whether a way goes from one end of a maze within a shape to the other."""
    return maze.plan is not None and len(way) > 1 and {int(way[0]), int(way[-1])} == set(maze.ends)


def _routed(maze: Maze, way: NDArray[np.int32], doors: NDArray[np.intp]) -> NDArray[np.float64]:
    assert maze.plan is not None and maze.region is not None
    count = len(maze.diagram.sites)
    site = np.concatenate([np.arange(count, dtype=np.int32), maze.plan.parts])[way]
    places = gaps(maze) if _enters(maze, way) else {}
    ends = tuple(places[int(way[i])][1] if places else None for i in (0, -1))
    pieces = maze.plan.pieces(doors, len(maze.diagram.edges))
    return _core.region_route(maze.diagram.arrays, maze.region.rings, site, pieces, (ends[0], ends[1]))


def _door_middles(maze: Maze, rows: NDArray[np.intp]) -> NDArray[np.float64]:
    """The middle of each door, of its part in the bounds; of one too short to be cut there an end."""
    d = maze.diagram
    if maze.cells == "delaunay":
        return np.asarray(d.sites[d.edges[rows]].mean(axis=1))
    wanted = np.zeros(len(d.edges), dtype=bool)
    wanted[rows] = True
    vertices, edges, parts = _core.dual_edges(d.arrays, maze.bounds, wanted)
    middles = _nearest_ends(d)
    middles[parts] = vertices[edges].mean(axis=1)
    return np.asarray(middles[rows])


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


def _around(maze: Maze, way: NDArray[np.int32], doors: NDArray[np.intp]) -> PlanarGraph:
    """On a torus, cut where it leaves the period: each step from a point of the cell to the door and on."""
    d = maze.diagram
    assert d.period is not None
    period = np.array(d.period)
    # The quarter-edge of every door that starts at the site left, or has the triangle left on its left.
    q = 4 * doors.astype(np.int32)
    here = d.edges[doors, 0] if maze.cells == "voronoi" else d.dual_edges[doors, 1]
    q = np.where(here == way[:-1], q, q + 2).astype(np.int32)
    if maze.cells == "voronoi":
        start = np.zeros((len(q), 2))
        middle = (_circumcentres(d, q, period) + _across(d, q, period)) / 2
        far = _step(d, q, period)
    else:
        start = _centroids(d, q, period)
        middle = _step(d, q, period) / 2
        far = _step(d, q, period) + _centroids(d, d.quad_edge.sym(q), period)
    # All of these from the origin of the quarter-edge on; now as points of the period, and periods between them.
    origin = d.sites[d.quad_edge.origin(q)]
    places = [np.asarray(origin + away) for away in (start, middle, far)]
    turns = [np.floor(place / period) for place in places]
    inside = [np.clip(place - turn * period, 0, period) for place, turn in zip(places, turns, strict=True)]
    rows = np.arange(len(q), dtype=np.int32)
    edges = np.concatenate([np.column_stack([rows + i * len(q), rows + (i + 1) * len(q)]) for i in (0, 1)])
    shifts = np.concatenate([turns[1] - turns[0], turns[2] - turns[1]]).astype(np.int8)
    return tiled(np.concatenate(inside), edges.astype(np.int32), shifts, d.period)


def _step(d: Diagram, q: NDArray[np.int32], period: NDArray[np.float64]) -> NDArray[np.float64]:
    """From the origin of each quarter-edge (an even one) to its end."""
    quad = d.quad_edge
    shift = np.where((q & 2)[:, None], -d.shifts[q >> 2], d.shifts[q >> 2])
    return np.asarray(d.sites[quad.origin(quad.sym(q))] + shift * period - d.sites[quad.origin(q)])


def _following(d: Diagram, q: NDArray[np.int32]) -> NDArray[np.int32]:
    """The next edge about the triangle on the left: first Rot^-1, then Onext, then Rot."""
    quad = d.quad_edge
    return quad.rot(quad.onext(quad.rot(quad.sym(q))))


def _centroids(d: Diagram, q: NDArray[np.int32], period: NDArray[np.float64]) -> NDArray[np.float64]:
    """The centroid of the triangle on the left, from the origin."""
    first, second = _step(d, q, period), _step(d, _following(d, q), period)
    return np.asarray((2 * first + second) / 3)


def _across(d: Diagram, q: NDArray[np.int32], period: NDArray[np.float64]) -> NDArray[np.float64]:
    """The circumcentre of the triangle on the right, from the origin."""
    back = d.quad_edge.sym(q)
    return np.asarray(_step(d, q, period) + _circumcentres(d, back, period))


def _circumcentres(d: Diagram, q: NDArray[np.int32], period: NDArray[np.float64]) -> NDArray[np.float64]:
    """The circumcentre of the triangle on the left, from the origin."""
    b = _step(d, q, period)
    c = b + _step(d, _following(d, q), period)
    area = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    b2, c2 = (b**2).sum(axis=1), (c**2).sum(axis=1)
    return np.column_stack([c[:, 1] * b2 - b[:, 1] * c2, b[:, 0] * c2 - c[:, 0] * b2]) / area[:, None]
