"""What every result is: a frozen dataclass of read-only arrays that compares, pickles and prints counts."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import Any

import numpy as np


def same(a: Any, b: Any) -> bool:
    """Whether two field values hold the same content."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        both = isinstance(a, np.ndarray) and isinstance(b, np.ndarray)
        return both and np.array_equal(a, b, equal_nan=a.dtype.kind == "f")
    if isinstance(a, tuple) and isinstance(b, tuple):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return list(a) == list(b) and all(same(a[name], b[name]) for name in a)
    # Two numbers that are none are the same content.
    return bool(a == b) or (isinstance(a, float) and isinstance(b, float) and a != a and b != b)


def equal(one: Any, other: Any) -> bool:
    """Whether two results hold the same content."""
    if type(one) is not type(other):
        return NotImplemented  # type: ignore[no-any-return]
    compared = [field.name for field in fields(one) if field.compare]
    return all(same(getattr(one, name), getattr(other, name)) for name in compared)


@dataclass(frozen=True, eq=False, repr=False)
class Record:
    """Base of the results; subclasses are frozen dataclasses too."""

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if isinstance(value, np.ndarray) and value.flags.writeable:
                # A view is frozen, never the array a caller may still hold.
                frozen = value.view()
                frozen.flags.writeable = False
                object.__setattr__(self, field.name, frozen)

    def __eq__(self, other: object) -> bool:
        return equal(self, other)

    # Content decides equality, and arrays have no cheap content hash.
    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        # Through the constructor, so that unpickled arrays are read-only again.
        return type(self), tuple(getattr(self, field.name) for field in fields(self))
