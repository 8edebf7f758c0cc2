"""Level lines of an image, sub-pixel, and points spread evenly along them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import arguments
from crazing.errors import CrazingError
from crazing.extras import require
from crazing.images import brightness
from crazing.record import Record
from crazing.spread import FEWEST, MOST, counts_at, shares, travelled, walk

# Far above the rounding of coordinates up to 2**16 pixels, 1e-11, and far below what pixels can tell.
_ROUNDING = 1e-9


@dataclass(frozen=True, eq=False, repr=False)
class Contours(Record):
    """Lines one after the other in one table.

    Attributes
    ----------
    coords : (k, 2) float64
        Points in the frame of pixels: x right, y up, the centre of pixel (row, col) at (col + 0.5, H - row - 0.5).
        Neighbours are distinct; a closed line does not repeat its first point.
    offsets : (lines + 1,) int64
        Line j is `coords[offsets[j]:offsets[j + 1]]`; it has two points or more.
    closed : (lines,) bool
        Whether the last point of line j is joined to its first. A line is open where it leaves the image.
    """

    coords: NDArray[np.float64]
    offsets: NDArray[np.int64]
    closed: NDArray[np.bool_]

    def __repr__(self) -> str:
        return f"Contours({len(self)} lines, {len(self.coords)} points)"

    def __len__(self) -> int:
        return len(self.closed)

    @property
    def lines(self) -> list[NDArray[np.float64]]:
        """One (k, 2) array a line."""
        return np.split(self.coords, self.offsets[1:-1]) if len(self) else []

    @property
    def length(self) -> NDArray[np.float64]:
        """(lines,) length of every line in pixels, the joining edge of closed lines with it."""
        along = travelled(self)
        return along[self.offsets[1:]] - along[self.offsets[:-1]]

    def evenly(self, n: int | None = None, *, spacing: float | None = None) -> NDArray[np.float64]:
        """Points at even distances along the lines, line after line.

        Either `n` points in all, shared in proportion to length (largest remainders first), or on every line the
        number that brings its step nearest to `spacing` pixels. A closed line starts at its first point, an open one
        has points at both ends. A line is given 3 points or more, or none: of the longest lines as many are kept as
        have a fair share of 3 among themselves; with `spacing`, a line too short for 3 points is left out.

        Parameters
        ----------
        n : int, optional
            Number of points in all, 3 or more.
        spacing : float, optional
            From a point to the next, in the frame of `coords`; such that there are 100 million points or fewer.

        Returns
        -------
        (n, 2) float64
            In the frame of `coords`.

        Raises
        ------
        CrazingError
            If every line is too short for `spacing`.
        ValueError
            If both or neither of `n` and `spacing` are given, or `n` is less than 3.
        """
        if (n is None) == (spacing is None):
            raise ValueError("exactly one of n and spacing is wanted")
        if spacing is None:
            return walk(self, shares(self.length, arguments.count(n, "n", low=FEWEST, high=MOST)))
        step = arguments.number(spacing, "spacing", low=0.0)
        if not step:
            raise ValueError("spacing is 0; a positive number is wanted")
        return walk(self, counts_at(self, step))


def contours(image: ArrayLike, level: float | Sequence[float] = 0.5) -> Contours:
    """The lines where the brightness of an image, linear between the centres of pixels, is `level`.

    Parameters
    ----------
    image : array_like
        See `crazing.sample.from_image`; 2 x 2 pixels or more.
    level : float or sequence of float
        One brightness or several; the lines of the first come first.

    Returns
    -------
    Contours
        Line after line, in the frame of pixels; at least one.

    Raises
    ------
    TypeError, ValueError
        If the image or a level is not what is listed above.
    CrazingError
        If there is no line, or a pixel is not finite.
    ImportError
        If contourpy, of the extra `image`, is not installed.

    Notes
    -----
    Source: thesis, section 6 (contours of a leaf at one height and at several).

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.contour import contours
    >>> image = np.zeros((3, 3))
    >>> image[1, 1] = 1
    >>> found = contours(image)
    >>> found
    Contours(1 lines, 4 points)
    >>> found.lines[0][np.lexsort(found.lines[0].T)]
    array([[1.5, 1. ],
           [1. , 1.5],
           [2. , 1.5],
           [1.5, 2. ]])
    """
    grey = brightness(image)
    levels = np.atleast_1d(arguments.real_array(level, "level"))
    if levels.ndim != 1 or not levels.size or not np.isfinite(levels).all():
        raise ValueError(f"level is {level!r}; a finite number or a sequence of them is wanted")
    if min(grey.shape) < 2:
        raise ValueError(f"image has {grey.shape[0]} x {grey.shape[1]} pixels; 2 x 2 or more are wanted")
    traced = _trace(grey, levels)
    if not len(traced):
        raise CrazingError(_nothing_found(np.asarray(image), grey, levels))
    return traced


def _nothing_found(image: NDArray[Any], grey: NDArray[np.float64], levels: NDArray[np.float64]) -> str:
    wanted = ", ".join(f"{level:g}" for level in levels[:5]) + (", ..." if len(levels) > 5 else "")
    text = f"no contour at level {wanted}: the values of the image run from {grey.min():g} to {grey.max():g}"
    if image.dtype.kind in "iu":
        text += f" ({image.dtype} divided by {np.iinfo(image.dtype).max})"
        if image.max() == 1:
            text += "; a mask of 0 and 1 is wanted as bool: image > 0"
    return text


def _trace(grey: NDArray[np.float64], levels: NDArray[np.float64]) -> Contours:
    contourpy = require("contourpy", "image")
    height, width = grey.shape
    generator = contourpy.contour_generator(
        x=np.arange(width) + 0.5,
        y=height - 0.5 - np.arange(height),
        z=grey,
        name="serial",
        line_type=contourpy.LineType.ChunkCombinedOffset,
    )
    traced = [generator.lines(float(level)) for level in levels]
    coords = [points[0] for points, _ in traced if points[0] is not None]
    sizes = [np.diff(offsets[0].astype(np.int64)) for _, offsets in traced if offsets[0] is not None]
    every = np.concatenate([np.empty((0, 2)), *coords])
    return _tidy(_on_grid(every), np.concatenate([np.empty(0, np.int64), *sizes]))


def _on_grid(coords: NDArray[np.float64]) -> NDArray[np.float64]:
    """The coordinates, those within rounding of a line of pixel centres put on it.

    Every vertex lies on such a line; interpolation leaves it by a unit in the last place, at the border out of the
    image.
    """
    nearest = np.rint(coords - 0.5) + 0.5
    return np.where(np.abs(coords - nearest) < _ROUNDING, nearest, coords)


def _tidy(coords: NDArray[np.float64], sizes: NDArray[np.int64]) -> Contours:
    """Lines without repeated points, and without those that were nothing but one point.

    A line through a pixel that is exactly at the level meets the same point on several grid edges.
    """
    last = np.cumsum(sizes) - 1
    first = last - sizes + 1
    closed = (coords[first] == coords[last]).all(axis=1)
    keep = np.ones(len(coords), dtype=bool)
    keep[1:] = (coords[1:] != coords[:-1]).any(axis=1)
    keep[first] = True
    kept = np.concatenate([[0], np.cumsum(keep)])
    distinct = kept[last + 1] - kept[first]
    # Of a closed line, the point that repeats the first is the last one kept.
    ends = np.flatnonzero(keep)[kept[last[closed] + 1] - 1]
    keep[ends] = False
    distinct[closed] -= 1
    whole = distinct >= 2
    keep &= np.repeat(whole, sizes)
    offsets = np.concatenate([[0], np.cumsum(distinct[whole])])
    return Contours(coords[keep], offsets, closed[whole])
