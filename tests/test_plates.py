"""Which plate a pixel is on: the face of the drawing of middle lines in which its middle lies."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import scipy.ndimage
import shapely
import shapely.ops
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

import crazing as cz

#: What counts as the same place: a pixel's middle nearer to a line than this may be on either side of it.
NEAR = 1e-6

#: To what shapely rounds places, so that what ends at the bounds meets them.
GRID = 1e-10


def around(crack):
    """Vectors to the periods beside the first, and to the first."""
    if crack.period is None:
        return np.zeros((1, 2))
    width, height = crack.period
    return np.array([(i * width, j * height) for i in (-1, 0, 1) for j in (-1, 0, 1)])


def middle_lines(crack):
    ends = crack.graph.vertices[crack.graph.edges]
    if crack.period is not None:
        ends[:, 1] += crack.shifts * np.array(crack.period)
    return shapely.linestrings(np.concatenate([ends + by for by in around(crack)]))


def middles(crack, size):
    """The middles of pixels that show the bounds."""
    (xmin, ymin, xmax, ymax), (height, width) = crack.bounds, size
    x, y = (np.arange(width) + 0.5) / width, 1 - (np.arange(height) + 0.5) / height
    return np.meshgrid(xmin + x * (xmax - xmin), ymin + y * (ymax - ymin))


def faces_of(crack, x, y):
    """The face in which each place lies, by shapely; -1 near a line. Faces that meet across the period are one."""
    frame, lines = shapely.box(*crack.bounds), middle_lines(crack)
    lines = lines[shapely.intersects(lines, frame)]
    drawing = shapely.unary_union([frame.exterior, *lines], grid_size=GRID)
    polygons = np.array([face for face in shapely.ops.polygonize(drawing) if frame.covers(face.representative_point())])
    tree, number = shapely.STRtree(polygons), np.arange(len(polygons))
    for by in around(crack):
        moved = shapely.transform(polygons, lambda places, by=by: places + by)
        there, here = tree.query(moved, predicate="intersects")
        meets = shapely.length(shapely.intersection(moved[there], polygons[here])) > NEAR
        if by.any():
            pairs = np.stack([number[there], number[here]])[:, meets]
            number = connected_components(coo_array((np.ones(len(pairs.T)), pairs), shape=(len(polygons),) * 2))[1][
                number
            ]
    places, face = shapely.points(x, y).ravel(), np.full(x.size, -1)
    at, polygon = tree.query(places, predicate="within")
    face[at] = number[polygon]
    face[shapely.STRtree(lines).query(places, predicate="dwithin", distance=NEAR)[0]] = -1
    return face.reshape(x.shape)


def assert_one_to_one(face, cell):
    """Every face has one plate and every plate one face."""
    assert (face >= 0).mean() > 0.7
    for numbers in np.unique(np.stack([face, cell])[:, face >= 0], axis=1):
        assert len(np.unique(numbers)) == len(numbers)


def assert_cells_are_faces(crack, cell):
    assert_one_to_one(faces_of(crack, *middles(crack, cell.shape)), cell)


@pytest.mark.parametrize("name", ["rock", "concrete-spall", "bark"])
def test_a_shifted_preset_is_the_rolled_texture(name):
    # Most of their cracks float inside plates, or run round the torus.
    for seed in range(3):
        crack = cz.preset(name).crack(rng=seed, period=(1, 1))
        there = crack.shifted(37 / 128, 0.5)
        one, other = (cz.texture(each, 128, maps="all", material=name) for each in (crack, there))
        for key, array in one.items():
            np.testing.assert_array_equal(other[key], np.roll(array, (-64, 37), axis=(0, 1)), err_msg=key)


@pytest.mark.parametrize("period", [None, (1, 1)])
@pytest.mark.parametrize("name", ["asphalt-alligator", "bark", "concrete-spall", "glass-impact", "ice", "rock"])
def test_plates_of_presets_are_the_faces_of_their_drawing(name, period):
    side = 400
    for seed in range(2):
        crack = cz.preset(name).crack(rng=seed, **({} if period is None else {"period": period}))
        maps = cz.texture(crack, side, maps=["cell", "mask"])
        assert_cells_are_faces(crack, maps["cell"])
        # What is joined beside the cracks is one plate.
        islands, count = scipy.ndimage.label(maps["mask"] == 0)
        least, most = (
            of(maps["cell"], islands, range(1, count + 1)) for of in (scipy.ndimage.minimum, scipy.ndimage.maximum)
        )
        np.testing.assert_array_equal(least, most)


def random_crack(seed, period, *, loose=0.5):
    """Some edges of a triangulation, of any widths; without a period they run out of the bounds."""
    rng = np.random.default_rng(seed)
    points = rng.random((24, 2)) * (1 if period else 1.6) - (0 if period else 0.3)
    d = cz.diagram(points, period=period)
    kept = rng.random(len(d.edges)) < loose
    graph = cz.PlanarGraph(d.sites, d.edges[kept])
    count = len(graph.edges)
    widths, rows = rng.random((count, 2)) ** 3 * 0.1, np.zeros(count, dtype=np.int32)
    turns = d.shifts[kept] if period else None
    return cz.Crack(graph, widths, rows, rows, (0.0, 0.0, 1.0, 1.0), period, turns)


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
@pytest.mark.parametrize("loose", [0.2, 0.5, 0.8])
def test_plates_of_any_drawing_are_its_faces(period, loose):
    for seed in range(12):
        crack = random_crack(seed, period, loose=loose)
        if len(crack.graph.edges):
            assert_cells_are_faces(crack, cz.texture(crack, 96, maps=["cell"])["cell"])


def lattice(seed, period, n, *, loose):
    """Some lines of a lattice of n cells a side: along the bounds and beyond, or through the middles of 60 pixels."""
    rng = np.random.default_rng(seed)
    cells = np.stack(np.meshgrid(*[np.arange(0 if period else -1, n + (0 if period else 1))] * 2), axis=-1).reshape(
        -1, 2
    )
    steps = np.array([(1, 0), (0, 1), (1, 1), (1, 0), (0, 1)])[rng.integers(5, size=(len(cells), 3))]
    first, second = (at.reshape(-1, 2) for at in np.broadcast_arrays(cells[:, None], cells[:, None] + steps))
    lines = np.unique(np.stack([first, second], axis=1), axis=0)
    lines = lines[rng.random(len(lines)) < loose]
    turns = lines // n * (1 if period else 0)
    places, edges = np.unique((lines - turns * n).reshape(-1, 2), axis=0, return_inverse=True)
    edges, places = edges.reshape(-1, 2), places / n + (0.5 / 60 if period else 0)
    rows, shifts = np.zeros(len(edges), dtype=np.int32), (turns[:, 1] - turns[:, 0]).astype(np.int8)
    graph, widths = cz.PlanarGraph(places, edges), rng.random((len(edges), 2)) * 0.05
    return cz.Crack(graph, widths, rows, rows, (0.0, 0.0, 1.0, 1.0), period, shifts if period else None)


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
@pytest.mark.parametrize("loose", [0.15, 0.4, 0.9])
def test_plates_of_a_lattice_are_its_faces(period, loose):
    for seed in range(30):
        crack = lattice(seed, period, 5 + seed % 2, loose=loose)
        if len(crack.graph.edges):
            assert_cells_are_faces(crack, cz.texture(crack, 60, maps=["cell"])["cell"])


def test_a_tree_that_floats_closes_no_plate():
    """Its leftmost vertex is passed twice, and by roundings the two places of it differ."""
    places = np.array([(1, 3), (2, 3), (2, 4), (3, 3), (4, 3), (3, 4), (4, 4), (0, 1), (5, 1)]) / 5
    edges = [(0, 1), (2, 0), (1, 3), (4, 3), (5, 3), (5, 6), (7, 8)]
    rows = np.zeros(len(edges), dtype=np.int32)
    graph, widths = cz.PlanarGraph(places, edges), np.full((len(edges), 2), 1e-3)
    crack = cz.Crack(graph, widths, rows, rows, (0.0, 0.0, 1.0, 1.0))
    cell = cz.texture(crack, 60, maps=["cell"])["cell"]
    assert np.bincount(cell.ravel()).tolist() == [48 * 60, 12 * 60]


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
def test_windows_have_the_plates_of_the_whole(period):
    tilted = cz.Material(tilt=0.3, level=0.2, grain=0.0)
    for seed in range(6):
        crack = random_crack(seed, period)
        plan = cz.texture_plan(
            crack, (90, 130), maps=["cell", "height"], material=tilted, bounds=(-0.2, -0.1, 1.1, 0.8)
        )
        plan = plan if period is None else cz.texture_plan(crack, 100, maps=["cell", "height"], material=tilted)
        whole = plan.window(0, 0, 90, 100)
        for top, left, height, width in [
            (0, 0, 1, 1),
            (89, 99, 1, 1),
            (37, 20, 9, 70),
            (5, 64, 80, 3),
            (66, 1, 24, 99),
        ]:
            part = plan.window(top, left, height, width)
            for name, array in part.items():
                np.testing.assert_array_equal(array, whole[name][top : top + height, left : left + width])


def test_beyond_the_bounds_is_the_plate_of_the_nearest_place_within():
    crack = random_crack(3, None)
    wide = cz.texture(crack, (96, 128), maps=["cell"], bounds=(-0.5, -0.25, 1.5, 1.25))["cell"]
    x, y = middles(dataclasses.replace(crack, bounds=(-0.5, -0.25, 1.5, 1.25)), (96, 128))
    assert_one_to_one(faces_of(crack, *(np.clip(at, NEAR, 1 - NEAR) for at in (x, y))), wide)


def test_a_wide_crack_hides_no_plate_behind_a_narrow_one():
    """A narrow crack leaves a wide one at an acute angle: behind it, the wide one is nearer, to its edge."""
    graph = cz.PlanarGraph([(0, 0.4), (0.5, 0.4), (1, 0.4), (1, 0.6)], [(0, 1), (1, 2), (1, 3)])
    rows, widths = np.zeros(3, dtype=np.int32), np.array([(0.16, 0.16), (0.16, 0.16), (0.001, 0.001)])
    crack = cz.Crack(graph, widths, rows, rows, (0.0, 0.0, 1.0, 1.0))
    tilted = cz.Material(tilt=0.2, level=0.02, rim=0.0)
    maps = cz.texture(crack, 200, maps=["cell", "distance", "height", "normal"], material=tilted)
    x, y = middles(crack, (200, 200))
    sector = np.where(y < 0.4, 0, np.where((y > 0.4 * x + 0.2) | (x < 0.5), 1, 2))
    assert_one_to_one(sector, maps["cell"])
    # Beside the cracks every plate is level, of one slope.
    for number in range(3):
        own = (sector == number) & (maps["distance"] > 0)
        np.testing.assert_array_equal(maps["normal"][own], maps["normal"][own][:1].repeat(own.sum(), axis=0))
        level = np.column_stack([x[own], y[own], np.ones(own.sum())])
        slope = np.linalg.lstsq(level, maps["height"][own].astype(float))[0]
        np.testing.assert_allclose(level @ slope, maps["height"][own], atol=1e-6)


def round_the_torus(way, count, *, hung):
    """Cracks that go round the torus, so many periods to the right and up; hung with dead ends, pieces and rings."""
    (right, up), places, edges, turns = way, [], [], []
    apart = np.array([1 / (count * abs(up)), 0.0] if up else [0.0, 1 / count])

    def draw(at, links):
        first, cells = len(places), np.floor(at)
        places.extend(at - cells)
        edges.extend((first + a, first + b) for a, b in links)
        turns.extend(cells[b] - cells[a] for a, b in links)

    steps, small = 6 * max(abs(right), abs(up)), 0.16 / (count * np.hypot(right, up))
    for k in range(count):
        start = np.array([0.03, 0.07]) + k * apart
        at = start + np.outer(np.arange(steps + 1) / steps, way)
        first, whole = len(places), np.floor(at)
        places.extend(at[:-1] - whole[:-1])
        edges.extend((first + i, first + (i + 1) % steps) for i in range(steps))
        turns.extend(np.diff(whole, axis=0))
        if hung:
            amid = start + apart / 2 + np.array(way) / 5
            ring = amid + small * np.array([(-1, -1), (1, -1), (0, 1), (0, 0), (0.2, 0.1)])
            draw(ring, [(0, 1), (1, 2), (2, 0), (3, 4)])
            draw(amid + small * np.array([(-1, -0.3), (1, 0.3)]) + np.array(way) / 2, [(1, 0)])
            tip = places[first + 1] + apart / 3
            places.append(tip - np.floor(tip))
            edges.append((len(places) - 1, first + 1))
            turns.append(-np.floor(tip))
    rows = np.zeros(len(edges), dtype=np.int32)
    graph, widths = cz.PlanarGraph(places, edges), np.full((len(edges), 2), 1e-3)
    return cz.Crack(graph, widths, rows, rows, (0.0, 0.0, 1.0, 1.0), (1.0, 1.0), np.array(turns, dtype=np.int8))


WAYS = [(0, 1), (1, 0), (-1, 0), (0, -1), (1, 1), (1, -1), (2, 1), (-1, 2), (3, -1), (2, 3), (-3, -2)]


@pytest.mark.parametrize("hung", [False, True])
@pytest.mark.parametrize("way", WAYS)
def test_strips_round_the_torus_are_plates_of_their_own(way, hung):
    for count in (1, 2, 3):
        crack = round_the_torus(way, count, hung=hung)
        cell = cz.texture(crack, 128, maps=["cell"])["cell"]
        assert len(np.unique(cell)) == count * (1 + hung)
        assert_cells_are_faces(crack, cell)
