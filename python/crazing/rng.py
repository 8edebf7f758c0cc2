"""From `rng` to the key of the core's counter-based generator."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from crazing.arguments import found

RNG: TypeAlias = "int | np.integer[Any] | np.random.Generator | np.random.SeedSequence | np.random.BitGenerator | None"


def key(rng: RNG = None) -> tuple[int, int]:
    """Two 64-bit words drawn from `rng`, the key of everything random in one call.

    An int gives the same key on every platform and with every NumPy (raw streams of its bit generators never
    change, NEP 19); a Generator is advanced by two raw draws, so that its next use gives another key.
    """
    low, high = (int(word) & (2**64 - 1) for word in generator(rng).bit_generator.random_raw(2))
    return low, high


def generator(rng: RNG = None) -> np.random.Generator:
    """The generator of `rng`, itself if it is one."""
    try:
        return np.random.default_rng(_flat(rng))
    except (TypeError, ValueError) as error:
        wanted = "an int >= 0, a numpy.random.Generator or None is wanted"
        raise type(error)(f"rng is {found(rng)}; {wanted}") from None


def varied(rng: RNG, variant: int) -> np.random.Generator:
    """The generator of `rng`; for every variant but 0 another one, keyed by it as well."""
    seed = generator(rng)
    return seed if variant == 0 else np.random.default_rng([*key(seed), variant])


def _flat(rng: Any) -> Any:
    """`rng`, but for bools and for lists in lists, which NumPy follows until the stack is at its end."""
    if isinstance(rng, (bool, np.bool_)):
        raise TypeError
    if isinstance(rng, (list, tuple)) and not all(isinstance(word, (int, np.integer)) for word in rng):
        raise TypeError
    return rng
