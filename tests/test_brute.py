"""Every map against a reference that looks at every edge for every pixel: all presets, and cracks made to be hard."""

from __future__ import annotations

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
import shapely.ops

import crazing as cz
from brute_material import Ground
from brute_texture import Brute
from crazing.material import preset_material

#: What cutting places to 2^-16 pixel and numbers of 32 bits do to a distance, in pixels and as a part of it.
PLACE, PART = 6e-5, 4e-6

SQUARE = (0.0, 0.0, 1.0, 1.0)


def drawn(vertices, edges, widths, bounds=SQUARE, shifts=None):
    """A crack by hand, on a torus if there are shifts; every edge is a strand."""
    edges = np.asarray(edges, dtype=np.int32).reshape(-1, 2)
    rows = np.arange(len(edges), dtype=np.int32)
    graph = SimpleNamespace(vertices=np.asarray(vertices, dtype=float).reshape(-1, 2), edges=edges)
    widths = np.asarray(widths, dtype=float).reshape(-1, 2)
    made = SimpleNamespace(graph=graph, width=widths, strand=rows, generation=rows % 5, bounds=bounds)
    if shifts is not None:
        made.period, made.shifts = (1.0, 1.0), np.asarray(shifts, dtype=np.int8)
    return made


def hard():
    """Cracks by what is hard about them."""
    rng = np.random.default_rng(4)
    apart, some, ring = np.arange(24).reshape(-1, 2), rng.random((24, 2)), [[i, (i + 1) % 12] for i in range(12)]
    short = np.concatenate([some, some + (rng.random((24, 2)) - 0.5) / 100])
    pairs = np.stack([np.arange(24), np.arange(24, 48)], axis=1)
    straight = np.concatenate([some, some + np.array([0.05, 0])])
    nearly = np.stack([np.full(24, 0.2), 0.2 - 0.1 * (1 - 10.0 ** -rng.uniform(0, 5, 24))], axis=1)
    far = (1e6, 1e6, 1e6 + 1, 1e6 + 1)
    return {
        "no width": drawn(some, apart, np.zeros((12, 2))),
        "very wide": drawn(some, apart, rng.random((12, 2)) * 0.8),
        "wide to none": drawn(some, apart, np.stack([rng.random(12) * 0.4, np.zeros(12)], axis=1)),
        "shorter than a pixel": drawn(short, pairs, rng.random((24, 2)) * 0.03),
        "no length": drawn(some, np.stack([np.arange(24)] * 2, axis=1), rng.random((24, 2)) * 0.1),
        "discs that nearly hold each other": drawn(straight, pairs, nearly),
        "longer than the period": drawn(some[:12], ring, rng.random((12, 2)) / 20, shifts=rng.integers(-3, 4, (12, 2))),
        "wider than the period": drawn(some[:12], ring, rng.random((12, 2)) * 1.4, shifts=rng.integers(-1, 2, (12, 2))),
        "across the corner": drawn(
            [[0.98, 0.98], [0.01, 0.02], [0.5, 0.99], [0.5, 0.01]],
            [[0, 1], [2, 3], [1, 2]],
            [[0.02, 0.01], [0.03, 0], [0.01, 0.05]],
            shifts=[[1, 1], [0, 1], [0, -1]],
        ),
        "alone on a torus": drawn([[0.1, 0.1], [0.12, 0.1]], [[0, 1]], [[0.01, 0.01]], shifts=[[0, 0]]),
        "acute": drawn(
            [[0.1, 0.5], [0.9, 0.5], [0.9, 0.51], [0.9, 0.53]],
            [[0, 1], [0, 2], [0, 3]],
            [[0.02, 0.01], [0.02, 0.03], [0, 0.05]],
        ),
        "twice": drawn([[0.2, 0.2], [0.8, 0.7]], [[0, 1], [1, 0], [0, 1]], np.full((3, 2), 0.03)),
        "far from the origin": drawn(some + 1e6, apart, rng.random((12, 2)) / 20, bounds=far),
        "cut by the bounds": drawn(some * 3 - 1, apart, rng.random((12, 2)) / 20),
    }


HARD = hard()


