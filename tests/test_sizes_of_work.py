"""Drawings on which work once grew with the square of their size, each beside what is known of it otherwise.

None is timed: what is quadratic does not end at these sizes within the time that a test has, or needs more memory than
there is.
"""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import scipy.spatial
import shapely

import crazing as cz
from crazing.measure import stamp


def graph(vertices: np.ndarray, edges: np.ndarray) -> cz.PlanarGraph:
    return cz.PlanarGraph(np.ascontiguousarray(vertices, dtype=float), np.ascontiguousarray(edges, dtype=np.int32))


def comb(teeth: int, *, length: float = 0.5) -> cz.PlanarGraph:
    """A back of 1 with long teeth."""
    x, k = np.linspace(0, 1, teeth), np.arange(teeth)
    edges = [np.column_stack([k[:-1], k[1:]]), np.column_stack([k, teeth + k])]
    return graph(np.concatenate([np.column_stack([x, 0 * x + y]) for y in (0, length)]), np.concatenate(edges))


def star(spokes: int) -> cz.PlanarGraph:
    angle, k = np.linspace(0, 2 * np.pi, spokes, endpoint=False), np.arange(spokes)
    ends = np.column_stack([np.cos(angle), np.sin(angle)])
    return graph(np.concatenate([[(0.0, 0.0)], ends]), np.column_stack([0 * k, 1 + k]))


def crack(drawn: cz.PlanarGraph, bounds: tuple[float, float, float, float], width: float = 1e-6, **given) -> cz.Crack:
    rows = np.arange(len(drawn.edges), dtype=np.int32)
    return cz.Crack(drawn, np.full((len(rows), 2), width), rows, np.zeros_like(rows), bounds, **given)


def areas(drawing: cz.steps.Drawing) -> np.ndarray:
    """Twice the area of every triangle of the fence that is not in its rim, once for each side it has."""
    points, kites = np.concatenate([drawing.vertices, drawing.fence[0]]), drawing.fence[1]
    triangles = np.concatenate([kites[:, [0, 1, 2]], kites[:, [1, 0, 3]]])
    a, b, c = points[triangles[(triangles >= 0).all(axis=1)]].transpose(1, 0, 2)
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


def boxes(drawn: cz.PlanarGraph, size: float) -> int:
    """Boxes of that size which lines along the axes pass, from the corner of the drawing."""
    at = np.floor((drawn.segments - drawn.vertices.min(axis=0)) / size).astype(int)
    low, high = at.min(axis=1), at.max(axis=1)
    met = np.zeros(high.max(axis=0) + 1, dtype=bool)
    for (left, bottom), (right, top) in zip(low, high, strict=True):
        met[left : right + 1, bottom : top + 1] = True
    # Those that are whole; there are no bounds.
    return int(met.sum())


def test_a_comb_is_measured_by_boxes_that_suit_its_edges() -> None:
    """Between its junctions there are only short pieces of the back: by these there would be billions of boxes."""
    drawn = comb(20_000)
    found = cz.measure(drawn)
    assert (found.components, found.loops) == (1, 0)
    assert found.length == pytest.approx(drawn.length)
    size = drawn.length / len(drawn.edges) / 16 / 16
    counts = [boxes(drawn, size * 2**level) for level in range(5)]
    assert found.box_dimension == pytest.approx(-np.polyfit(np.arange(5), np.log2(counts), 1)[0], abs=0.01)


def test_a_star_is_drawn_with_all_its_spokes() -> None:
    drawn = star(60_000)
    found = cz.steps.draw(drawn, bounds=(-2, -2, 2, 2))
    placed = np.sort(found.vertices[found.edges].reshape(-1, 4), axis=0)
    np.testing.assert_array_equal(placed, np.sort(drawn.segments.reshape(-1, 4), axis=0))
    # Its triangles pave the box, and none lies on another.
    twice = areas(found)
    assert twice.min() > 0 and twice.sum() / 6 == pytest.approx(8 * 8)


