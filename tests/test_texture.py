"""Aligned maps of crack patterns."""

from __future__ import annotations

import dataclasses
import hashlib
from types import SimpleNamespace

import numpy as np
import pytest
import shapely
import shapely.ops

import crazing as cz
from crazing.texture import MAPS

ROUGH = cz.Material(tilt=0.1, level=0.05, grain=0.02, curl=0.1, chip=0.5, fray=0.6, tint=0.5, wear=0.5)
SMOOTH = dataclasses.replace(ROUGH, grain=0, chip=0, fray=0)

#: Of all maps of some lines in `ROUGH`: one for every platform.
GOLDEN = "06270ee85eff926e5e5a53d2a928e5cfe471a5a19584da2cde243a4bc28d4013"


def same(one, other):
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


def lines(ends, widths, bounds=(0.0, 0.0, 1.0, 1.0)):
    """A crack of separate straight edges."""
    ends = np.asarray(ends, dtype=float).reshape(-1, 4)
    rows = np.arange(len(ends), dtype=np.int32)
    graph = SimpleNamespace(vertices=ends.reshape(-1, 2), edges=np.stack([2 * rows, 2 * rows + 1], axis=1))
    width = np.asarray(widths, dtype=float).reshape(-1, 2)
    return SimpleNamespace(graph=graph, width=width, strand=rows, generation=rows, bounds=bounds)


def middles(size, bounds=(0.0, 0.0, 1.0, 1.0)):
    """x and y of the pixels' middles."""
    at = (np.arange(size) + 0.5) / size * (bounds[2] - bounds[0])
    return np.meshgrid(bounds[0] + at, bounds[3] - at)


@pytest.fixture(scope="module")
def net():
    return cz.crack(n=60, opening=0.5, rng=5)


@pytest.fixture(scope="module")
def torus():
    return cz.crack(n=60, opening=0.5, period=(1, 1), rng=5)


@pytest.fixture(scope="module")
def whole(net):
    return cz.texture(net, (120, 150), maps="all")


def test_maps_have_their_types_and_are_frozen(whole):
    for name, (dtype, channels) in MAPS.items():
        assert whole[name].dtype == dtype
        assert whole[name].shape == ((120, 150) if channels == 1 else (120, 150, channels))
        assert not whole[name].flags.writeable
        assert np.isfinite(whole[name]).all()


@pytest.mark.parametrize("window", [(0, 0, 120, 150), (31, 57, 64, 65), (119, 149, 1, 1), (3, 0, 17, 150)])
def test_windows_equal_the_whole(net, whole, window):
    top, left, height, width = window
    part = cz.texture_plan(net, (120, 150), maps="all").window(*window)
    same(part, {name: whole[name][top : top + height, left : left + width] for name in whole})


def test_threads_do_not_matter(net):
    one, many = (cz.texture(net, 300, maps="all", material=ROUGH, threads=threads) for threads in (1, 3))
    same(one, many)


def test_one_hash_everywhere():
    """Debug builds, other processors and other thread counts are held to the same pixels in rust/crazing/tests."""
    ends = np.arange(1, 161).reshape(40, 4) * 0.6180339887498949 % 1
    maps = cz.texture(lines(ends, ends[:, :2] / 25), 96, maps="all", material=ROUGH, seed=3)
    found = hashlib.sha256(b"".join(maps[name].astype(maps[name].dtype.newbyteorder("<")).tobytes() for name in MAPS))
    assert found.hexdigest() == GOLDEN


@pytest.mark.parametrize("material", [None, ROUGH])
@pytest.mark.parametrize("by", [(37, -91), (0, 1), (-64, 200)])
def test_a_shifted_pattern_is_the_rolled_texture(torus, material, by):
    """Moving the pattern by whole pixels moves every map, bit for bit."""
    size = 128
    shifted = torus.shifted(*np.array(by) / size)
    assert ((shifted.graph.vertices >= 0) & (shifted.graph.vertices < 1)).all()
    one, other = (cz.texture(crack, size, maps="all", material=material) for crack in (torus, shifted))
    same({name: np.roll(one[name], (-by[1], by[0]), axis=(0, 1)) for name in one}, other)


