"""Which plate a pixel is on, where cracks float inside plates or run round the torus."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import crazing as cz


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
@pytest.mark.parametrize("name", ["asphalt-crack", "bark", "concrete-spall", "glaze", "painting-dutch"])
def test_plates_change_at_cracks_only(name, period):
    side = 256
    for seed in range(3):
        crack = cz.preset(name).crack(rng=seed, **({} if period is None else {"period": period}))
        # Of one width: a wide crack is nearer than a narrow one in front of it.
        crack = dataclasses.replace(crack, width=np.full(crack.width.shape, 1e-3))
        maps = cz.texture(crack, side, maps=["cell", "distance"])
        # No crack passes between two neighbours that are both farther from it than half of what is between them.
        cell, free = maps["cell"], maps["distance"] > 0.6 / side
        for axis in (0, 1):
            both = free & np.roll(free, -1, axis)
            if period is None:
                np.moveaxis(both, axis, 0)[-1] = False
            np.testing.assert_array_equal(cell[both], np.roll(cell, -1, axis)[both])
