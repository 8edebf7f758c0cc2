"""Mazes in nasty shapes: the way meets no wall, and every part of a cell is a cell, by Shapely and NetworkX."""

from __future__ import annotations

from functools import cache
from typing import Any

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz

Rings = list[np.ndarray]


def star(corners: int, low: float, high: float, at: tuple[float, float] = (0.5, 0.5)) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 2 * corners, endpoint=False) + 0.1
    radius = np.where(np.arange(2 * corners) % 2, low, high)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn)]) + at


def comb(teeth: int) -> np.ndarray:
    x = np.arange(teeth)[:, None] + np.array([0.1, 0.4, 0.5])
    y = np.broadcast_to([1.0, 1.0, 0.1], x.shape)
    return np.vstack([(0.0, 0.0), np.column_stack([x.ravel() / teeth, y.ravel()]), (1.0, 0.0)])


def spiral(turns: int = 4) -> np.ndarray:
    turn = np.linspace(3.8, turns * 2 * np.pi, 120)
    arms = []
    for radius in (turn, turn - 3.6):
        around = np.column_stack([np.cos(turn), np.sin(turn)])
        arms.append(0.5 + 0.5 * radius[:, None] / turn[-1] * around)
    return np.vstack([arms[0], arms[1][::-1]])


SQUARE = np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)])
SHAPES: dict[str, Rings] = {
    "star": [star(9, 0.15, 0.5)],
    "hole": [star(7, 0.25, 0.5), star(5, 0.04, 0.1)],
    "comb": [comb(12)],
    "spiral": [spiral()],
    "many holes": [SQUARE, *(star(4, 0.01, 0.03, (x / 6, y / 6)) for x in range(1, 6) for y in range(1, 6))],
    "squares that touch": [SQUARE / 2, SQUARE / 2 + 0.5],
    "a hole that touches": [SQUARE, np.array([(0.0, 0.5), (0.3, 0.3), (0.6, 0.5), (0.3, 0.7)])],
    "an island in a hole": [SQUARE, SQUARE * 0.8 + 0.1, SQUARE * 0.5 + 0.25],
}


@cache
def polygon(name: str) -> Any:
    shape = shapely.Polygon()
    for ring in SHAPES[name]:
        shape = shape.symmetric_difference(shapely.Polygon(ring))
    return shape


@settings(max_examples=40, deadline=None)
@given(
    name=st.sampled_from(sorted(SHAPES)),
    cells=st.sampled_from(["voronoi", "delaunay"]),
    n=st.integers(1, 200),
    seed=st.integers(0, 10**6),
)
def test_the_way_meets_no_wall_and_stays_inside(name: str, cells: str, n: int, seed: int) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=seed), cells=cells, within=SHAPES[name], rng=seed)
    walls = shapely.linestrings(m.walls.segments)
    assert polygon(name).buffer(1e-9).covers(shapely.union_all(walls))
    assert nx.is_forest(nx.Graph(m.passages.tolist())) if len(m.passages) else not m.open.any()
    if not m.ends:
        return
    way = m.solve(*m.ends)
    inner = way[len(way) // 4 : 1 + len(way) // 2]
    for line in (m.path(way), m.path(way[::-1]), m.path(inner)):
        steps = shapely.linestrings(line.segments)
        assert shapely.STRtree(walls).query(steps, predicate="intersects").shape[1] == 0
        assert polygon(name).buffer(1e-9).covers(shapely.union_all(steps))
    # It starts and ends on the outline, in the gaps.
    ends = shapely.points(m.path(way).vertices[[0, -1]])
    assert shapely.distance(ends, polygon(name).boundary).max() < 1e-9


def parts(d: cz.Diagram, shape: Any) -> nx.MultiGraph:
    """Every part of every cell, and every wall between two of them."""
    cells = shapely.get_parts(
        shapely.voronoi_polygons(shapely.MultiPoint(d.sites), extend_to=shapely.box(-9, -9, 9, 9))
    )
    rooms = [
        part for cell in cells for part in shapely.get_parts(shapely.intersection(cell, shape)) if part.area > 1e-14
    ]
    graph = nx.MultiGraph()
    graph.add_nodes_from(range(len(rooms)))
    for i, j in shapely.STRtree(rooms).query(rooms, predicate="intersects").T.tolist():
        between = shapely.get_parts(shapely.line_merge(shapely.union_all([shapely.intersection(rooms[i], rooms[j])])))
        graph.add_edges_from((i, j) for line in between if i < j and shapely.length(line) > 1e-9)
    graph.remove_nodes_from([room for room in graph if not graph.degree(room)])
    return graph


@settings(max_examples=25, deadline=None)
@given(name=st.sampled_from(sorted(SHAPES)), n=st.integers(2, 60), seed=st.integers(0, 10**6))
def test_every_part_of_a_cell_is_a_cell(name: str, n: int, seed: int) -> None:
    d = cz.diagram(cz.sample.uniform(n, rng=seed))
    m = cz.maze(d, within=SHAPES[name], rng=seed)
    graph = parts(d, polygon(name))
    doors = m.sides[m.sides[:, 0] >= 0]
    ours = nx.MultiGraph(doors.tolist())
    assert sorted(degree for _, degree in ours.degree) == sorted(degree for _, degree in graph.degree)
    assert len(m.passages) == len(graph) - nx.number_connected_components(graph)
    assert m.statistics.cells == len(graph)


@settings(max_examples=40, deadline=None)
@given(name=st.sampled_from(sorted(SHAPES)), n=st.integers(0, 120), seed=st.integers(0, 10**6))
def test_triangles_fill_the_shape(name: str, n: int, seed: int) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=seed), cells="delaunay", within=SHAPES[name], rng=seed)
    d, shape = m.diagram, polygon(name)
    cells = np.unique(m.sides[m.sides >= 0])
    corners = d.sites[d.triangles[cells]]
    rooms = shapely.polygons(corners)
    assert shapely.area(rooms).sum() == pytest.approx(shape.area)
    assert shape.buffer(1e-9).covers(shapely.union_all(rooms))
    outline = d.sites[d.edges[d.constrained]]
    assert np.linalg.norm(outline[:, 0] - outline[:, 1], axis=1).sum() == pytest.approx(shape.length)
    graph = nx.Graph(m.sides[m.sides[:, 0] >= 0].tolist())
    assert len(m.passages) == len(graph) - nx.number_connected_components(graph)
    assert not (m.open & d.constrained).any()


