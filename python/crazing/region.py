"""Polygons with holes, from whatever describes one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.arguments import points_array
from crazing.contour import contours
from crazing.errors import CrazingError
from crazing.graph import PlanarGraph
from crazing.images import brightness
from crazing.polygons import polygons
from crazing.record import Record

#: Pixels: how far the outline of a picture may be moved to smooth the steps of its contour.
_STEPS = 0.5


@dataclass(frozen=True, eq=False, repr=False)
class Region(Record):
    """One or more rings; a point is inside when it lies in an odd number of them.

    Attributes
    ----------
    coords : (k, 2) float64
        Corners, ring after ring, the first not repeated; the inside is on the left of every side.
    offsets : (rings + 1,) int64
        Ring `i` is ``coords[offsets[i]:offsets[i + 1]]``.
    """

    coords: NDArray[np.float64]
    offsets: NDArray[np.int64]

    @property
    def outline(self) -> PlanarGraph:
        """The rings as a drawing."""
        rows = np.arange(len(self.coords), dtype=np.int32)
        following = rows + 1
        following[self.offsets[1:] - 1] = self.offsets[:-1]
        return PlanarGraph(self.coords, np.column_stack([rows, following]))

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """(xmin, ymin, xmax, ymax)."""
        low, high = self.coords.min(axis=0).tolist(), self.coords.max(axis=0).tolist()
        return low[0], low[1], high[0], high[1]

    def contains(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Whether each point is inside; of points on the outline, either may be said."""
        return _core.region_contains(self.rings, points)

    @property
    def rings(self) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """Coordinates and offsets, as the core takes them."""
        return self.coords, self.offsets

    @cached_property
    def _along(self) -> NDArray[np.float64]:
        """How far along the outline each side starts, all rings one after the other, and their whole length."""
        return np.concatenate([[0.0], np.cumsum(self.outline.lengths)])

    def _ring(self, place: float) -> tuple[int, int]:
        """The first side of the ring that a place is on, and the first of the next."""
        ring = int(np.searchsorted(self.offsets, int(place), side="right")) - 1
        return int(self.offsets[ring]), int(self.offsets[ring + 1])

    def _travelled(self, place: float) -> float:
        side = int(place)
        return float(self._along[side] + (place - side) * (self._along[side + 1] - self._along[side]))

    def span(self, arc: NDArray[np.float64]) -> float:
        """Length of the outline from one place to another: places are the number of a side and a part of it."""
        first, end = self._ring(arc[0])
        around = float(self._along[end] - self._along[first])
        return (self._travelled(arc[1]) - self._travelled(arc[0])) % around or around

    def middle(self, arc: NDArray[np.float64], width: float) -> tuple[float, float, float]:
        """The middle of an arc, `width` long at most: where it begins, has its own middle, and ends."""
        first, end = self._ring(arc[0])
        start, around = self._along[first], self._along[end] - self._along[first]
        span = self.span(arc)
        half = min(span, width) / 2
        middle = self._travelled(arc[0]) - start + span / 2

        def place(length: float) -> float:
            at = start + length % around
            side = min(max(int(np.searchsorted(self._along, at, side="right")) - 1, first), end - 1)
            part = (at - self._along[side]) / (self._along[side + 1] - self._along[side])
            return float(side + min(max(part, 0.0), 1 - 2.0**-40))

        return place(middle - half), place(middle), place(middle + half)

    def at(self, place: float) -> NDArray[np.float64]:
        """The point at a place of the outline."""
        first, end = self._ring(place)
        side = int(place)
        a, b = self.coords[side], self.coords[side + 1 if side + 1 < end else first]
        return np.asarray(a + (place - side) * (b - a))

    def along(self, start: float, end: float) -> NDArray[np.float64]:
        """(k, 2), the outline from one place to another."""
        sides = list(self._sides(start, end))
        return np.array([self.at(side + low) for side, low, _ in sides] + [self.at(end)])

    def opened(self, gaps: list[tuple[float, float]]) -> PlanarGraph:
        """The outline with gaps, each from one place to another."""
        left: dict[int, list[tuple[float, float]]] = {}
        for start, end in gaps:
            for side, low, high in self._sides(start, end):
                parts = (
                    (a, b) for p, q in left.get(side, [(0.0, 1.0)]) for a, b in ((p, min(q, low)), (max(p, high), q))
                )
                left[side] = [(a, b) for a, b in parts if a < b]
        outline = self.outline
        shut = np.ones(len(outline.edges), dtype=bool)
        shut[list(left)] = False
        vertices: list[NDArray[np.float64]] = []
        edges: list[list[int]] = []
        for side, part in ((side, part) for side, kept in left.items() for part in kept):
            ends = outline.edges[side].tolist()
            for i, at in enumerate(part):
                if 0.0 < at < 1.0:
                    ends[i] = len(outline.vertices) + len(vertices)
                    vertices.append(self.at(side + at))
            edges.append(ends)
        added = np.array(edges, dtype=np.int32).reshape(-1, 2)
        return PlanarGraph(np.vstack([outline.vertices, *vertices]), np.concatenate([outline.edges[shut], added]))

    def _sides(self, start: float, end: float) -> Iterator[tuple[int, float, float]]:
        """The sides from one place to another, each with its part between them."""
        first, last = self._ring(start)
        side, low = int(start), start - int(start)
        for _ in range(first, last + 1):
            if side == int(end) and low <= end - side:
                yield side, low, end - side
                return
            yield side, low, 1.0
            side, low = side + 1 if side + 1 < last else first, 0.0

    def __repr__(self) -> str:
        return f"Region({len(self.offsets) - 1} rings, {len(self.coords)} corners)"


