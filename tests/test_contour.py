"""Contours of images: the right place, the right frame, even spacing, exact numbers of points."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import crazing as cz
from crazing.contour import contours
from crazing.errors import CrazingError
from crazing.spread import shares


def disc(size: int = 41, radius: float = 15.0, centre: tuple[float, float] | None = None) -> np.ndarray:
    """Radius minus the distance of every pixel centre from `centre`, (x, y up); positive inside."""
    x0, y0 = centre or (size / 2, size / 2)
    rows, cols = np.mgrid[:size, :size]
    return radius - np.sqrt((cols + 0.5 - x0) ** 2 + (size - rows - 0.5 - y0) ** 2)


def blobs(size: int = 120, seed: int = 0) -> np.ndarray:
    """A smooth random image of values near [-1, 1]."""
    generator = np.random.default_rng(seed)
    y, x = np.mgrid[:size, :size] / size * 2 * np.pi
    terms = generator.normal(size=(12, 5))
    waves = sum(a * np.sin(3 * b * x + 3 * c * y + 6 * p) * np.cos(q * x) for a, b, c, p, q in terms)
    return waves / np.abs(waves).max()


def steps(line: np.ndarray, *, closed: bool = True) -> np.ndarray:
    ring = np.vstack([line, line[:1]]) if closed else line
    return np.linalg.norm(np.diff(ring, axis=0), axis=1)


def test_circle_in_the_frame_of_pixels() -> None:
    points = cz.sample.from_image(disc(centre=(18.0, 25.0)), level=0.0)
    assert points.shape[1] == 2 and points.dtype == np.float64
    assert np.abs(np.linalg.norm(points - (18.0, 25.0), axis=1) - 15.0).max() < 0.02


def test_y_points_up() -> None:
    image = np.zeros((10, 20))
    image[1, 3] = 1.0
    np.testing.assert_allclose(cz.sample.from_image(image).mean(axis=0), (3.5, 8.5))


def as_set(line: np.ndarray) -> set[tuple[float, ...]]:
    return {tuple(point) for point in np.round(line, 6)}


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("level", [-0.3, 0.0, 0.21])
def test_same_lines_as_scikit_image(seed, level) -> None:
    measure = pytest.importorskip("skimage.measure")
    image = blobs(seed=seed)
    ours = contours(image, level)
    theirs = []
    for line in measure.find_contours(image, level):
        flipped = np.column_stack([line[:, 1] + 0.5, len(image) - line[:, 0] - 0.5])
        closed = bool((line[0] == line[-1]).all())
        theirs.append((closed, frozenset(as_set(flipped[:-1] if closed else flipped))))
    mine = [(bool(closed), frozenset(as_set(line))) for line, closed in zip(ours.lines, ours.closed, strict=True)]
    assert len(mine) == len(theirs) and set(mine) == set(theirs)


@pytest.mark.parametrize("n", [3, 4, 17, 500, 5000])
def test_exactly_n_points_evenly(n) -> None:
    points = cz.sample.from_image(disc(), level=0.0, n=n)
    assert points.shape == (n, 2)
    chords = steps(points)
    assert chords.max() / chords.min() < 1.02 if n < 300 else chords.max() / chords.min() < 1.2


def test_n_is_shared_in_proportion_to_length() -> None:
    image = np.maximum(disc(200, 60, (70, 100)), disc(200, 15, (170, 100)))
    points = cz.sample.from_image(image, level=0.0, n=500)
    left = np.count_nonzero(points[:, 0] < 140)
    assert len(points) == 500 and abs(left - 400) <= 1


def test_short_contours_are_left_out_first() -> None:
    image = np.maximum(disc(200, 60, (70, 100)), disc(200, 5, (170, 100)))
    assert (cz.sample.from_image(image, level=0.0, n=20)[:, 0] < 140).all()
    assert (cz.sample.from_image(image, level=0.0, n=60)[:, 0] > 140).sum() >= 3


@given(
    length=hnp.arrays(np.float64, st.integers(1, 60), elements=st.floats(1e-3, 1e4)),
    n=st.integers(3, 3000),
)
@settings(max_examples=300, deadline=None)
def test_shares(length, n) -> None:
    counts = shares(length, n)
    assert counts.sum() == n and ((counts == 0) | (counts >= 3)).all()
    left_out, kept = length[counts == 0], length[counts > 0]
    assert left_out.size == 0 or left_out.max() <= kept.min()
    quota = n * kept / kept.sum()
    assert (np.abs(counts[counts > 0] - quota) < 1 + 1e-6).all()
    if left_out.size:
        longest = left_out.max()
        assert n * longest / (kept.sum() + longest) < 3 + 1e-6


@pytest.mark.parametrize("spacing", [0.3, 1.0, 7.0])
def test_spacing(spacing) -> None:
    points = cz.sample.from_image(disc(), level=0.0, spacing=spacing)
    assert abs(len(points) - 2 * np.pi * 15 / spacing) < 1.0 + 0.01 * len(points)
    assert steps(points).max() < 1.05 * spacing


def test_open_contours_keep_both_ends() -> None:
    image = np.tile(np.linspace(0.0, 1.0, 11), (21, 1))
    found = contours(image, 0.55)
    assert found.closed.tolist() == [False]
    np.testing.assert_allclose(found.length, [20.0])
    points = cz.sample.from_image(image, level=0.55, n=5)
    np.testing.assert_allclose(points[:, 0], 6.0)
    np.testing.assert_allclose(np.sort(points[:, 1]), [0.5, 5.5, 10.5, 15.5, 20.5])
    assert len(cz.sample.from_image(image, level=0.55, spacing=2.0)) == 11


def test_closed_contours_do_not_repeat_their_first_point() -> None:
    found = contours(blobs(), 0.0)
    assert found.closed.any()
    for line, closed in zip(found.lines, found.closed, strict=True):
        assert steps(line, closed=closed).min() > 0


@pytest.mark.parametrize("level", [0.0, 0.5])
def test_levels_that_pixels_take_exactly(level) -> None:
    image = np.random.default_rng(2).integers(0, 2, (40, 40)).astype(float)
    image[:2] = image[-2:] = 0
    image[:, :2] = image[:, -2:] = 0
    image[10:20, 10:20] = 1
    found = contours(image, level)
    assert (np.diff(found.offsets) >= 2).all() and found.offsets[-1] == len(found.coords)
    for line in found.lines:
        assert steps(line, closed=False).min() > 0
    assert len(found.evenly(300)) == 300


@given(
    image=hnp.arrays(
        np.float64,
        hnp.array_shapes(min_dims=2, max_dims=2, min_side=2, max_side=9),
        elements=st.sampled_from([0.0, 0.5, 1.0, 0.25]),
    )
)
@settings(max_examples=300, deadline=None)
def test_any_small_image(image) -> None:
    try:
        found = contours(image)
    except CrazingError:
        return
    height, width = image.shape
    points = found.evenly(100)
    assert len(points) == 100 and np.isfinite(points).all()
    assert (points >= 0.5).all() and (points <= (width - 0.5, height - 0.5)).all()
    for line, closed in zip(found.lines, found.closed, strict=True):
        assert len(line) >= 2 and steps(line, closed=closed).min() > 0
    expected = [steps(line, closed=closed).sum() for line, closed in zip(found.lines, found.closed, strict=True)]
    np.testing.assert_allclose(found.length, expected)


def test_several_levels_are_the_lines_of_each() -> None:
    image = blobs()
    both = cz.sample.from_image(image, level=[-0.2, 0.4])
    apart = [cz.sample.from_image(image, level=level) for level in (-0.2, 0.4)]
    np.testing.assert_array_equal(both, np.vstack(apart))
    np.testing.assert_array_equal(cz.sample.from_image(image, level=[0.4, 99.0]), apart[1])


def test_every_kind_of_pixel_gives_the_same_points() -> None:
    mask = disc() > 0
    expected = cz.sample.from_image(mask, n=40)
    for dtype in (np.uint8, np.uint16, np.int32, np.uint64):
        top = np.iinfo(dtype).max
        np.testing.assert_allclose(cz.sample.from_image(mask * dtype(top), n=40), expected)
    for dtype in (np.float16, np.float32, np.float64, ">f4"):
        np.testing.assert_allclose(cz.sample.from_image(mask.astype(dtype), n=40), expected)
    colour = np.repeat(mask[..., None], 3, axis=2)
    np.testing.assert_allclose(cz.sample.from_image(colour, n=40), expected, atol=1e-9)
    cut_out = np.zeros((*mask.shape, 4), dtype=np.uint8)
    cut_out[..., 3] = np.where(mask, 0, 255)
    np.testing.assert_allclose(cz.sample.from_image(cut_out, n=40), expected, atol=1e-9)
    np.testing.assert_allclose(cz.sample.from_image(mask[:, ::-1].tolist(), n=40).shape, expected.shape)


def test_the_image_is_left_as_it_is_and_the_result_may_be_written() -> None:
    image = disc()
    before = image.copy()
    image.flags.writeable = False
    points = cz.sample.from_image(image, level=0.0)
    points += 1
    np.testing.assert_array_equal(image, before)


@pytest.mark.parametrize(
    ("image", "arguments", "error", "words"),
    [
        (np.zeros((5, 5)), {}, CrazingError, "run from 0 to 0"),
        (np.eye(5, dtype=np.uint8), {}, CrazingError, r"uint8 divided by 255\); a mask .* bool"),
        (np.eye(5), {"level": 2.0}, CrazingError, "level 2: .* from 0 to 1"),
        (np.where(np.eye(5), np.nan, 0), {}, CrazingError, r"image\[0, 0\] is nan"),
        (np.full((2, 2, 3), np.inf), {}, CrazingError, r"image\[0, 0, 0\] is inf"),
        (np.zeros(5), {}, ValueError, r"shape \(5,\)"),
        (np.zeros((5, 5, 2)), {}, ValueError, "shape"),
        (np.zeros((1, 5)), {}, ValueError, "1 x 5"),
        (np.zeros((0, 5)), {}, ValueError, "0 x 5"),
        (np.eye(5, dtype=complex), {}, TypeError, "complex"),
        (np.array([["a"]]), {}, TypeError, "dtype"),
        (np.eye(5), {"n": 10, "spacing": 1.0}, ValueError, "only one"),
        (np.eye(5), {"n": 2}, ValueError, "n is 2"),
        (np.eye(5), {"spacing": 0}, ValueError, "spacing is 0"),
        (np.eye(5), {"spacing": 1e6}, CrazingError, "too short"),
        (np.eye(5), {"level": np.nan}, ValueError, "level"),
        (np.eye(5), {"level": []}, ValueError, "level"),
        (np.eye(5), {"level": "half"}, TypeError, "level"),
    ],
)
def test_refusals(image, arguments, error, words) -> None:
    with pytest.raises(error, match=words):
        cz.sample.from_image(image, **arguments)


def test_ten_thousand_contours_take_seconds_at_most() -> None:
    y, x = np.mgrid[:3000, :3000] * (2 * np.pi / 30)
    image = np.sin(x) * np.sin(y)
    start = time.perf_counter()
    found = contours(image, 0.8)
    points = found.evenly(60_000)
    assert time.perf_counter() - start < 20
    assert len(found) >= 10_000 and len(points) == 60_000


def test_without_contourpy_the_message_says_what_to_install(monkeypatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "contourpy", None)
    with pytest.raises(ImportError, match=r'pip install "crazing\[image\]"'):
        cz.sample.from_image(disc(), level=0.0)