def test_a_shift_goes_around_the_torus(torus):
    """Away and back, or by whole periods, nothing has moved; without a period there is nowhere to go."""
    there = torus.shifted(3 / 8, -5 / 16)
    back = there.shifted(-3 / 8, 5 / 16)
    assert (there.shifts != torus.shifts).any()
    np.testing.assert_array_equal(back.shifts, torus.shifts)
    np.testing.assert_allclose(back.graph.vertices, torus.graph.vertices, atol=1e-15)
    assert torus.shifted(2, -1) == torus
    np.testing.assert_allclose(np.diff(there.segments, axis=1), np.diff(torus.segments, axis=1), atol=1e-15)
    with pytest.raises(ValueError, match="no period"):
        cz.crack(n=20, rng=1).shifted(0.5, 0)
    with pytest.raises(ValueError, match="dx is nan"):
        torus.shifted(float("nan"), 0)


@pytest.mark.parametrize("material", [None, ROUGH])
def test_tiles_have_no_seam(torus, material):
    one = cz.texture(torus, (72, 72), maps="all", material=material)
    four = cz.texture(torus, 144, maps="all", material=material, bounds=(0, 0, 2, 2))
    same({name: np.tile(one[name], (2, 2) + (1,) * (one[name].ndim - 2)) for name in one}, four)
    around = cz.texture_plan(torus, 72, maps="all", material=material).window(-30, 50, 72, 72)
    same({name: np.roll(one[name], (30, -50), axis=(0, 1)) for name in one}, around)


def test_distance_is_that_to_the_tapered_hulls():
    rng = np.random.default_rng(2)
    ends, widths = rng.random((12, 4)), rng.random((12, 2)) * 0.06
    found = cz.texture(lines(ends, widths), 64, maps=["distance"])["distance"]
    x, y = (part.ravel() for part in middles(64))
    least = np.full(len(x), np.inf)
    for (ax, ay, bx, by), (wa, wb) in zip(ends, widths, strict=True):
        # The distance to the disc at t is convex in t: thirds close in on the least.
        def disc(t, ax=ax, ay=ay, bx=bx, by=by, wa=wa, wb=wb):
            return np.hypot(x - ax - t * (bx - ax), y - ay - t * (by - ay)) - (wa + t * (wb - wa)) / 2

        low, high = np.zeros(len(x)), np.ones(len(x))
        for _ in range(90):
            first, second = low + (high - low) / 3, high - (high - low) / 3
            nearer = disc(first) < disc(second)
            low, high = np.where(nearer, low, first), np.where(nearer, second, high)
        np.minimum(least, disc(low), out=least)
    np.testing.assert_allclose(found.ravel(), least, atol=1e-6)


def test_distance_outside_is_that_of_shapely():
    ends = [[0.1, 0.1, 0.5, 0.3], [0.5, 0.3, 0.9, 0.8], [0.2, 0.9, 0.2, 0.6]]
    found = cz.texture(lines(ends, [[0.04, 0.04]] * 3), 80, maps=["distance"])["distance"]
    x, y = middles(80)
    points = shapely.points(x, y)
    wanted = np.min([shapely.distance(shapely.LineString(np.reshape(end, (2, 2))), points) for end in ends], axis=0)
    np.testing.assert_allclose(found, wanted - 0.02, atol=1e-6)


def test_far_cracks_are_found_from_any_window():
    """A lone crack, farther from most windows than the first search looks."""
    lone = lines([[0.01, 0.012, 0.011, 0.01]], [[1e-4, 2e-4]])
    plan = cz.texture_plan(lone, 1 << 17, maps=["distance", "strand"])
    part = plan.window(5000, 120_000, 3, 4)
    x, y = (120_000.5 + np.arange(4)) / (1 << 17), 1 - (5000.5 + np.arange(3)) / (1 << 17)
    wanted = shapely.distance(shapely.LineString([[0.01, 0.012], [0.011, 0.01]]), shapely.points(*np.meshgrid(x, y)))
    np.testing.assert_allclose(part["distance"], wanted, atol=2e-4)
    assert (part["strand"] == -1).all()
    np.testing.assert_array_equal(plan.window(5001, 120_002, 1, 1)["distance"], part["distance"][1:2, 2:3])


def test_mask_agrees_with_render(net):
    """The coverage is within .1 of 64 samples a pixel, but for the few pixels where cracks meet."""
    wide = dataclasses.replace(net, width=net.width * 2)
    ours = cz.texture(wide, 256, maps=["mask"])["mask"].astype(int)
    theirs = cz.render(wide, 256, style=cz.Style(ink="#fff", ground="#000"))[..., 0].astype(int)
    off = np.abs(ours - theirs)
    assert off.mean() < 0.5
    assert (off > 25).mean() < 0.003
    assert abs(ours.mean() / theirs.mean() - 1) < 0.01


