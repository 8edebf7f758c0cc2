"""Tiled TIFF, band by band: the tiles first, the table of where they lie behind them."""

from __future__ import annotations

import struct
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.pictures.about import About
from crazing.pictures.parts import Part, State

#: Pixels across of a tile.
TILE = 256

#: Files whose samples take more bytes become BigTIFF; the older format ends at 4 GiB.
CLASSIC = 1 << 31

# Types of a tag: a string, 16 and 32 bits, a fraction, 64 bits.
_ASCII, _SHORT, _LONG, _RATIONAL, _LONG8 = 2, 3, 4, 5, 16
_CODES = {_ASCII: "B", _SHORT: "H", _LONG: "I", _RATIONAL: "I", _LONG8: "Q"}

Tag = tuple[int, int, list[int]]


class Writer:
    """A TIFF that grows. Tiles are as high as a band, so that a band is whole tiles."""

    def __init__(self, path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], band: int, about: About) -> None:
        self.part = Part(path)
        self.shape, self.dtype, self.band, self.about = shape, dtype, band, about
        self.big = int(np.prod(shape)) * dtype.itemsize > CLASSIC
        self.sizes: list[int] = []

    def resume(self, states: list[State]) -> int:
        """How many bands stand."""
        return self.part.whole(states)

    def begin(self, states: list[State]) -> None:
        """Go on behind these bands; none is from the start."""
        self.sizes = [size for state in states for size in state["sizes"]]
        self.part.cut(states[-1]["end"] if states else 0)
        if not states:
            # The head tells where the table lies; it is written over when that is known.
            self.part.write(bytes(self._first()))

    def write(self, samples: NDArray[Any]) -> State:
        """Append a band of rows as one row of tiles."""
        small = np.ascontiguousarray(samples, dtype=self.dtype.newbyteorder("<"))
        rows = small.reshape(*samples.shape[:2], -1).view(np.uint8)
        kind = self.dtype.itemsize, self.dtype.kind == "f"
        sizes = _core.tiff_tiles(self.part, rows, *kind, (self.band, TILE))  # type: ignore[arg-type]
        self.sizes += sizes
        return {**self.part.band(), "sizes": sizes}

    def finish(self) -> None:
        """Complete the file."""
        place = self.part.file.tell()
        if place % 2:
            self.part.write(b"\0")
            place += 1
        self.part.write(_table(place, self._tags(), self.big))
        self.part.file.seek(0)
        self.part.file.write(
            struct.pack("<2sHHHQ", b"II", 43, 8, 0, place) if self.big else struct.pack("<2sHI", b"II", 42, place)
        )
        self.part.close(flush=True)

    def close(self) -> None:
        """Leave the file as it is."""
        self.part.close(flush=False)

    def _first(self) -> int:
        """Where the first tile lies."""
        return 16 if self.big else 8

    def _tags(self) -> list[Tag]:
        height, width = self.shape[:2]
        channels = 1 if len(self.shape) == 2 else self.shape[2]
        places = np.cumsum([self._first(), *self.sizes[:-1]]).tolist()
        across, up = (_rational(pixels / 100) for pixels in self.about.density)
        word = _LONG8 if self.big else _LONG
        return [
            (256, _LONG, [width]),
            (257, _LONG, [height]),
            (258, _SHORT, [8 * self.dtype.itemsize] * channels),
            (259, _SHORT, [8]),
            (262, _SHORT, [2 if channels == 3 else 1]),
            (270, _ASCII, _ascii(self.about.text)),
            (277, _SHORT, [channels]),
            (282, _RATIONAL, across),
            (283, _RATIONAL, up),
            (296, _SHORT, [3]),
            (305, _ASCII, _ascii(self.about.software)),
            (317, _SHORT, [3 if self.dtype.kind == "f" else 2]),
            (322, _LONG, [TILE]),
            (323, _LONG, [self.band]),
            (324, word, places),
            (325, _LONG, self.sizes),
            (339, _SHORT, [{"u": 1, "i": 2, "f": 3}[self.dtype.kind]] * channels),
        ]


def _ascii(text: str) -> list[int]:
    return [*text.encode("ascii", "replace"), 0]


def _rational(value: float) -> list[int]:
    """Two whole numbers of 32 bits whose quotient is near `value`; 0 for one that is beyond them."""
    if not 1e-9 < value < 4e9:
        return [0, 1]
    near = Fraction(value).limit_denominator(min(1_000_000, int(4e9 / max(value, 1.0))))
    return [near.numerator, near.denominator]


def _table(place: int, tags: list[Tag], big: bool) -> bytes:
    """The directory of a TIFF at byte `place`, with the values that do not fit into it behind it."""
    count, entry, room = ("<Q", "<HHQ", 8) if big else ("<H", "<HHI", 4)
    size = struct.calcsize(count) + len(tags) * (struct.calcsize(entry) + room) + room
    rows, values = b"", b""
    for code, kind, numbers in tags:
        data = struct.pack(f"<{len(numbers)}{_CODES[kind]}", *numbers)
        rows += struct.pack(entry, code, kind, len(numbers) // (2 if kind == _RATIONAL else 1))
        if len(data) > room:
            rows += struct.pack("<Q" if big else "<I", place + size + len(values))
            values += data + b"\0" * (len(data) % 2)
        else:
            rows += data.ljust(room, b"\0")
    return struct.pack(count, len(tags)) + rows + bytes(room) + values