def test_rim_ends_are_farthest_apart() -> None:
    for cells in ("voronoi", "delaunay"):
        m = cz.maze(cz.sample.uniform(300, rng=4), cells=cells, within=SHAPES["hole"], rng=4)
        tree = nx.Graph(m.passages.tolist())
        rim = m.rim.tolist()
        away = {cell: nx.single_source_shortest_path_length(tree, cell) for cell in rim}
        assert len(m.solve(*m.ends)) - 1 == max(away[a][b] for a in rim for b in rim)


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
@pytest.mark.parametrize("n", [1, 2, 3, 4, 60, 400])
def test_the_way_round_a_torus_meets_no_wall(cells: str, n: int) -> None:
    m = cz.maze(cz.sample.uniform(n, bounds=(0, 0, 2, 1), rng=n), cells=cells, period=(2, 1), rng=n)
    line = m.path(m.longest())
    walls = shapely.STRtree(shapely.linestrings(m.walls.segments))
    assert walls.query(shapely.linestrings(line.segments), predicate="crosses").shape[1] == 0


def test_ways_that_are_none_are_named() -> None:
    m = cz.maze(cz.sample.uniform(50, rng=1), within=SHAPES["star"], rng=1)
    far = m.longest()[[0, -1]]
    with pytest.raises(ValueError, match="no open door joins them"):
        m.path(far)
    with pytest.raises(ValueError, match="way goes by cell"):
        m.path([0, 10**6])
    with pytest.raises(TypeError, match="a row of cells is wanted"):
        m.path([[0, 1]])


@pytest.mark.parametrize(
    ("sites", "period"), [([(0.2, 0.3)], (1, 1)), ([(0.1, 0.1), (0.6, 0.5)], (1, 0.7)), ([(0.3, 0.2)], (3, 1))]
)
def test_quad_edges_of_tiny_tori(sites: list, period: tuple) -> None:
    d = cz.diagram(sites, period=period)
    quad = d.quad_edge
    q = quad.all
    np.testing.assert_array_equal(quad.rot(quad.onext(quad.rot(quad.onext(q)))), q)
    np.testing.assert_array_equal(quad.origin(quad.onext(q)), quad.origin(q))
    # Three steps about the triangle on the left come back, and turn left.
    even = q[::2]
    step = np.where((even & 2)[:, None], -1.0, 1.0) * (
        d.sites[d.edges[even >> 2, 1]] + d.shifts[even >> 2] * period - d.sites[d.edges[even >> 2, 0]]
    )
    of = dict(zip(even.tolist(), step, strict=True))
    after = quad.rot(quad.onext(quad.rot(quad.sym(even))))
    np.testing.assert_array_equal(quad.origin(quad.rot(quad.sym(after))), quad.origin(quad.rot(quad.sym(even))))
    for first, second in zip(even.tolist(), after.tolist(), strict=True):
        a, b = of[first], of[second]
        assert a[0] * b[1] - a[1] * b[0] > 0


