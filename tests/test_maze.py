"""Mazes: the laws, with networkx and SciPy as witnesses."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import shortest_path

import crazing as cz

KINDS = ["voronoi", "delaunay"]
TREES = ["depth-first", "kruskal", "prim", "wilson"]


def sides(m: cz.Maze) -> np.ndarray:
    return m.diagram.dual_edges if m.cells == "delaunay" else m.diagram.edges


def beside(m: cz.Maze) -> set[tuple[int, int]]:
    """Voronoi cells that share a border of some length on the page, by shapely."""
    xmin, ymin, xmax, ymax = m.bounds
    sites = shapely.MultiPoint(m.diagram.sites)
    far = shapely.box(xmin - 9, ymin - 9, xmax + 9, ymax + 9)
    found = shapely.voronoi_polygons(sites, extend_to=far, ordered=True)
    cells = shapely.intersection(np.array(found.geoms), shapely.box(*m.bounds))
    first, second = shapely.STRtree(cells).query(cells, predicate="intersects")
    shared = shapely.length(shapely.intersection(cells[first], cells[second])) > 1e-9
    return set(zip(first[shared & (first < second)].tolist(), second[shared & (first < second)].tolist(), strict=True))


def size(m: cz.Maze) -> int:
    return len(m.diagram.triangles if m.cells == "delaunay" else m.diagram.sites)


@settings(max_examples=40, deadline=None)
@given(n=st.integers(3, 120), seed=st.integers(0, 10**6), cells=st.sampled_from(["voronoi", "delaunay"]))
def test_passages_are_a_spanning_tree_of_open_doors(n: int, seed: int, cells: str) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=seed), cells=cells, rng=seed)
    tree = nx.Graph(m.passages.tolist())
    tree.add_nodes_from(range(size(m)))
    assert nx.is_tree(tree)
    assert {frozenset(e) for e in sides(m)[m.open].tolist()} == {frozenset(e) for e in m.passages.tolist()}


@settings(max_examples=40, deadline=None)
@given(n=st.integers(3, 120), seed=st.integers(0, 10**6), cells=st.sampled_from(["voronoi", "delaunay"]))
def test_shut_doors_join_a_cell_and_its_ancestor(n: int, seed: int, cells: str) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=seed), cells=cells, rng=seed)
    parent = dict(m.passages[:, ::-1].tolist())

    def ancestors(cell: int) -> set[int]:
        found = {cell}
        while cell in parent:
            cell = parent[cell]
            found.add(cell)
        return found

    neighbours = beside(m) if cells == "voronoi" else sides(m)[~m.open].tolist()
    for a, b in neighbours:
        assert a < 0 or b < 0 or a in ancestors(b) or b in ancestors(a)


@settings(max_examples=20, deadline=None)
@given(n=st.integers(2, 100), seed=st.integers(0, 10**6), tree=st.sampled_from(TREES))
def test_no_way_leaves_the_page(n: int, seed: int, tree: str) -> None:
    page = (0.2, 0.3, 0.8, 0.6)
    m = cz.maze(cz.sample.uniform(n, rng=seed), tree=tree, bounds=page, rng=seed)
    neighbours = nx.Graph(list(beside(m)))
    passages = nx.Graph(m.passages.tolist())
    assert {frozenset(pair) for pair in passages.edges} <= {frozenset(pair) for pair in neighbours.edges}
    # Of the cells on the page none is cut off.
    assert nx.number_connected_components(neighbours) <= 1
    assert len(m.passages) == max(len(neighbours) - 1, 0)
    assert not len(neighbours) or m.start in neighbours
    line = shapely.MultiLineString(list(m.path(m.longest()).segments))
    assert line.within(shapely.box(*page).buffer(1e-12)) or line.is_empty
    assert not line.intersects(shapely.MultiLineString(list(m.walls.segments)))


def test_a_page_that_ends_along_walls_has_no_door_there() -> None:
    grid = np.stack(np.meshgrid(np.arange(8.0), np.arange(8.0)), axis=-1).reshape(-1, 2)
    m = cz.maze(grid, bounds=(-0.5, 1.5, 3.5, 6.5), rng=3)
    inside = (grid[:, 0] < 3.5) & (grid[:, 1] > 1.5) & (grid[:, 1] < 6.5)
    cells = m.diagram.site_of[inside]
    assert np.isin(m.passages, cells).all()
    assert len(m.passages) == inside.sum() - 1


def test_walls_have_no_cycle_and_with_the_passages_make_the_diagram() -> None:
    m = cz.maze(cz.sample.normal(500, rng=4), rng=4, bounds=(-9, -9, 9, 9))
    g = m.walls
    # Walls are cut at the bounds, so a tree reaches the frame more than once; nothing encloses a cell.
    assert len(g.edges) == len(np.unique(g.edges)) - g.components
    assert int(m.open.sum()) + int((~m.open).sum()) == len(m.diagram.edges)


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
def test_solution_is_scipys_shortest_way(cells: str) -> None:
    m = cz.maze(cz.sample.uniform(400, rng=6), cells=cells, rng=6)
    n = size(m)
    a, b = sides(m)[m.open].T
    distance = shortest_path(coo_matrix((np.ones(len(a)), (a, b)), (n, n)), directed=False, unweighted=True)
    doors = {frozenset(pair) for pair in m.passages.tolist()}
    for source, target in [(0, n - 1), (3, 3), (n // 2, 1)]:
        way = m.solve(source, target)
        assert (way[0], way[-1]) == (source, target)
        assert len(way) == distance[source, target] + 1
        assert all(frozenset(step) in doors for step in zip(way[:-1].tolist(), way[1:].tolist(), strict=True))


@settings(max_examples=60, deadline=None)
@given(n=st.integers(3, 80), seed=st.integers(0, 10**6), tree=st.sampled_from(TREES), cells=st.sampled_from(KINDS))
def test_every_tree_spans_and_networkx_agrees_on_distances(n: int, seed: int, tree: str, cells: str) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=seed), cells=cells, tree=tree, rng=seed)
    graph = nx.Graph(sides(m)[m.open].tolist())
    graph.add_nodes_from(range(m.size))
    assert nx.is_tree(graph)
    found = nx.single_source_shortest_path_length(graph, m.start)
    assert m.distances().tolist() == [found[cell] for cell in range(m.size)]
    assert len(m.longest()) == nx.diameter(graph) + 1
    assert len(m.solve(m.longest()[0], m.longest()[-1])) == len(m.longest())


def test_trees_differ_as_makers_say() -> None:
    d = cz.diagram(cz.sample.uniform(3000, rng=1))

    def dead_ends(tree: str) -> int:
        m = cz.maze(d, tree=tree, rng=1)
        return int((np.bincount(m.passages.ravel()) == 1).sum())

    assert dead_ends("depth-first") < dead_ends("wilson") < dead_ends("prim")
    assert dead_ends("depth-first") < dead_ends("kruskal") < dead_ends("prim")


def test_longest_of_shut_doors_is_one_cell_and_distances_tell_what_is_out_of_reach() -> None:
    m = cz.maze(cz.sample.uniform(40, rng=1), opening=0, rng=1)
    assert len(m.longest()) == 1
    assert sorted(m.distances(7).tolist()) == [-1] * 39 + [0]
    empty = cz.maze([])
    assert (len(empty.longest()), len(empty.distances())) == (0, 0)


def test_no_way_through_shut_doors_is_empty() -> None:
    m = cz.maze(cz.sample.uniform(40, rng=1), opening=0, rng=1)
    assert not m.open.any()
    assert m.solve(0, 1).tolist() == []
    assert m.solve(5, 5).tolist() == [5]


def test_same_seed_same_maze_and_other_seed_another() -> None:
    d = cz.diagram(cz.sample.uniform(200, rng=0))
    assert cz.maze(d, rng=5) == cz.maze(d, rng=5)
    assert cz.maze(d, rng=5) != cz.maze(d, rng=6)
    generator = np.random.default_rng(5)
    assert cz.maze(d, rng=generator) == cz.maze(d, rng=5)
    assert cz.maze(d, rng=generator) != cz.maze(d, rng=5)
    assert cz.maze(d, start=17, rng=5).passages[0, 0] == 17


def test_known_answer() -> None:
    m = cz.maze([(0, 0), (2, 0), (0, 2), (2, 2), (1, 1.1)], rng=42)
    assert (m.start, m.passages.tolist()) == KNOWN


def test_points_on_a_line_are_a_corridor() -> None:
    m = cz.maze([(float(i), 0.0) for i in range(9)], start=0, rng=0)
    assert m.solve(0, 8).tolist() == list(range(9))
    assert len(m.walls.edges) == 0


def test_a_square_grid_has_no_door_through_a_corner() -> None:
    m = cz.maze([(x, y) for x in range(6) for y in range(6)], rng=3)
    steps = np.abs(np.diff(m.diagram.sites[m.passages], axis=1)[:, 0]).sum(axis=1)
    assert (steps == 1).all()


def test_bad_cells_are_named() -> None:
    m = cz.maze(cz.sample.uniform(10, rng=1), rng=1)
    with pytest.raises(cz.CrazingError, match="target is 10; a cell from 0 to less than 10 is wanted"):
        m.solve(0, 10)
    with pytest.raises(cz.CrazingError, match="start"):
        cz.maze(cz.sample.uniform(10, rng=1), start=10)


KNOWN = (0, [[0, 1], [1, 3], [3, 2], [2, 4]])
