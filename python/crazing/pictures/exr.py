"""OpenEXR, whole: its library takes a picture at once."""

from __future__ import annotations

import errno
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.extras import require
from crazing.pictures.about import KEY, About
from crazing.pictures.parts import State

#: Most pixels of a picture, since it stands in memory.
PIXELS = 1 << 28

#: What a disk may refuse; the library tells it in words alone.
_REFUSALS = (errno.ENOSPC, errno.EFBIG, errno.EDQUOT, errno.EACCES)


class Writer:
    """Rows that are collected; there is nothing to go on with after a killed run."""

    def __init__(self, path: Path, shape: tuple[int, ...], dtype: np.dtype[Any], band: int, about: About) -> None:
        self.library = require("OpenEXR", "texture")
        if shape[0] * shape[1] > PIXELS:
            raise ValueError(f"an EXR stands in memory and has at most {PIXELS} pixels; choose tiff or zarr")
        self.path, self.about = path, about
        self.pixels = np.empty(shape, dtype=dtype)

    def resume(self, states: list[State]) -> int:
        """None."""
        return 0

    def begin(self, states: list[State]) -> None:
        """From the first row."""
        self.row = 0

    def write(self, samples: NDArray[Any]) -> State:
        """Append a band of rows."""
        self.pixels[self.row : self.row + len(samples)] = samples
        self.row += len(samples)
        return {}

    def finish(self) -> None:
        """Write the file."""
        library: Any = self.library
        header = {
            "compression": library.ZIP_COMPRESSION,
            "type": library.scanlineimage,
            "software": self.about.software,
            # Pixels an inch, as the format's own attribute has it.
            "xDensity": float(self.about.density[0] * 0.0254),
            KEY: self.about.text,
        }
        channel = "Y" if self.pixels.ndim == 2 else "RGB"
        try:
            with library.File(header, {channel: self.pixels}) as file:
                file.write(str(self.path))
        except RuntimeError as error:
            raise _told(error, self.path) from None
        del self.pixels

    def close(self) -> None:
        """Forget the rows."""
        self.pixels = np.empty(0)


def _told(error: RuntimeError, path: Path) -> OSError:
    """The error of the disk that the library tells of."""
    number = next((number for number in _REFUSALS if os.strerror(number) in str(error)), errno.EIO)
    return OSError(number, os.strerror(number), str(path))
