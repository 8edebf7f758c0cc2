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


@pytest.mark.parametrize(("sideways", "swapped"), [(0, False), (1, False), (1, True)])
def test_strips_round_the_torus_are_two_plates(sideways, swapped):
    """Two cracks round the torus, upright or slanting, and a piece that floats between them."""
    vertices, shifts = [], []
    for x in (0.2, 0.7):
        half = x + 0.5 * sideways
        vertices += [(x, 0.1), (half % 1, 0.6)]
        shifts += [(int(half), 0), (sideways - int(half), 1)]
    vertices += [(0.4 + 0.2 * sideways, 0.3), (0.5 + 0.2 * sideways, 0.3)]
    places, turns = np.array(vertices), np.array([*shifts, (0, 0)], dtype=np.int8)
    if swapped:
        places, turns = places[:, ::-1].copy(), turns[:, ::-1].copy()
    graph = cz.PlanarGraph(places, [(0, 1), (1, 0), (2, 3), (3, 2), (4, 5)])
    rows = np.zeros(5, dtype=np.int32)
    crack = cz.Crack(graph, np.full((5, 2), 1e-3), rows, rows, (0.0, 0.0, 1.0, 1.0), (1.0, 1.0), turns)
    cell = cz.texture(crack, 128, maps=["cell"])["cell"]
    assert np.bincount(cell.ravel()).tolist() == [8192, 8192]
