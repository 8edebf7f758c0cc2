"""Aligned maps of crack patterns."""

from __future__ import annotations

import numpy as np
import pytest

import crazing as cz
from crazing.texture import MAPS


def same(one, other):
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


@pytest.fixture(scope="module")
def net():
    return cz.crack(n=60, opening=0.5, rng=5)


@pytest.fixture(scope="module")
def whole(net):
    return cz.texture(net, (120, 150), maps="all")


def test_maps_have_their_types_and_are_frozen(whole):
    for name, (dtype, channels) in MAPS.items():
        assert whole[name].dtype == dtype
        assert whole[name].shape == ((120, 150) if channels == 1 else (120, 150, channels))
        assert not whole[name].flags.writeable


@pytest.mark.parametrize("window", [(0, 0, 120, 150), (31, 57, 64, 65), (119, 149, 1, 1), (3, 0, 17, 150)])
def test_windows_equal_the_whole(net, whole, window):
    top, left, height, width = window
    part = cz.texture_plan(net, (120, 150), maps="all").window(*window)
    same(part, {name: whole[name][top : top + height, left : left + width] for name in whole})


def test_threads_do_not_matter(net):
    one, many = (cz.texture(net, 300, maps="all", threads=threads) for threads in (1, 3))
    same(one, many)
