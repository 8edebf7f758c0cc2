"""Points of a distribution: the right law, the same points for a seed everywhere, clear refusals."""

from __future__ import annotations

import inspect

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import special, stats
from scipy.spatial import cKDTree

import crazing as cz
from crazing.errors import CrazingError

SAMPLERS = [cz.sample.uniform, cz.sample.normal, cz.sample.laplace]
LAWS = [
    (cz.sample.uniform, stats.uniform(), 1 / 2, 1 / 12),
    (cz.sample.normal, stats.norm(), 0.0, 1.0),
    (cz.sample.laplace, stats.laplace(), 0.0, 2.0),
]


def philox_words(key: tuple[int, int], index: int, stream: int) -> list[int]:
    """Words 0 and 1 of a block, by NumPy, which counts up once before its first block."""
    before = index + (stream << 128) - 1
    counter = np.array([(before >> (64 * i)) & (2**64 - 1) for i in range(4)], dtype=np.uint64)
    return [int(word) for word in np.random.Philox(counter=counter, key=np.array(key, np.uint64)).random_raw(2)]


def test_uniform_is_numpy_philox_block_by_block() -> None:
    low, high = (int(word) for word in np.random.default_rng(5).bit_generator.random_raw(2))
    words = np.array([philox_words((low, high), i, 1) for i in range(20)], dtype=np.uint64)
    expected = ((words >> np.uint64(12)).astype(float) + 0.5) / 2**52
    np.testing.assert_array_equal(cz.sample.uniform(20, rng=5), expected)


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(("sampler", "law", "mean", "variance"), LAWS)
def test_law(sampler, law, mean, variance, seed) -> None:
    n = 20_000
    points = sampler(n, rng=seed)
    for axis in points.T:
        assert stats.kstest(axis, law.cdf).pvalue > 1e-3
    np.testing.assert_allclose(points.mean(axis=0), mean, atol=5 * np.sqrt(variance / n))
    np.testing.assert_allclose(points.var(axis=0), variance, rtol=0.08)
    assert abs(stats.spearmanr(*points.T).statistic) < 4 / np.sqrt(n)


def test_quantiles_against_scipy() -> None:
    p = cz.sample.uniform(100_000, rng=3)
    np.testing.assert_allclose(cz.sample.normal(100_000, rng=3), special.ndtri(p), rtol=4e-15, atol=1e-16)
    np.testing.assert_allclose(cz.sample.laplace(100_000, rng=3), stats.laplace.ppf(p), rtol=4e-15, atol=1e-15)


FROZEN = {
    "uniform": [[0.07092255516581691, 0.5424170986567362], [0.43134170750412715, 0.8637079386365499]],
    "normal": [[-1.4689545754643505, 0.10652502324005261], [-0.1729593054588174, 1.0971310178671179]],
    "laplace": [[-1.9530195890183817, 0.08865002500039261], [-0.14770749760247515, 1.2998080052644392]],
}


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_frozen(sampler) -> None:
    """A change here changes what a seed gives, on every user's disk."""
    assert sampler(2, rng=2026).tolist() == FROZEN[sampler.__name__]


@pytest.mark.parametrize("sampler", SAMPLERS)
@given(n=st.integers(0, 200), more=st.integers(0, 200), seed=st.integers(0, 2**70))
@settings(max_examples=30, deadline=None)
def test_fewer_points_are_the_first_of_the_more(sampler, n, more, seed) -> None:
    points = sampler(n, rng=seed)
    assert points.shape == (n, 2) and points.dtype == np.float64 and points.flags.c_contiguous
    np.testing.assert_array_equal(points, sampler(n + more, rng=seed)[:n])


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_generator_moves_on_and_none_differs(sampler) -> None:
    generator = np.random.default_rng(1)
    first, second = sampler(5, rng=generator), sampler(5, rng=generator)
    assert not np.array_equal(first, second)
    assert not np.array_equal(sampler(5), sampler(5))
    np.testing.assert_array_equal(first, sampler(5, rng=1))


