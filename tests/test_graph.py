"""Drawings against NetworkX, SciPy and Shapely, on edges with loops, duplicates and lonely vertices."""

from __future__ import annotations

import copy
import pickle
from collections import Counter
from collections.abc import Iterable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import crazing as cz

networkx = pytest.importorskip("networkx")
shapely = pytest.importorskip("shapely")


@st.composite
def graphs(draw: st.DrawFn) -> cz.PlanarGraph:
    """Few vertices make loops, duplicates and rings frequent; many make chains."""
    count = draw(st.integers(1, 30))
    row = st.integers(0, count - 1)
    edges = draw(st.lists(st.tuples(row, row), max_size=40))
    coordinate = st.floats(-1e6, 1e6)
    vertices = draw(st.lists(st.tuples(coordinate, coordinate), min_size=count, max_size=count))
    return cz.PlanarGraph(vertices, edges)


def counted(pairs: Iterable[Any]) -> Counter[Any]:
    return Counter(tuple(sorted(map(tuple, pair))) for pair in pairs)


def multigraph(graph: cz.PlanarGraph) -> Any:
    peer = networkx.MultiGraph()
    peer.add_nodes_from(range(len(graph.vertices)))
    peer.add_edges_from(graph.edges.tolist())
    return peer


@given(graphs())
def test_degrees_and_leaves_are_those_of_networkx(graph: cz.PlanarGraph) -> None:
    degrees = dict(multigraph(graph).degree)
    assert graph.degrees.tolist() == [degrees[row] for row in range(len(graph.vertices))]
    assert graph.leaves == sum(degree == 1 for degree in degrees.values())


@given(graphs())
def test_components_are_those_of_scipy(graph: cz.PlanarGraph) -> None:
    count, ends = len(graph.vertices), graph.edges
    _, peer = connected_components(coo_array((np.ones(len(ends)), (ends[:, 0], ends[:, 1])), shape=(count, count)))
    used = graph.degrees > 0
    assert ((graph.labels >= 0) == used).all()
    assert graph.components == len(np.unique(peer[used]))
    pairs = set(zip(graph.labels[used].tolist(), peer[used].tolist(), strict=True))
    assert len(pairs) == graph.components
    firsts = list(dict.fromkeys(graph.labels[ends[:, 0]].tolist()))
    assert firsts == list(range(graph.components))


@given(graphs())
def test_polylines_hold_every_segment_once(graph: cz.PlanarGraph) -> None:
    coords, offsets = graph.polylines()
    assert offsets[0] == 0
    assert offsets[-1] == len(coords)
    assert (np.diff(offsets) >= 2).all()
    lines = np.split(coords, offsets[1:-1]) if len(offsets) > 1 else []
    steps = [step for line in lines for step in np.stack([line[:-1], line[1:]], axis=1)]
    assert counted(steps) == counted(graph.segments)


@given(graphs())
def test_polylines_are_as_long_as_shapely_merges_them(graph: cz.PlanarGraph) -> None:
    simple = cz.PlanarGraph(graph.vertices, np.unique(np.sort(graph.edges, axis=1), axis=0))
    assert simple.to_shapely().length == pytest.approx(simple.length)
    assert graph.length == pytest.approx(np.linalg.norm(np.diff(graph.segments, axis=1), axis=2).sum())