def test_constraints_along_a_line_are_its_edges() -> None:
    rows = np.arange(200_000)
    found = cz.diagram(np.column_stack([rows, 0 * rows]), constraints=np.column_stack([rows[::4], rows[::4] + 2])[:-1])
    low = found.sites[found.edges].min(axis=1)[:, 0].astype(int)
    assert (found.constrained == ((low % 4 < 2) & (low < rows[-4]))).all()


@pytest.mark.parametrize("width", [0.03, 0.1])
def test_long_slanting_cracks_are_stamped_where_they_are(width: float) -> None:
    drawn = star(40)
    tapered = crack(drawn, (-1.2, -1.2, 1.2, 1.2))
    tapered = cz.Crack(drawn, np.tile([width, width / 3], (40, 1)), tapered.strand, tapered.generation, tapered.bounds)
    mask = stamp(tapered, 240)
    at = (np.arange(240) + 0.5) / 240 * 2.4 - 1.2
    x, y = np.meshgrid(at, -at)
    a, b = drawn.segments[:, 0, :, None, None], drawn.segments[:, 1, :, None, None]
    along = np.clip(((x - a[:, 0]) * (b - a)[:, 0] + (y - a[:, 1]) * (b - a)[:, 1]) / ((b - a) ** 2).sum(axis=1), 0, 1)
    off = np.hypot(x - a[:, 0] - along * (b - a)[:, 0], y - a[:, 1] - along * (b - a)[:, 1])
    within = (off <= (width - along * width * 2 / 3) / 2 - 1e-9).any(axis=0)
    assert not (within & ~mask).any()
    # And else only the line of pixels along every edge.
    near = shapely.distance(shapely.union_all(shapely.linestrings(drawn.segments)), shapely.points(x, y)) <= 0.01
    assert not (mask & ~within & ~near).any()


def test_a_disc_of_spokes_is_stamped() -> None:
    mask = stamp(crack(star(40_000), (-1, -1, 1, 1), 0.004), 1_000)
    at = (np.arange(1_000) + 0.5) / 500 - 1
    radius = np.hypot(*np.meshgrid(at, at))
    assert mask[radius < 1].all() and not mask[radius > 1.004].any()


def test_spokes_start_when_the_first_is_at_the_hub() -> None:
    count = 400_000
    parent = np.full(count, -1, dtype=np.int32)
    parent[1:] = 0
    found = crack(star(count), (-1, -1, 1, 1), parent=parent).arrivals
    # The first grows from its outer end, which is nearest its middle; the others follow in turn, one after the other.
    starts = np.maximum(1, 1.5 * np.arange(1, count) / count)
    wanted = np.concatenate([[(1, 0)], np.column_stack([starts, starts + 1])])
    np.testing.assert_allclose(found, wanted / wanted.max(), rtol=1e-12)


@pytest.mark.parametrize("amplitude", [0.01, 0.1])
def test_a_comb_is_warped_and_its_triangles_stay(amplitude: float) -> None:
    plain = cz.steps.draw(comb(100_000))
    found = cz.steps.warp(plain, amplitude=amplitude, rng=1)
    assert (found.vertices != plain.vertices).any()
    assert areas(found).min() > 0


def test_a_comb_is_parted_where_its_back_turns_into_a_tooth() -> None:
    teeth = 6_000
    found = cz.steps.part(cz.steps.draw(comb(teeth)), hairpin=60, reach=0.5)
    parts = cz.PlanarGraph(found.vertices, found.edges)
    assert 0 < len(found.edges) < 2 * teeth - 1
    # No corner of two edges that are one crack is left.
    degree = np.bincount(found.edges.ravel())
    ends = np.flatnonzero(found.partner > np.arange(len(found.partner)))
    way = (parts.segments[:, 1] - parts.segments[:, 0])[:, None] * np.array([1, -1])[:, None]
    way = (way / np.linalg.norm(way, axis=2)[..., None]).reshape(-1, 2)
    straight = -(way[ends] * way[found.partner[ends]]).sum(axis=1)
    assert (straight[degree[found.edges.ravel()[ends]] == 2] >= np.cos(np.radians(60.001))).all()