def as_region(shape: Any, name: str = "within") -> Region:
    """The region that `shape` describes.

    What :func:`crazing.polygons.polygons` reads; any other array is a picture: True is inside a mask of bools,
    and 1 if there are but 0 and 1, in others what differs from its border.

    Examples
    --------
    >>> from crazing.region import as_region
    >>> as_region([(0, 0), (4, 0), (4, 4), (0, 4)])
    Region(1 rings, 4 corners)
    """
    if isinstance(shape, Region):
        return shape
    is_array = isinstance(shape, np.ndarray) and shape.dtype.kind != "O"
    if is_array and (shape.dtype.kind == "b" or shape.ndim == 3 or shape.shape[1:] != (2,)):
        return _traced(shape, name)
    return _joined([ring for polygon in polygons(shape, name) for ring in polygon], name)


def _joined(rings: list[Any], name: str) -> Region:
    kept = []
    for row, ring in enumerate(rings):
        points = points_array(ring, f"{name}[{row}]")
        closed = len(points) > 1 and bool((points[0] == points[-1]).all())
        points = points[:-1] if closed else points
        if len(points) < 3:
            raise ValueError(f"{name}[{row}] has {len(points)} corners; at least 3 are wanted")
        if not np.isfinite(points).all():
            corner = int(np.argmin(np.isfinite(points).all(axis=1)))
            place = tuple(points[corner].tolist())
            raise CrazingError(f"{name}[{row}][{corner}] is {place}; finite numbers are wanted")
        kept.append(points)
    if not kept:
        raise ValueError(f"{name} has no ring; one or more are wanted")
    region = Region(*_core.region_rings((np.concatenate(kept), np.cumsum([0, *map(len, kept)]))))
    if not len(region.coords):
        raise CrazingError(f"{name} has nothing inside: its rings lie on one another")
    return region


def _traced(picture: NDArray[Any], name: str) -> Region:
    """The rings between the inside of a picture and its border, in pixels, y up."""
    if picture.ndim == 2 and picture.size and picture.dtype.kind in "iu" and picture.min() >= 0 and picture.max() <= 1:
        picture = picture.astype(bool)
    grey = brightness(picture, name)
    if picture.dtype.kind != "b":
        rim = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
        grey = 1.0 - grey if np.median(rim) > 0.5 else grey
    if grey.max() <= 0.5:
        raise CrazingError(f"{name} has nothing inside: nothing differs from its border by more than a half")
    found = contours(np.pad(grey, 1))
    rings = [line - 1.0 for line in found.lines if len(line) > 2]
    plain = [line for line in (_plain(line, _STEPS) for line in rings) if len(line) > 2]
    try:
        # A mask of single pixels has no others.
        return _joined(plain or rings, name)
    except CrazingError:
        # Where the shape is as thin as the steps, leaving corners out may make its sides cross.
        return _joined(rings, name)


def _plain(line: NDArray[np.float64], most: float) -> NDArray[np.float64]:
    """A ring with fewer corners, none of those left out farther than `most` from it (Douglas, Peucker 1973)."""
    far = int(np.linalg.norm(line - line[0], axis=1).argmax())
    closed = np.vstack([line, line[:1]])
    kept = np.zeros(len(closed), dtype=bool)
    kept[[0, far, -1]] = True
    runs = [(0, far), (far, len(line))]
    while runs:
        start, end = runs.pop()
        if end - start < 2:
            continue
        along = closed[end] - closed[start]
        away = closed[start + 1 : end] - closed[start]
        off = np.abs(away[:, 0] * along[1] - away[:, 1] * along[0]) / max(float(np.hypot(*along)), 1e-300)
        worst = int(off.argmax())
        if off[worst] > most:
            kept[start + 1 + worst] = True
            runs += [(start, start + 1 + worst), (start + 1 + worst, end)]
    return np.asarray(closed[kept][:-1])
