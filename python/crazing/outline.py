"""Lines to be sampled, from polygons and SVG paths."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import svg
from crazing.contour import Contours
from crazing.errors import CrazingError
from crazing.extras import require
from crazing.svg_path import subpaths

#: Parts of a curved segment: the chord is then off by less than a thousandth of the segment, but at loops.
PARTS = 32
#: Of the largest coordinate of a path: far above the rounding of a sum of ten thousand steps, far below any drawing.
_ROUNDING = 2.0**-40


def spread(lines: Contours, n: int | None, spacing: float | None) -> NDArray[np.float64]:
    """The points of the lines, or points evenly along them."""
    if n is not None and spacing is not None:
        raise ValueError(f"n is {n!r} and spacing is {spacing!r}; only one of them is wanted")
    return lines.coords.copy() if n is None and spacing is None else lines.evenly(n, spacing=spacing)


def rings(lines: list[NDArray[np.float64]], closed: list[bool] | None = None) -> Contours:
    """Lines without repeated points, closed if nothing else is said."""
    kept, shut = [], []
    for row, line in enumerate(lines):
        if not np.isfinite(line).all():
            raise CrazingError(f"line {row} of the outline holds nan or infinity; every coordinate must be finite")
        is_closed = closed is None or closed[row]
        fresh = np.ones(len(line), dtype=bool)
        fresh[1:] = (line[1:] != line[:-1]).any(axis=1)
        line = line[fresh]
        if is_closed and len(line) > 1 and (line[0] == line[-1]).all():
            line = line[:-1]
        if len(line) > 1:
            kept.append(line)
            shut.append(is_closed)
    if not kept:
        raise ValueError("the outline is empty; a line of two distinct points or more is wanted")
    return Contours(np.concatenate(kept), np.cumsum([0, *map(len, kept)]), np.array(shut))


def svg_lines(source: str | os.PathLike[str] | bytes) -> Contours:
    """The sub-paths of path data, of an SVG file or of what one holds, y up."""
    require("svgpathtools", "svg")
    try:
        # Files are called map.svg, too; data has no such end.
        if isinstance(source, str) and source.lstrip()[:1] in ("M", "m") and not source.lower().endswith(".svg"):
            drawn = [(*part, np.eye(3)) for part in subpaths(source)]
        else:
            # Opened here, so that a missing file is said to be missing.
            drawn = list(svg.shapes(source if isinstance(source, bytes) else Path(source).read_bytes()))
        lines = [_flattened(*part) for part in drawn]
    except OSError:
        raise
    except Exception as error:
        # The parsers raise whatever they stumble over.
        raise ValueError(f"source cannot be read as SVG: {error}") from None
    # With Z or without, a line that ends where it began is closed.
    shut = [bool((line[0] == line[-1]).all()) for line in lines]
    return rings(lines, shut)


def _flattened(segments: list[Any], closed: bool, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points along a sub-path, moved by a matrix, y up. What is moved are points: parts of a curve stay parts of it."""
    points = [segments[0].start]
    for segment in segments:
        straight = type(segment).__name__ == "Line"
        inner = () if straight else (segment.point(i / PARTS) for i in range(1, PARTS))
        points += [*inner, segment.end]
    # Steps from point to point add up to the start but for rounding; a side as short as that would cross others.
    if len(points) > 2 and abs(points[-1] - points[0]) <= _ROUNDING * max(map(abs, points)):
        points[-1] = points[0]
    elif closed:
        points.append(points[0])
    places = np.array(points, dtype=np.complex128)
    # What is not finite is named later.
    with np.errstate(over="ignore", invalid="ignore"):
        x, y = matrix[:2, :2] @ [places.real, places.imag] + matrix[:2, 2:]
    return np.column_stack([x, -y + 0.0])
