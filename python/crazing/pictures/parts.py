"""A file that grows at its end, band by band, and can be taken up where its last whole band ends."""

from __future__ import annotations

import contextlib
import os
import zlib
from pathlib import Path
from typing import Any, BinaryIO

State = dict[str, Any]


class Part:
    """Bytes that are written, and their checksum since the last band."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.file: BinaryIO = path.open("r+b" if path.exists() else "w+b")
        self._sum = 0

    def write(self, data: bytes | memoryview) -> int:
        """Append bytes."""
        self._sum = zlib.crc32(data, self._sum)
        return self.file.write(data)

    def band(self) -> State:
        """Where the file ends now, and the checksum of the bytes since the last call."""
        self.file.flush()
        state = {"end": self.file.tell(), "sum": self._sum}
        self._sum = 0
        return state

    def whole(self, states: list[State]) -> int:
        """How many bands are there as they were written; the file is cut behind them."""
        self.file.seek(0)
        start, whole = 0, 0
        for state in states:
            if _sum(self.file, state["end"] - start) != state["sum"]:
                break
            start, whole = state["end"], whole + 1
        return whole

    def cut(self, end: int) -> None:
        """Go on behind byte `end`."""
        self.file.truncate(end)
        self.file.seek(end)
        self._sum = 0

    def close(self, *, flush: bool) -> None:
        """Close the file; with `flush` when it lies on the disk."""
        if flush:
            self.file.flush()
            os.fsync(self.file.fileno())
        # What a full disk has refused before, it refuses here again.
        with contextlib.nullcontext() if flush else contextlib.suppress(OSError):
            self.file.close()


def _sum(file: BinaryIO, count: int) -> int | None:
    """The checksum of the next bytes; None where there are fewer."""
    total = 0
    while count > 0:
        data = file.read(min(count, 1 << 20))
        if not data:
            return None
        total = zlib.crc32(data, total)
        count -= len(data)
    return total