@pytest.mark.parametrize("sampler", [cz.sample.normal, cz.sample.laplace])
def test_loc_and_scale(sampler) -> None:
    plain = sampler(50, rng=9)
    np.testing.assert_array_equal(sampler(50, loc=(8, -8), scale=(2, 4), rng=9), (8, -8) + plain * (2, 4))
    np.testing.assert_array_equal(sampler(50, loc=np.float32(3), scale=0.5, rng=9), 3 + plain * 0.5)
    np.testing.assert_array_equal(sampler(2, loc=(1, 2), scale=0, rng=9), [[1, 2], [1, 2]])


def test_bounds() -> None:
    points = cz.sample.uniform(1000, bounds=(-2, 10, -1, 30), rng=0)
    assert (points.min(axis=0) >= (-2, 10)).all() and (points.max(axis=0) <= (-1, 30)).all()


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        ({"n": -1}, ValueError, "n is -1"),
        ({"n": 1.5}, TypeError, "n is 1.5"),
        ({"n": True}, TypeError, "n is True"),
        ({"n": 2**31}, ValueError, "n is 2147483648"),
        ({"n": 1, "scale": -1}, ValueError, "scale is -1"),
        ({"n": 1, "scale": np.nan}, ValueError, "nan"),
        ({"n": 1, "loc": (1, 2, 3)}, ValueError, r"loc has 3 entries"),
        ({"n": 1, "loc": "here"}, TypeError, "here"),
        ({"n": 1, "loc": (0, np.inf)}, ValueError, r"loc\[1\] is inf"),
        ({"n": 1, "scale": 1e307}, CrazingError, "overflow"),
        ({"n": 1, "rng": -1}, ValueError, "rng is -1"),
        ({"n": 1, "rng": "seed"}, TypeError, "rng is 'seed'"),
    ],
)
def test_refusals(arguments, error, words) -> None:
    for sampler in (cz.sample.normal, cz.sample.laplace):
        with pytest.raises(error, match=words):
            sampler(**arguments)


@pytest.mark.parametrize("bounds", [(0, 0, 0, 1), (0, 0, 1), (0, 0, 1, np.inf), (-1e308, 0, 1e308, 1), 5, "abcd"])
def test_bad_bounds(bounds) -> None:
    with pytest.raises((TypeError, ValueError), match="bounds"):
        cz.sample.uniform(1, bounds=bounds)


@pytest.mark.parametrize("sampler", SAMPLERS)
def test_everything_after_n_is_keyword_only(sampler) -> None:
    kinds = [parameter.kind for parameter in inspect.signature(sampler).parameters.values()]
    assert kinds[1:] == [inspect.Parameter.KEYWORD_ONLY] * (len(kinds) - 1)


@pytest.mark.parametrize("period", [None, (1.0, 2.0), (0.5, 0.06)])
def test_poisson_disks_keep_their_distance_and_leave_no_room(period) -> None:
    radius = 0.05
    points = cz.sample.poisson_disk(radius, bounds=(0, 0, 1, 2), period=period, rng=3)
    box = np.array(period or (1.0, 2.0))
    tree = cKDTree(points, boxsize=box if period else None)
    assert tree.query(points, k=2)[0][:, 1].min() >= radius * (1 - 1e-12)
    # Maximal: hardly a place is farther than a radius from all.
    places = cz.sample.uniform(4000, rng=1) * box
    assert (tree.query(places)[0] > radius).mean() < 0.03
    assert ((points >= 0) & (points <= box)).all()
    np.testing.assert_array_equal(points, cz.sample.poisson_disk(radius, bounds=(0, 0, 1, 2), period=period, rng=3))
    if period is None:
        assert len(points) * radius**2 / 2 == pytest.approx(0.7, abs=0.05)