def hold_geometry(crack, size, bounds=None):
    """Distance, coverage and labels are those of the reference."""
    names = ["mask", "distance", "strand", "generation", "direction"]
    t = cz.texture(crack, size, maps=names, bounds=bounds)
    brute = Brute(crack, size, bounds)
    distance = brute.nearest[0]
    np.testing.assert_allclose(t["distance"] * brute.scale, distance, atol=PLACE, rtol=PART)
    # Half a level by rounding; the rest where long edges are cut into pieces, of which the wider one counts.
    np.testing.assert_allclose(t["mask"], 255 * brute.coverage(), atol=0.75)
    steps = brute.ends[:, 1] - brute.ends[:, 0]
    lengths = np.hypot(*steps.T)[:, None]
    units = np.where(lengths > 0, steps / np.where(lengths > 0, lengths, 1), [1.0, 0.0])
    labels = {name: t[name].ravel() for name in ("strand", "generation")}
    for pixel, rows in enumerate(brute.candidates(10 * PLACE)):
        off = distance.flat[pixel] - 0.5
        for name, found in labels.items():
            wanted = np.asarray(getattr(crack, name))[rows] if off < 0 else [-1]
            assert abs(off) < PLACE or found[pixel] in wanted, (name, pixel)
        found = t["direction"].reshape(-1, 2)[pixel]
        # Places cut to 2^-16 pixel turn short edges.
        turned = 1e-6 + 2e-5 / np.maximum(lengths[rows, 0], 1e-5)
        assert (np.abs(units[rows] - found).max(axis=1) <= turned).any(), pixel


@pytest.mark.parametrize("period", [None, (1.0, 1.0)], ids=["plane", "torus"])
@pytest.mark.parametrize("name", cz.presets())
def test_the_geometry_of_every_preset(name, period):
    hold_geometry(cz.crack(preset=name, n=12, period=period, rng=2), (40, 40))


@pytest.mark.parametrize("size", [(40, 40), (70, 1), (1, 1), (9, 131)])
@pytest.mark.parametrize("name", [name for name, crack in HARD.items() if not hasattr(crack, "period")])
def test_the_geometry_of_hard_cracks(name, size):
    hold_geometry(HARD[name], size)


@pytest.mark.parametrize("name", [name for name, crack in HARD.items() if not hasattr(crack, "period")])
def test_the_geometry_within_other_bounds(name):
    xmin, ymin, _, _ = HARD[name].bounds
    hold_geometry(HARD[name], (33, 50), (xmin + 0.3, ymin + 0.2, xmin + 0.55, ymin + 0.41))
    hold_geometry(HARD[name], (20, 20), (xmin - 5, ymin - 5, xmin + 7, ymin + 9))


@pytest.mark.parametrize("name", [name for name, crack in HARD.items() if hasattr(crack, "period")])
def test_the_geometry_of_hard_cracks_on_a_torus(name):
    hold_geometry(HARD[name], (40, 40))
    hold_geometry(HARD[name], (96, 32), (-1, -2, 0, 1))


def hold_material(crack, side, material, plates=None):
    """Height, occlusion, roughness, wear and colour are those of the reference."""
    t = cz.texture(crack, side, maps="all", material=material, seed=3)
    ground = Ground(crack, (side, side), material, 3, t["cell"], plates and plates(t))
    near = np.abs(ground.distance) < PLACE
    for name, wanted, off in (
        ("height", ground.height, 2e-4),
        ("ao", ground.ao, 1e-3),
        ("roughness", ground.roughness(), 2.1e-3),
        ("wear", ground.wear(), 2.1e-3),
        ("color", ground.color(), 1.5),
    ):
        wrong = np.abs(t[name].astype(float) - wanted)
        wrong = wrong.max(axis=2) if wrong.ndim == 3 else wrong
        assert (wrong[~near] <= off).all(), (name, wrong[~near].max())
    return t, ground


@pytest.mark.parametrize("name", cz.presets())
def test_the_material_of_every_preset(name):
    """What tapers with the cracks and what tilts is held elsewhere."""
    material = dataclasses.replace(preset_material(name), dirt_taper=0, tilt=0)
    period = (1.0, 1.0) if len(name) % 2 else None
    hold_material(cz.crack(preset=name, n=12, period=period, rng=2), 40, material)


@pytest.mark.parametrize(
    "change",
    [
        {"roundness": 0, "rim": 0},
        {"roundness": 1, "curl": -0.3},
        {"chip": 4, "chip_size": 0.3},
        {"fray": 1, "grain_size": 0.2},
        {"stretch": 5, "grain": 0.1, "grain_size": 0.1},
        {"stretch": 0.2, "grain_size": 0.2, "fray": 1, "chip": 2},
    ],
)
@pytest.mark.parametrize("name", ["very wide", "wide to none", "acute", "wider than the period", "no length"])
def test_the_material_of_hard_cracks(name, change):
    hold_material(HARD[name], 40, cz.Material(relief=1.0, level=0.1, mottle=0.3, **change))


