"""Zarr 3, in shards a band high."""

from __future__ import annotations

import shutil
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.extras import require
from crazing.pictures.about import KEY, About
from crazing.pictures.parts import State

#: Pixels across of a chunk, and chunks across of a shard, which is one file. A chunk costs the library as much time as
#: packing a quarter of a megabyte.
CHUNK, SHARD = 1024, 4


class Writer:
    """An array that fills up. What is there is held to its checksum when a run goes on."""

    def __init__(self, path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], band: int, about: About) -> None:
        self.library = require("zarr", "texture")
        self.path, self.shape, self.dtype, self.band, self.about = path, shape, dtype, band, about
        self.row = 0

    def resume(self, states: list[State]) -> int:
        """How many bands stand."""
        library: Any = self.library
        whole = 0
        try:
            library.open_array(store=str(self.path), mode="r")
        except Exception:  # A damaged store raises whatever its parsing runs into: then it is written anew.
            return whole
        while whole < len(states) and self._sum(whole) == states[whole]["sum"]:
            whole += 1
        return whole

    def begin(self, states: list[State]) -> None:
        """Go on behind these bands; none is from the start."""
        library: Any = self.library
        self.row = int(states[-1]["row"]) if states else 0
        if states:
            self.array = library.open_array(store=str(self.path), mode="r+")
            return
        if self.path.exists():
            shutil.rmtree(self.path)
        rest = self.shape[2:]
        across = min(SHARD, -(-self.shape[1] // CHUNK))
        self.array = library.create_array(
            store=str(self.path),
            shape=self.shape,
            dtype=self.dtype,
            chunks=(self.band, CHUNK, *rest),
            shards=(self.band, across * CHUNK, *rest),
            # Smaller than the library's own choice, and twice as fast: bytes of like weight lie together.
            compressors=library.codecs.BloscCodec(
                cname="lz4", clevel=1, shuffle="shuffle", typesize=self.dtype.itemsize
            ),
            dimension_names=("y", "x", "channel")[: len(self.shape)],
            # Else every chunk is looked at for whether it is empty, which takes as long as packing it.
            config={"write_empty_chunks": True},
            attributes={KEY: dict(self.about.record), "density": list(self.about.density)},
        )

    def write(self, samples: NDArray[Any]) -> State:
        """Fill the next rows."""
        samples = np.ascontiguousarray(samples)
        self.array[self.row : self.row + len(samples)] = samples
        band = self.row // self.band
        self.row += len(samples)
        return {"row": self.row, "sum": self._sum(band)}

    def _sum(self, band: int) -> int:
        """The checksum of the files of a band: they are far smaller than what is in them."""
        total = 0
        for path in sorted((self.path / "c" / str(band)).rglob("*")):
            if path.is_file():
                total = zlib.crc32(path.read_bytes(), zlib.crc32(path.name.encode(), total))
        return total

    def finish(self) -> None:
        """Nothing is left to do."""

    def close(self) -> None:
        """Nothing is left to do."""