def test_mask_of_an_upright_bar_is_its_area():
    mask = cz.texture(lines([[0.4, -1, 0.4, 2]], [[0.25, 0.25]]), 10, maps=["mask"])["mask"]
    assert mask[5].tolist() == [0, 0, 64, 255, 255, 64, 0, 0, 0, 0]
    thin = cz.texture(lines([[0.45, -1, 0.45, 2]], [[0.02, 0.02]]), 10, maps=["mask"])["mask"]
    assert thin[5].tolist() == [0, 0, 0, 0, 51, 0, 0, 0, 0, 0]


@pytest.mark.parametrize("opening", [0.0, 0.6, 1.0])
def test_cells_are_the_faces_of_the_drawing(opening):
    crack = cz.crack(n=120, opening=opening, rng=7)
    t = cz.texture(crack, 200, maps=["cell", "distance"])
    border = shapely.box(*crack.bounds).exterior
    drawing = shapely.unary_union([border, *map(shapely.LineString, crack.graph.segments)], grid_size=1e-10)
    faces = list(shapely.ops.polygonize(drawing))
    points = shapely.points(*middles(200)).ravel()
    at, face = shapely.STRtree(faces).query(points, predicate="within")
    beside = t["distance"].ravel()[at] > 0
    pairs = np.unique(np.stack([face, t["cell"].ravel()[at]])[:, beside], axis=1)
    # One plate a face, and one face a plate.
    assert all(len(np.unique(numbers)) == len(numbers) for numbers in pairs)


def test_cells_hold_what_floats_in_them():
    square = [[0.2, 0.2, 0.8, 0.2], [0.8, 0.2, 0.8, 0.8], [0.8, 0.8, 0.2, 0.8], [0.2, 0.8, 0.2, 0.2]]
    island = [[0.4, 0.4, 0.6, 0.45]]
    crack = lines([*square, *island], [[0.01, 0.01]] * 5)
    corners = np.array([[0.2, 0.2], [0.8, 0.2], [0.8, 0.8], [0.2, 0.8], [0.4, 0.4], [0.6, 0.45]])
    crack.graph = SimpleNamespace(vertices=corners, edges=np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5]]))
    cell = cz.texture(crack, 50, maps=["cell"])["cell"]
    assert set(np.unique(cell)) == {0, 1}
    x, y = middles(50)
    inside = (np.abs(x - 0.5) < 0.29) & (np.abs(y - 0.5) < 0.29)
    outside = (np.abs(x - 0.5) > 0.31) | (np.abs(y - 0.5) > 0.31)
    assert len(np.unique(cell[inside])) == len(np.unique(cell[outside])) == 1


@pytest.mark.parametrize("material", [cz.Material(), SMOOTH, cz.Material(curl=-0.2, tilt=0.1, roundness=1.0)])
def test_normals_are_the_slope_of_the_height(net, material):
    """At a scale where a pixel is small against everything, differences of the height give the normal.

    Noise is as fine as pixels at any scale: that of `test_brute` is looked at between them.
    """
    small = (0.4, 0.4, 0.44, 0.44)
    t = cz.texture(net, 400, maps=["height", "normal", "cell"], material=material, bounds=small)
    np.testing.assert_allclose(np.linalg.norm(t["normal"], axis=2), 1, atol=1e-6)
    height = t["height"].astype(float) * t.relief * t.scale
    right, down = (height[1:-1, 2:] - height[1:-1, :-2]) / 2, (height[2:, 1:-1] - height[:-2, 1:-1]) / 2
    normal = t["normal"][1:-1, 1:-1].astype(float)
    off = np.abs(normal[..., :2] / normal[..., 2:] - np.stack([-right, down], axis=2)).max(axis=2)
    # Creases, such as the middle of a crack and its rim, have no slope.
    assert np.quantile(off, 0.9) < 0.02


def test_occlusion_is_one_beside_cracks_and_less_within():
    bar = lines([[0.5, -1, 0.5, 2]], [[0.2, 0.2]])
    ao = cz.texture(bar, 50, maps=["ao"], material=cz.Material(rim=0, relief=1.0))["ao"][20]
    assert (ao[:15] == 1).all() and (ao[35:] == 1).all()
    assert (np.diff(ao[20:25]) < 0).all() and ao[25] < 0.7


