"""What is taken for a mask: every kind of zeros and ones, and no white that its dtype does not know."""

from __future__ import annotations

import numpy as np
import pytest

from crazing.measure import as_mask, measure


@pytest.mark.parametrize("shape", [(40, 60), (40, 60, 3)])
@pytest.mark.parametrize("dtype", [bool, np.uint8, np.uint16, np.int64, float])
def test_zeros_and_ones_of_any_kind_are_a_mask(shape: tuple[int, ...], dtype: type) -> None:
    crack = np.zeros(shape, bool)
    crack[20:22, 5:] = True
    np.testing.assert_array_equal(as_mask(crack.astype(dtype)), crack.reshape(40, 60, -1)[..., 0])


def test_white_of_eight_bits_in_a_wide_dtype_is_named() -> None:
    crack = np.zeros((40, 60), bool)
    crack[20:22, 5:] = True
    for numbers in (np.where(crack, 255, 0), np.where(crack, 65_535, 0).astype(np.int32), crack * 255 - 1):
        with pytest.raises(ValueError, match=r"numbers from (0|-1) to \d+ of int\d\d, whose white is"):
            measure(numbers)
    wide = np.where(crack, 2**31 - 1, 0).astype(np.int32)
    np.testing.assert_array_equal(as_mask(wide), crack)