def faces(t):
    """Middle and reach of every plate, pixels from the middle of the picture, y up."""
    crack, (height, width) = t.crack, t.size
    corners = np.array(crack.bounds).reshape(2, 2)
    border = shapely.box(*crack.bounds).exterior
    drawing = shapely.unary_union([border, *map(shapely.LineString, crack.graph.segments)], grid_size=1e-10)
    found = {}
    for face in shapely.ops.polygonize(drawing):
        ring = (np.array(face.exterior.coords) - corners.mean(axis=0)) * t.scale
        x, y = np.array(face.representative_point().coords[0]) - corners.mean(axis=0)
        place = int(height / 2 - y * t.scale), int(x * t.scale + width / 2)
        middle = np.array(shapely.Polygon(ring).centroid.coords[0])
        found[int(t["cell"][place])] = middle, np.hypot(*(ring - middle).T).max()
    return found


def test_plates_tilt_about_their_middles():
    crack = cz.crack(n=12, opening=0.0, width=0.01, rng=7)
    t, ground = hold_material(crack, 96, cz.Material(tilt=0.2, level=0.1, rim=0.05), faces)
    assert len(ground.plates) == len(np.unique(t["cell"])) > 5


@pytest.mark.parametrize(
    "material",
    [
        cz.Material(relief=1.0, roundness=0.7),
        cz.Material(chip=2, grain=0.1, curl=0.3),
        cz.Material(relief=1.0, fray=0.8, grain_size=0.3, curl=0.2),
        cz.Material(relief=1.0, fray=0.8, grain=0.2, grain_size=0.3, stretch=4),
    ],
)
def test_normals_are_the_slope_of_the_heights_of_the_reference(material):
    crack = cz.crack(preset="mud-mature", n=12, rng=2)
    t = cz.texture(crack, 40, maps="all", material=material, seed=3)
    step = 1e-3
    at = {
        by: Ground(crack, (40, 40), material, 3, t["cell"], beside=(by[0] * step, by[1] * step)).height
        for by in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
    }
    pixels = t.relief * t.scale / step
    ahead = np.stack([at[1, 0] - at[0, 0], at[0, 1] - at[0, 0]], axis=-1) * pixels
    back = np.stack([at[0, 0] - at[-1, 0], at[0, 0] - at[0, -1]], axis=-1) * pixels
    found = -t["normal"][..., :2].astype(float) / t["normal"][..., 2:]
    # Where they differ there is a crease, which has no slope.
    smooth = (np.abs(ahead - back) < 0.02 * (1 + np.abs(ahead))).all(axis=2)
    assert smooth.mean() > 0.9
    off = (np.abs(found - (ahead + back) / 2) / (1 + np.abs(ahead)))[smooth]
    assert off.max() < 0.03


def test_beyond_a_joint_one_edge_gives_the_labels():
    """Rounding chose in every pixel anew, and edges' directions were strewn over each other."""
    joint = drawn([[0.1, 0.413], [0.507, 0.507], [0.9, 0.391]], [[1, 2], [0, 1]], np.full((2, 2), 0.3))
    t = cz.texture(joint, 128, maps=["direction", "strand", "distance"])
    beside = t["direction"][:40, 62:68].reshape(-1, 2)
    assert (beside == beside[0]).all() and beside[0][1] < 0
    strand = t["strand"][40:50, 63:66]
    assert (strand[strand >= 0] == 0).all() and (strand == 0).sum() > 12


def test_the_same_edge_twice_is_the_first():
    t = cz.texture(HARD["twice"], 64, maps=["direction", "strand"])
    assert set(np.unique(t["strand"])) == {-1, 0}
    assert (t["direction"] == t["direction"][0, 0]).all()


def test_an_edge_shorter_than_it_widens_keeps_its_direction():
    disc = drawn([[0.5, 0.5], [0.5, 0.6]], [[0, 1]], [[0.1, 0.4]])
    assert (cz.texture(disc, 16, maps=["direction"])["direction"] == (0, 1)).all()


def test_heights_are_not_cut_off_at_the_bottom():
    """What plates take of the range is not left for the cracks; floors were flat, and their normals were not."""
    bar = drawn([[0.5, -1], [0.5, 2]], [[0, 1]], [[0.4, 0.4]])
    material = cz.Material(depth=1.0, level=0.3, grain=0.0, tilt=0.2, roundness=0.0, rim=0.0)
    t = cz.texture(bar, 101, maps=["height", "normal"], material=material)
    assert (t["height"] == 0).mean() < 0.02
    assert (np.diff(t["height"][50, 32:50]) < 0).all()


def test_normals_are_level_where_the_range_of_heights_ends():
    material = cz.Material(depth=1.0, level=1.0, tilt=1.0, roundness=0.0, curl=-1.0, relief=1.0)
    t = cz.texture(cz.crack(n=12, rng=1), 64, maps=["height", "normal"], material=material)
    cut = (t["height"] == 0) | (t["height"] == 1)
    assert cut.any() and (t["normal"][cut] == (0, 0, 1)).all()