def test_labels_are_those_of_the_nearest_edge(net):
    t = cz.texture(net, 100, maps=["strand", "generation", "mask", "direction", "distance"])
    on = t["mask"] > 0
    # Wherever a crack comes within half a pixel of the centre, as far as distances in float32 tell.
    labelled, half = t["strand"] >= 0, 0.005
    assert labelled[on].all()
    assert t["distance"][labelled].max() <= half * (1 + 1e-6) and t["distance"][~labelled].min() >= half * (1 - 1e-6)
    first = np.zeros(net.strand.max() + 1, dtype=int)
    first[net.strand] = net.generation
    np.testing.assert_array_equal(t["generation"][on], first[t["strand"][on]])
    np.testing.assert_allclose(np.linalg.norm(t["direction"], axis=2), 1, atol=1e-6)


def test_no_crack_at_all():
    t = cz.texture(lines([], []), 8, maps="all")
    assert np.isinf(t["distance"]).all() and not t["mask"].any() and (t["ao"] == 1).all()
    assert (t["strand"] == -1).all() and (t["normal"][..., 2] == 1).all()


def test_lit_textures_tile(torus):
    maps = ["color", "normal", "ao", "height", "roughness"]
    lit = cz.texture(torus, 64, maps=maps).lit()
    four = cz.texture(torus, 128, maps=maps, bounds=(0, 0, 2, 2)).lit()
    assert lit.std() > 5
    np.testing.assert_array_equal(np.tile(lit, (2, 2, 1)), four)


@pytest.mark.parametrize("name", cz.presets())
def test_every_preset_has_a_material_of_its_own(name):
    material = cz.texture_plan(lines([[0, 0, 1, 1]], [[0.1, 0.1]]), 8, material=name).material
    assert material != cz.Material()
    assert cz.preview(name, 32, rng=1).shape == (32, 32, 4)


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"size": 0}, ValueError, "size"),
        ({"size": (1, 2, 3)}, ValueError, "size"),
        ({"size": 1 << 21}, ValueError, "size"),
        ({"maps": ["colour"]}, ValueError, r"maps\[0\]"),
        ({"maps": []}, ValueError, "maps is empty"),
        ({"material": 7}, TypeError, "Material"),
        ({"material": "cheese"}, ValueError, "material"),
        ({"bounds": (0, 0, 0, 1)}, ValueError, "bounds"),
        ({"threads": 0}, ValueError, "threads"),
        ({"seed": -1}, ValueError, "seed"),
        ({"crack": None}, TypeError, "Crack"),
        ({"crack": lines([[0, 0, np.nan, 1]], [[0.1, 0.1]])}, ValueError, r"vertices\[1\]"),
        ({"crack": lines([[0, 0, 1, 1]], [[0.1, -0.1]])}, ValueError, r"widths\[0\]"),
    ],
)
def test_bad_arguments(net, change, error, words):
    given = {"crack": net, "size": 8, **change}
    with pytest.raises(error, match=words):
        cz.texture(given.pop("crack"), given.pop("size"), **given)


def test_a_period_of_broken_pixels_is_refused(torus):
    with pytest.raises(cz.CrazingError, match="period in pixels"):
        cz.texture(torus, 64, bounds=(0, 0, 0.7, 0.7))


@pytest.mark.parametrize(
    ("fields", "error"),
    [
        ({"depth": 2}, ValueError),
        ({"plate": []}, ValueError),
        ({"plate": "#fff"}, ValueError),
        ({"crack": "#ffffff80"}, ValueError),
        ({"relief": float("nan")}, ValueError),
    ],
)
def test_bad_materials(fields, error):
    with pytest.raises(error, match=next(iter(fields))):
        cz.Material(**fields)


def test_shade_wants_its_maps(net):
    with pytest.raises(ValueError, match="lacks color, normal, ao"):
        cz.texture(net, 8, maps=["height"]).lit()
    with pytest.raises(ValueError, match="light"):
        cz.texture(net, 8).lit(light=(0, 0, -1))


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
def test_lengths_of_a_material_are_parts_of_what_numpy_measures(period):
    crack = cz.crack(n=150, period=period, rng=3)
    plan = cz.texture_plan(crack, 64, material=cz.Material(rim_width=0.5))
    segments = crack.graph.vertices[crack.graph.edges]
    step = segments[:, 1] - segments[:, 0]
    if period is not None:
        step += crack.shifts * np.asarray(crack.period)
    length = np.hypot(*step.T).sum()
    assert plan.relief == pytest.approx(plan.material.relief * 2 / length, rel=1e-12)
    assert plan._scaled["widest"] == pytest.approx(np.quantile(crack.width, 0.95), rel=1e-14)
