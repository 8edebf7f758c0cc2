"""From `rng` to the key of the core's counter-based generator."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

RNG: TypeAlias = "int | np.random.Generator | np.random.SeedSequence | np.random.BitGenerator | None"


def key(rng: RNG = None) -> tuple[int, int]:
    """Two 64-bit words drawn from `rng`, the key of everything random in one call.

    An int gives the same key on every platform and with every NumPy (raw streams of its bit generators never
    change, NEP 19); a Generator is advanced by two raw draws, so that its next use gives another key.
    """
    try:
        generator = np.random.default_rng(rng)
    except (TypeError, ValueError) as error:
        raise type(error)(f"rng is {rng!r}; an int >= 0, a numpy.random.Generator or None is wanted") from None
    low, high = (int(word) & (2**64 - 1) for word in generator.bit_generator.random_raw(2))
    return low, high