def doors_of(sites: np.ndarray, rings: Rings) -> list[tuple[float, ...]]:
    """The middle and the length of every door, without the tiniest."""
    m = cz.maze(sites, within=rings, opening=0, rng=1)
    # All doors are shut, and the outline, which comes last, has no gap.
    doors = m.walls.segments[: -len(m.region.coords)]
    lengths = np.linalg.norm(doors[:, 1] - doors[:, 0], axis=1)
    rows = np.column_stack([doors.mean(axis=1), lengths])[lengths > 1e-4]
    # A grid on which no corner of these shapes lies half way.
    return sorted(map(tuple, ((rows * 9973.1).round() + 0.0).tolist()))


FRAME = np.array([(-0.5, -0.5), (3.5, -0.5), (3.5, 3.5), (-0.5, 3.5)])
DIAMOND = np.array([(0.5, 0.0), (0.0, 0.5), (-0.5, 0.0), (0.0, -0.5)])


@settings(max_examples=40, deadline=None)
@given(
    holes=st.sets(st.tuples(st.integers(0, 3), st.integers(0, 3)), max_size=6),
    corners=st.lists(st.tuples(st.integers(-2, 8), st.integers(-2, 8)), min_size=3, max_size=5, unique=True),
)
def test_corners_on_walls_are_as_if_the_points_were_moved_right_and_up_by_next_to_nothing(holes, corners) -> None:
    sites = np.array([(x, y) for x in range(4) for y in range(4)], dtype=float)
    # Diamonds touch all four walls of a cell; another shape has corners on walls and their ends.
    hull = shapely.MultiPoint(np.array(corners) / 2).convex_hull
    shapes = [[2 * FRAME - 1.5, *(DIAMOND + hole for hole in sorted(holes))]]
    if hull.geom_type == "Polygon":
        shapes.append([np.array(hull.exterior.coords)[:-1]])
    for rings in shapes:
        assert doors_of(sites, rings) == doors_of(sites + np.array([2.0**-24, 2.0**-45]), rings)


def test_a_corner_that_touches_a_wall_parts_the_door_on_one_side_only() -> None:
    sites = np.array([(x, y) for x in range(2) for y in range(2)], dtype=float)
    frame = np.array([(-0.5, -0.5), (1.5, -0.5), (1.5, 1.5), (-0.5, 1.5)])
    for at, lengths in (((1.0, 0.0), [0.5, 0.5]), ((0.0, 0.0), [1.0])):
        # From the right the wall, moved right, is met; from the left it is free.
        doors = np.array(doors_of(sites, [frame, DIAMOND + at])) / 9973.1
        lower = np.isclose(doors[:, 0], 0.5, atol=1e-3) & (doors[:, 1] < 0.5)
        np.testing.assert_allclose(doors[lower, 2], lengths, atol=1e-3)


def test_geometries_in_arrays_of_any_kind_are_read() -> None:
    class Column:
        """As a column of GeoPandas: an array in its own right, of objects."""

        def __init__(self, parts: list[Any]) -> None:
            self.parts = parts

        def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
            return np.array(self.parts, dtype=object)

    square = shapely.box(0, 0, 2, 3)
    corners = cz.sample.from_polygon(square)
    single = np.empty((), dtype=object)
    single[()] = square
    for form in (single, Column([square])):
        np.testing.assert_array_equal(cz.sample.from_polygon(form), corners)
    places = [shapely.Point(0, 0), shapely.Point(3, 0), shapely.Point(1, 2)]
    assert cz.diagram(Column(places)) == cz.diagram([(0, 0), (3, 0), (1, 2)])
    single[()] = single
    with pytest.raises(TypeError, match=r"polygon is .*; a polygon, a ring or a list of them is wanted"):
        cz.sample.from_polygon(single)
