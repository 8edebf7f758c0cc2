"""Patches: a field of mean 0 and deviation 1, as long as wanted, whole on a torus; plates follow it."""

from __future__ import annotations

import numpy as np
import pytest

import crazing as cz
from crazing.patches import Patches

PLAIN = np.eye(2), np.zeros(2)


def field(size: float, period: tuple[float, float] | None, seed: int, side: int = 128) -> np.ndarray:
    u = (np.arange(side) + 0.5) / side
    return Patches.of(size, period, np.random.default_rng(seed)).over(u, u, *PLAIN)


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
def test_the_field_has_mean_0_and_deviation_1(period: tuple[float, float] | None) -> None:
    found = np.array([field(0.1, period, seed) for seed in range(24)])
    assert abs(found.mean()) < 0.03
    assert abs(found.std() - 1) < 0.08
    # Nearly normal: 68 and 95 in 100 within one and two deviations.
    assert abs((np.abs(found) < 1).mean() - 0.683) < 0.03
    assert abs((np.abs(found) < 2).mean() - 0.954) < 0.02


def test_patches_are_as_long_as_wanted() -> None:
    """Half a wave is a patch: there the field has turned to the other side."""
    for size in (0.06, 0.12):
        found = np.array([field(size, None, seed) for seed in range(24)])
        step = round(128 * size)
        beside = (found[:, :, step:] * found[:, :, :-step]).mean()
        near = (found[:, :, 2:] * found[:, :, :-2]).mean()
        assert -0.7 < beside < -0.2
        assert near > 0.7


@pytest.mark.parametrize("period", [(1.0, 1.0), (2.0, 0.5)])
def test_on_a_torus_opposite_sides_fit(period: tuple[float, float]) -> None:
    for size in (0.05, 0.3, 10.0):
        patches = Patches.of(size, period, np.random.default_rng(3))
        u, v = (np.linspace(0, 1, 17)[:-1] * side for side in period)
        here = patches.over(u, v, *PLAIN)
        there = patches.over(u + period[0], v - 3 * period[1], *PLAIN)
        np.testing.assert_allclose(here, there, atol=1e-11)
        assert here.std() > 0.1  # A period that no wave fits still has some.


def test_a_frame_moves_the_field_with_it() -> None:
    patches = Patches.of(0.2, None, np.random.default_rng(1))
    matrix, centre = np.array([[0.6, -1.6], [0.8, 1.2]]), np.array([0.3, -2.0])
    u, v = np.array([0.1, 0.7, 2.0]), np.array([-1.0, 0.4])
    places = np.stack(np.meshgrid(u, v), axis=-1) @ matrix.T + centre
    plain = [[patches.over(x[:1], x[1:], *PLAIN)[0, 0] for x in row] for row in places]
    np.testing.assert_allclose(patches.over(u, v, matrix, centre), plain, atol=1e-12)


@pytest.mark.parametrize("where", [{}, {"period": (1, 1)}, {"anisotropy": 2.0, "angle": 90.0, "period": (2, 1)}])
@pytest.mark.parametrize("generator", ["maze", "splitting"])
def test_plates_of_patches_differ_in_size(generator: str, where: dict[str, object]) -> None:
    def clumping(patchiness: float) -> float:
        """Variance over mean of how many vertices boxes hold."""
        found = []
        for seed in range(4):
            how = {"opening": 0, **where} if generator == "maze" else where
            c = cz.crack(generator=generator, n=600, patchiness=patchiness, patch=5, rng=seed, **how)
            wide = c.bounds[2]
            boxes = np.histogram2d(*c.graph.vertices.T, bins=(round(6 * wide), 6), range=((0, wide), (0, 1)))[0]
            found.append(boxes.var() / boxes.mean())
        return float(np.mean(found))

    even, patchy = clumping(0.0), clumping(1.0)
    assert patchy > 3 * even


def test_the_same_seed_gives_the_same_patches() -> None:
    first, again, other = (cz.crack(n=200, patchiness=0.8, rng=seed).graph.vertices for seed in (5, 5, 6))
    np.testing.assert_array_equal(first, again)
    assert first.shape != other.shape or not np.array_equal(first, other)


def test_sizes_out_of_all_bounds_are_refused_or_drawn() -> None:
    for value in (-0.1, 5.0, np.nan):
        with pytest.raises(ValueError, match="patchiness"):
            cz.crack(n=10, patchiness=value)
    with pytest.raises(ValueError, match="patch is 0"):
        cz.crack(n=10, patchiness=1.0, patch=0)
    for n in (0, 1, 3, 200_000):
        assert cz.crack(n=n, patchiness=4.0, patch=0.5, rng=1).bounds == (0.0, 0.0, 1.0, 1.0)