def test_hatching_that_floats_is_on_one_plate() -> None:
    """Every line has all others to its left, at all heights."""
    count = 200_000
    x, k = np.linspace(0, 1, count), np.arange(count)
    ends = np.concatenate([np.column_stack([x + y, 0 * x + y]) for y in (0, 1)])
    lines = graph(ends, np.column_stack([k, count + k]))
    assert (cz.texture(crack(lines, (-0.5, -0.5, 2.5, 1.5), 1e-9), 64, maps=["cell"])["cell"] == 0).all()


def test_squares_in_slanting_squares_are_plates_of_their_own() -> None:
    count, pixels = 200, 200
    # No middle of a pixel is on a line.
    size = (np.arange(count) + 1) / count * 0.98765
    corners = np.array([(-1.0, 0.05), (0.1, -1.0), (1.0, -0.05), (-0.1, 1.0)])
    k = np.arange(4 * count).reshape(-1, 4)
    edges = np.stack([k, np.roll(k, -1, axis=1)], axis=-1).reshape(-1, 2)
    drawn = graph((size[:, None, None] * corners).reshape(-1, 2), edges)
    cell = cz.texture(crack(drawn, (-1.5, -1.5, 1.5, 1.5)), pixels, maps=["cell"])["cell"]
    at = (np.arange(pixels) + 0.5) / pixels * 3 - 1.5
    points = shapely.points(*np.meshgrid(at, -at))
    tree = shapely.STRtree([shapely.Polygon(corners * s) for s in size])
    inside = np.bincount(tree.query(points.ravel(), predicate="within")[0], minlength=pixels**2).reshape(pixels, pixels)
    pairs = np.unique(np.stack([inside.ravel(), cell.ravel()]), axis=1)
    assert len(pairs.T) == len(np.unique(pairs[0])) == len(np.unique(pairs[1])) > 100


def test_distances_to_a_spot_are_those_to_its_points() -> None:
    """Every pixel is far from all of them, and nearly as far from each."""
    count, pixels = 60_000, 768
    spots = 0.5 + 0.005 * np.random.default_rng(0).standard_normal((count, 2))
    rows = np.arange(count)
    drawn = crack(graph(spots, np.column_stack([rows, rows])), (0, 0, 1, 1), 0.0)
    found = cz.texture(drawn, pixels, maps=["distance"])["distance"]
    x, y = np.meshgrid((np.arange(pixels) + 0.5) / pixels, 1 - (np.arange(pixels) + 0.5) / pixels)
    wanted = scipy.spatial.cKDTree(spots).query(np.column_stack([x.ravel(), y.ravel()]))[0].reshape(x.shape)
    np.testing.assert_allclose(found, wanted, atol=2e-5)


def test_strands_are_saved_each_from_its_own_edges(tmp_path: Path) -> None:
    count = 100_000
    crack(star(count), (-1, -1, 1, 1)).save(tmp_path / "star.geojson")
    features = json.loads((tmp_path / "star.geojson").read_text())["features"]
    lines = np.array([feature["geometry"]["coordinates"] for feature in features])
    ends = star(count).vertices[1:]
    np.testing.assert_array_equal(np.abs(lines).max(axis=1), np.abs(ends))
    assert [feature["properties"]["strand"] for feature in features] == list(range(count))


def test_one_strand_through_a_hub_is_saved_with_every_spoke(tmp_path: Path) -> None:
    count = 60_000
    spokes = star(count)
    none = np.zeros(count, dtype=np.int32)
    one = cz.Crack(spokes, np.full((count, 2), 1e-6), none, none, (-1, -1, 1, 1))
    one.save(tmp_path / "star.geojson")
    features = json.loads((tmp_path / "star.geojson").read_text())["features"]
    lines = [shapely.LineString(feature["geometry"]["coordinates"]) for feature in features]
    assert sum(line.length for line in lines) == pytest.approx(count)
    assert len(lines) == count // 2