def test_many_poisson_disks_are_like_few() -> None:
    """Few on a torus are made in one piece, many by tiles: no law may tell them apart, nor where tiles met."""
    rng = np.random.default_rng(1)
    few = [measured(cz.sample.poisson_disk(1, period=(78, 78), rng=seed), 78, rng) for seed in range(40)]
    many = [measured(cz.sample.poisson_disk(1, period=(390, 390), rng=seed), 390, rng) for seed in range(2)]
    # Density, mean distance to the nearest, and the share of places farther than a radius from all.
    for one, other, tolerance in zip(np.mean(few, axis=0), np.mean(many, axis=0), (2e-3, 1e-3, 2.5e-4), strict=True):
        assert other == pytest.approx(one, abs=tolerance)


def measured(points, side: float, rng: np.random.Generator) -> tuple[float, float, float]:
    tree = cKDTree(points, boxsize=side)
    holes = tree.query(side * rng.random((10 * len(points), 2)))[0] > 1
    return len(points) / side**2, tree.query(points, k=2)[0][:, 1].mean(), holes.mean()


def test_no_border_of_a_tile_shows() -> None:
    side = 390
    to_border, holes = [], []
    # As many cells as the radius asks for, and tiles of about 32 of them, even in number.
    cells = int(np.ceil(side * np.sqrt(2)))
    tiles = 2 * np.ceil(cells // 32 / 2)
    borders = np.ceil(np.arange(tiles + 1) * cells / tiles) / cells * side
    for seed in range(4):
        points = cz.sample.poisson_disk(1, period=(side, side), rng=seed)
        to_border.append(np.abs(points[:, :, None] - borders).min(axis=2).ravel())
        places = side * np.random.default_rng(seed).random((200_000, 2))
        far = cKDTree(points, boxsize=side).query(places)[0] > 1
        holes.append([far[np.abs(places[:, :, None] - borders).min(axis=(1, 2)) < 2].mean(), far.mean()])
    # How many lie so far from the nearest border, against an even spread: disks are more even than chance.
    counts = np.histogram(np.concatenate(to_border), bins=np.arange(0, 8.5, 0.5))[0]
    even = len(np.concatenate(to_border)) * len(borders[1:]) * 2 * 0.5 / side
    assert np.abs(counts / even - 1).max() < 4 / np.sqrt(even)
    near, everywhere = np.mean(holes, axis=0)
    assert near == pytest.approx(everywhere, abs=2.5e-4)


@pytest.mark.parametrize(
    ("width", "height"), [(150.0, 130.0), (500.0, 60.0), (500.0, 40.0), (2000.0, 10.0), (3000.0, 5.0)]
)
@pytest.mark.parametrize("on_torus", [False, True])
def test_many_poisson_disks_keep_their_distance(width: float, height: float, on_torus: bool) -> None:
    box = np.array((width, height))
    where = {"period": box} if on_torus else {"bounds": (0, 0, *box)}
    points = cz.sample.poisson_disk(1, rng=7, **where)
    tree = cKDTree(points, boxsize=box if on_torus else None)
    assert tree.query(points, k=2)[0][:, 1].min() >= 1 - 1e-12
    assert ((points >= 0) & (points <= box)).all()
    assert (tree.query(np.random.default_rng(1).random((20_000, 2)) * box)[0] > 1).mean() < 0.01


def test_many_poisson_disks_are_the_same_for_any_number_of_threads(by_threads) -> None:
    points = "cz.sample.poisson_disk(4e-3, rng=3)"
    program = f"import hashlib, crazing as cz; print(hashlib.sha256({points}.tobytes()).hexdigest())"
    assert len(by_threads(program)) == 1


@pytest.mark.parametrize("radius", [0, -1, np.nan, 1e-9, "far"])
def test_bad_radius(radius) -> None:
    with pytest.raises((TypeError, ValueError), match="radius"):
        cz.sample.poisson_disk(radius)


def test_density_is_the_law_of_the_pixels() -> None:
    image = np.array([[0, 51, 255], [102, 0, 204]], dtype=np.uint8)
    points = cz.sample.from_density(image, 30_000, bounds=(0, 0, 3, 2), rng=5)
    column, row = points[:, 0].astype(int), 1 - points[:, 1].astype(int)
    found = np.zeros((2, 3))
    np.add.at(found, (row, column), 1)
    assert (found[image == 0] == 0).all()
    wanted = image / image.sum() * len(points)
    assert stats.chisquare(found[image > 0], wanted[image > 0]).pvalue > 1e-3
    inside = points - np.floor(points)
    assert all(stats.kstest(axis, "uniform").pvalue > 1e-3 for axis in inside.T)
    np.testing.assert_array_equal(points[:10], cz.sample.from_density(image, 10, bounds=(0, 0, 3, 2), rng=5))


@pytest.mark.parametrize("image", [np.zeros((2, 2)), [[-1.0, 2.0]], [[np.nan]], np.empty((0, 3)), [1.0, 2.0]])
def test_bad_density(image) -> None:
    with pytest.raises(ValueError, match=r"density|image|pixel"):
        cz.sample.from_density(image, 3)


@pytest.mark.parametrize("n", [1, 2, 3, 50, 200])
def test_relaxed_points_are_centroids_of_clipped_cells_by_shapely(n: int) -> None:
    points = cz.sample.uniform(n, bounds=(0, 0, 2, 1), rng=n)
    box = shapely.box(0, 0, 2, 1)
    cells = shapely.get_parts(shapely.voronoi_polygons(shapely.MultiPoint(points), extend_to=box.buffer(9)))
    cells = shapely.intersection(cells, box) if n > 1 else np.array([box])
    tree = shapely.STRtree(cells)
    owner = tree.query(shapely.points(points), predicate="within")[1]
    wanted = shapely.get_coordinates(shapely.centroid(cells[owner]))
    found = cz.sample.relax(points, iterations=1, bounds=(0, 0, 2, 1))
    np.testing.assert_allclose(found, wanted, atol=1e-9)


def test_relaxing_on_a_torus_is_relaxing_copies() -> None:
    points = cz.sample.uniform(60, bounds=(0, 0, 1, 0.5), rng=3)
    copies = np.concatenate([points + np.array((a, b / 2)) for a in (0, -1, 1) for b in (0, -1, 1)])
    wanted = cz.sample.relax(copies, iterations=1, bounds=(-1, -0.5, 2, 1))[:60]
    found = cz.sample.relax(points, iterations=1, bounds=(0, 0, 1, 0.5), period=(1, 0.5))
    np.testing.assert_allclose((found - wanted + 0.25) % (1, 0.5), 0.25, atol=1e-12)
    # Shifted by any amount it is the same.
    moved = cz.sample.relax(points + 7.3, iterations=1, bounds=(7.3, 7.3, 8.3, 7.8), period=(1, 0.5))
    np.testing.assert_allclose((moved - 7.3 - found + 0.25) % (1, 0.5), 0.25, atol=1e-9)


def test_relaxing_evens_out() -> None:
    points = cz.sample.uniform(300, rng=1)
    nearest = [
        cKDTree(p).query(p, k=2)[0][:, 1].std() / cKDTree(p).query(p, k=2)[0][:, 1].mean()
        for p in (cz.sample.relax(points, iterations=k, bounds=(0, 0, 1, 1)) for k in (0, 1, 5, 30))
    ]
    assert nearest == sorted(nearest, reverse=True) and nearest[-1] < 0.15


@pytest.mark.parametrize("more", [{"iterations": -1}, {"bounds": (0, 0, 0, 1)}, {"period": (2, 1)}])
def test_bad_relaxation(more) -> None:
    with pytest.raises(ValueError, match=r"iterations|bounds|period"):
        cz.sample.relax([(0.5, 0.5)], **{"iterations": 1, "bounds": (0, 0, 1, 1), **more})
