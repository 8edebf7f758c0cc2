"""PNG, band by band."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.files import png_density, png_text, sample_bytes
from crazing.pictures.about import KEY, About
from crazing.pictures.parts import Part, State


class Writer:
    """A PNG that grows. Each band is whole blocks of deflate, so that only a checksum leads from one to the next."""

    def __init__(self, path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], band: int, about: About) -> None:
        self.part = Part(path)
        self.depth = 8 * dtype.itemsize
        self.head = _core.png_head(
            (shape[0], shape[1], 1 if len(shape) == 2 else shape[2], self.depth),
            png_text({KEY: about.text}),
            about.is_color,
            png_density(about.density),
        )

    def resume(self, states: list[State]) -> int:
        """How many bands stand."""
        return self.part.whole(states)

    def begin(self, states: list[State]) -> None:
        """Go on behind these bands; none is from the start."""
        self.adler = int(states[-1]["adler"]) if states else 1
        self.part.cut(states[-1]["end"] if states else 0)
        if not states:
            self.part.write(self.head)

    def write(self, samples: NDArray[Any]) -> State:
        """Append a band of rows."""
        pixels = samples if samples.ndim == 3 else samples[..., None]
        self.adler = _core.png_rows(self.part, sample_bytes(pixels), self.depth, self.adler)  # type: ignore[arg-type]
        return {**self.part.band(), "adler": self.adler}

    def finish(self) -> None:
        """Complete the file."""
        self.part.write(_core.png_tail(self.adler))
        self.part.close(flush=True)

    def close(self) -> None:
        """Leave the file as it is."""
        self.part.close(flush=False)
