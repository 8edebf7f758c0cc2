"""A picture that was dropped on the page as points: along its contours, or denser where it is bright or dark."""

from __future__ import annotations

import io
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from crazing import arguments, sample
from crazing.edit.knobs import SEED, Knob, choice, count, number, switch
from crazing.errors import CrazingError
from crazing.images import brightness, read_image

#: The longer side that contours are traced on; larger pictures are averaged down to it by a whole factor.
_LONGEST = 2048

#: Bytes of a picture that are taken.
MOST_BYTES = 64 << 20

_WAYS = ("along contours", "by brightness")
_CONTOURS, _DENSITY = (f"way:{way}" for way in _WAYS)

#: What the page turns while a picture is traced.
KNOBS: tuple[Knob, ...] = (
    choice("way", "Points", _WAYS),
    number("level", "Level", 0.5, 0.0, 1.0, help="Brightness where the contour runs", needs=_CONTOURS),
    count("levels", "Levels", 1, 1, 10, needs=_CONTOURS),
    number("spread", "Spread", 0.5, 0.0, 1.0, help="Between the outermost levels", needs=_CONTOURS),
    switch("dark", "Denser where dark", True, needs=_DENSITY),
    number("smoothing", "Smoothing", 0.0, 0.0, 20.0, 0.25, help="Blur before, in pixels"),
    count("n", "Number of points", 400, 3, 20_000),
    replace(SEED, needs=_DENSITY),
)


@dataclass(frozen=True)
class Picture:
    """Brightness (H, W) of what was dropped, and how many pixels of the file one of these is wide."""

    grey: NDArray[np.float64]
    scale: int
    size: tuple[int, int]

    def points(
        self,
        *,
        way: str,
        level: float,
        levels: int,
        spread: float,
        dark: bool,
        smoothing: float,
        n: int,
        seed: int,
    ) -> NDArray[np.float64]:
        """Points in pixels of the file, y up: spread evenly along the contours, or drawn by brightness.

        Parameters
        ----------
        way : {"along contours", "by brightness"}
            Which.
        level : float
            Brightness of the middle contour, 0 to 1.
        levels : int
            How many contours, from `level - spread / 2` to `level + spread / 2`.
        spread : float
            How far apart the outermost are.
        dark : bool
            By brightness: denser where the picture is dark.
        smoothing : float
            Standard deviation of the blur before, in pixels traced.
        n : int
            Number of points.
        seed : int
            By brightness.

        Returns
        -------
        (n, 2) float64

        Raises
        ------
        CrazingError
            If there is no contour, or no brightness.
        """
        grey = blurred(self.grey, smoothing)
        if way == _WAYS[0]:
            half = spread / 2 if levels > 1 else 0.0
            found = sample.from_image(grey, level=np.linspace(level - half, level + half, levels).tolist(), n=n)
        else:
            found = sample.from_density(1.0 - grey if dark else grey, n, rng=seed)
        return found * float(self.scale)


def opened(content: bytes) -> Picture:
    """The picture of a PNG, JPEG, TIFF, BMP, GIF or WebP file.

    Raises
    ------
    CrazingError
        If it is none, is damaged or too large; the size is judged by the header.
    """
    if len(content) > MOST_BYTES:
        raise CrazingError(f"the picture has {len(content)} bytes; at most {MOST_BYTES} are taken")
    pixels = read_image(io.BytesIO(content))
    height, width = pixels.shape[:2]
    grey = brightness(pixels)
    factor = -(-max(height, width) // _LONGEST)
    if factor > 1:
        rows, columns = height // factor, width // factor
        if not rows or not columns:
            raise CrazingError(f"the picture has {width} x {height} pixels, too narrow for a contour")
        blocks = grey[: rows * factor, : columns * factor].reshape(rows, factor, columns, factor)
        grey = np.asarray(blocks.mean(axis=(1, 3)))
    return Picture(grey, factor, (height, width))


def blurred(grey: NDArray[np.float64], sigma: float) -> NDArray[np.float64]:
    """The picture under a Gaussian of standard deviation `sigma` pixels; its border goes on outside."""
    sigma = arguments.number(sigma, "smoothing", low=0, high=50)
    if sigma < 0.05:  # The kernel would be one pixel.
        return grey
    reach = int(3 * sigma + 1)
    weights = np.exp(-0.5 * (np.arange(-reach, reach + 1) / sigma) ** 2)
    weights /= weights.sum()
    for axis in (0, 1):
        padded = np.pad(grey, [(reach, reach) if side == axis else (0, 0) for side in (0, 1)], mode="edge")
        length = grey.shape[axis]
        shifted = [padded[i : i + length] if axis == 0 else padded[:, i : i + length] for i in range(len(weights))]
        grey = np.zeros_like(grey)
        for weight, part in zip(weights, shifted, strict=True):
            grey += weight * part
    return grey