def test_polylines_of_a_lattice_are_those_of_shapely(rng: np.random.Generator) -> None:
    lattice = networkx.convert_node_labels_to_integers(networkx.grid_2d_graph(20, 20))
    edges = np.array(lattice.edges)[rng.random(lattice.number_of_edges()) < 0.45]
    graph = cz.PlanarGraph([(row // 20, row % 20) for row in range(400)], edges)
    merged = shapely.line_merge(shapely.multilinestrings(shapely.linestrings(graph.segments)))
    ours = graph.to_shapely()
    assert ours.equals(merged)
    assert len(ours.geoms) == len(merged.geoms)


@given(graphs())
def test_compact_draws_the_same(graph: cz.PlanarGraph) -> None:
    small = graph.compact()
    np.testing.assert_array_equal(small.segments, graph.segments)
    assert (small.degrees > 0).all()
    assert small.compact() == small


@given(graphs())
def test_networkx_gets_nodes_edges_and_lengths(graph: cz.PlanarGraph) -> None:
    peer = graph.to_networkx()
    assert peer.number_of_nodes() == len(graph.vertices)
    assert {frozenset(edge) for edge in peer.edges} == {frozenset(edge) for edge in graph.edges.tolist()}
    assert all(peer.nodes[row]["pos"] == tuple(place) for row, place in enumerate(graph.vertices.tolist()))
    for (a, b), length in zip(graph.edges.tolist(), graph.lengths.tolist(), strict=True):
        assert peer.edges[a, b]["length"] == length


@given(graphs())
def test_geo_interface_is_read_by_shapely(graph: cz.PlanarGraph) -> None:
    drawn = shapely.geometry.shape(graph) if len(graph.edges) else shapely.MultiLineString()
    assert drawn.equals_exact(graph.to_shapely(), 0.0)


def test_rings_are_closed_and_come_last() -> None:
    graph = cz.PlanarGraph([[0, 0], [1, 0], [0, 1], [5, 5], [6, 6]], [[0, 1], [1, 2], [2, 0], [3, 4]])
    coords, offsets = graph.polylines()
    assert coords.tolist() == [[5, 5], [6, 6], [0, 0], [1, 0], [0, 1], [0, 0]]
    assert offsets.tolist() == [0, 2, 6]


def test_a_million_edges_in_one_line_take_no_stack() -> None:
    rows = np.arange(1_000_001)
    graph = cz.PlanarGraph(np.stack([rows, rows], axis=1), np.stack([rows[:-1], rows[1:]], axis=1))
    coords, offsets = graph.polylines()
    assert offsets.tolist() == [0, len(rows)]
    np.testing.assert_array_equal(coords, graph.vertices)
    assert graph.components == 1


def test_it_is_a_record() -> None:
    graph = cz.PlanarGraph([[0, 0], [3, 4]], [[0, 1]])
    assert repr(graph) == "PlanarGraph(2 vertices, 1 edges)"
    for twin in (pickle.loads(pickle.dumps(graph)), copy.deepcopy(graph)):
        assert twin == graph
        assert not twin.edges.flags.writeable
    assert graph != cz.PlanarGraph([[0, 0], [3, 4]], [[1, 0]])
    with pytest.raises(ValueError, match="read-only"):
        graph.labels[0] = 5


def test_arrays_of_the_right_kind_are_not_copied() -> None:
    vertices, edges = np.zeros((2, 2)), np.zeros((1, 2), dtype=np.int32)
    graph = cz.PlanarGraph(vertices, edges)
    assert np.shares_memory(graph.vertices, vertices)
    assert np.shares_memory(graph.edges, edges)
    assert vertices.flags.writeable


@pytest.mark.parametrize("dtype", ["<i4", ">i4", "u1", "i8", ">u8"])
def test_any_integers_become_edges(dtype: str) -> None:
    edges = np.array([[0, 9, 1], [1, 9, 2]], dtype=dtype)[:, ::2]
    graph = cz.PlanarGraph(np.zeros((3, 2), dtype=">f4"), edges)
    assert graph.edges.tolist() == [[0, 1], [1, 2]]
    assert graph.edges.dtype == np.dtype(np.int32)
    assert graph.edges.dtype.isnative


@pytest.mark.parametrize("dtype", ["i1", "<i2", ">i2", "<i4", ">i4", ">i8"])
def test_negative_indices_of_any_size_are_found(dtype: str) -> None:
    with pytest.raises(ValueError, match=r"edges\[1\] is \(5, -100\)"):
        cz.PlanarGraph(np.zeros((200, 2)), np.array([[0, 100], [5, -100]], dtype=dtype))


@pytest.mark.parametrize(
    ("vertices", "edges", "kind", "words"),
    [
        ([[0, 0, 0]], [], ValueError, r"vertices has shape \(1, 3\)"),
        (["a"], [], TypeError, "vertices has dtype"),
        ([[0, 0]], [[0, 1]], ValueError, r"edges\[0\] is \(0, 1\)"),
        ([[0, 0]], [[0, 0], [-1, 0]], ValueError, r"edges\[1\] is \(-1, 0\)"),
        ([[0, 0]], [[0, 2**40]], ValueError, r"edges\[0\]"),
        ([[0, 0]], np.array([[2**64 - 1, 0]], dtype=np.uint64), ValueError, r"edges\[0\]"),
        ([[0, 0]], [[0.0, 0.0]], TypeError, "edges has dtype float64"),
        ([[0, 0]], [[True, False]], TypeError, "edges has dtype bool"),
        ([[0, 0]], [0, 0], ValueError, r"edges has shape \(2,\)"),
        ([], [[0, 0]], ValueError, r"edges\[0\]"),
        ([[0, 0]], [[0, 0], [0]], ValueError, "edges is ragged"),
    ],
)
def test_bad_input_is_named(vertices: Any, edges: Any, kind: type[Exception], words: str) -> None:
    with pytest.raises(kind, match=words):
        cz.PlanarGraph(vertices, edges)


def test_nothing_is_a_drawing() -> None:
    graph = cz.PlanarGraph([], [])
    assert (graph.length, graph.components, graph.leaves) == (0.0, 0, 0)
    assert graph.segments.shape == (0, 2, 2)
    assert graph.polylines()[1].tolist() == [0]
    assert graph.to_shapely().is_empty
    assert graph.compact() == graph
    assert graph._repr_svg_() is None


def test_plot_draws_on_the_axes_given() -> None:
    figure = pytest.importorskip("matplotlib.figure").Figure()
    axes = figure.subplots()
    graph = cz.PlanarGraph([[0, 0], [30, 40]], [[0, 1]])
    assert graph.plot(axes, color="red", linewidth=3) is axes
    assert axes.get_aspect() == 1.0
    assert axes.get_xlim()[1] >= 30
    assert axes.collections[0].get_linewidth() == [3]
    cz.PlanarGraph([], []).plot(axes)


@pytest.mark.parametrize("seed", range(4))
def test_distances_are_those_of_shapely(seed: int) -> None:
    shapely = pytest.importorskip("shapely")
    rng = np.random.default_rng(seed)
    vertices = rng.normal(size=(60, 2)) * (1, 10.0**seed)
    graph = cz.PlanarGraph(vertices, rng.integers(0, 60, (80, 2)))
    points = rng.normal(size=(500, 2)) * 3 * (1, 10.0**seed)
    lines = shapely.MultiLineString(list(graph.segments))
    np.testing.assert_allclose(graph.distances(points), shapely.distance(lines, shapely.points(points)), rtol=1e-9)


def test_nothing_is_infinitely_far() -> None:
    assert np.isinf(cz.PlanarGraph([[0, 0]], []).distances([[1, 2]])).all()
    assert cz.PlanarGraph([[1, 1]], [[0, 0]]).distances([[1, 3]]).tolist() == [2.0]
