"""Polygons with holes, from whatever describes one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.arguments import points_array
from crazing.contour import contours
from crazing.graph import PlanarGraph
from crazing.images import brightness
from crazing.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Region(Record):
    """One or more rings; a point is inside when it lies in an odd number of them.

    Attributes
    ----------
    coords : (k, 2) float64
        Corners, ring after ring, the first not repeated.
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
        return _core.region_contains(self.coords, self.offsets, points)

    def opened(self, cells: list[tuple[NDArray[np.float64], NDArray[np.float64]]]) -> PlanarGraph:
        """The outline with a gap at each Voronoi cell, given as its site and those of its neighbours.

        Where a cell meets the outline more than once, the gap is at its longest stretch.
        """
        outline = self.outline
        gaps = [_stretch(outline, site, others) for site, others in cells]
        vertices, edges = [outline.vertices], [outline.edges]
        start = len(outline.vertices)
        shut = np.ones(len(outline.edges), dtype=bool)
        for rows, low, high in gaps:
            rows, low, high = rows[shut[rows]], low[shut[rows]], high[shut[rows]]
            shut[rows] = False
            a, b = np.moveaxis(outline.segments[rows], 1, 0)
            for ends, at, kept in ((outline.edges[rows, 0], low, low > 0), (outline.edges[rows, 1], high, high < 1)):
                cut = (a + at[:, None] * (b - a))[kept]
                vertices.append(cut)
                edges.append(np.column_stack([ends[kept], start + np.arange(len(cut))]).astype(np.int32))
                start += len(cut)
        edges[0] = edges[0][shut]
        return PlanarGraph(np.concatenate(vertices), np.concatenate(edges))

    def __repr__(self) -> str:
        return f"Region({len(self.offsets) - 1} rings, {len(self.coords)} corners)"


def as_region(shape: Any, name: str = "within") -> Region:
    """The region that `shape` describes.

    A (k, 2) array is a ring, a list of them rings; an object with `__geo_interface__` or a GeoJSON mapping is a Polygon
    or MultiPolygon; any other array a picture: True is inside a mask of bools, in others what differs from its border.

    Examples
    --------
    >>> from crazing.region import as_region
    >>> as_region([(0, 0), (4, 0), (4, 4), (0, 4)])
    Region(1 rings, 4 corners)
    """
    if isinstance(shape, Region):
        return shape
    shape = getattr(shape, "__geo_interface__", shape)
    if isinstance(shape, Mapping):
        return _joined(_geojson_rings(shape, name), name)
    if isinstance(shape, np.ndarray) and (shape.dtype.kind == "b" or shape.ndim == 3 or shape.shape[1:] != (2,)):
        return _traced(shape, name)
    # A list of rings has rows of rows of numbers.
    if np.ndim(shape[0] if len(shape) else 0) == 2:
        return _joined(list(shape), name)
    return _joined([shape], name)


def _geojson_rings(shape: Mapping[str, Any], name: str) -> list[Any]:
    if shape.get("type") == "Feature":
        return _geojson_rings(shape["geometry"], name)
    if shape.get("type") == "Polygon":
        return list(shape["coordinates"])
    if shape.get("type") == "MultiPolygon":
        return [ring for polygon in shape["coordinates"] for ring in polygon]
    raise ValueError(f"{name} is a geometry of type {shape.get('type')!r}; Polygon or MultiPolygon is wanted")


def _joined(rings: list[Any], name: str) -> Region:
    kept = []
    for row, ring in enumerate(rings):
        points = points_array(ring, f"{name}[{row}]")
        closed = len(points) > 1 and bool((points[0] == points[-1]).all())
        points = points[:-1] if closed else points
        if len(points) < 3:
            raise ValueError(f"{name}[{row}] has {len(points)} corners; at least 3 are wanted")
        kept.append(points)
    if not kept:
        raise ValueError(f"{name} has no ring; one or more are wanted")
    return Region(np.concatenate(kept), np.cumsum([0, *map(len, kept)]))


def _traced(picture: NDArray[Any], name: str) -> Region:
    """The rings between the inside of a picture and its border, in pixels, y up."""
    grey = brightness(picture, name)
    if picture.dtype.kind != "b":
        rim = np.concatenate([grey[0], grey[-1], grey[:, 0], grey[:, -1]])
        grey = 1.0 - grey if np.median(rim) > 0.5 else grey
    found = contours(np.pad(grey, 1))
    rings = [line - 1.0 for line in found.lines if len(line) > 2]
    return _joined(rings, name)


def _stretch(
    outline: PlanarGraph, site: NDArray[np.float64], others: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64], NDArray[np.float64]]:
    """The longest run of sides in a cell: their rows, and from which part to which part they are in it."""
    a, b = np.moveaxis(outline.segments, 1, 0)
    low, high = np.zeros(len(a)), np.ones(len(a))
    for other in others:
        # Points nearer to the site: those with a positive product. Along a side it is linear.
        normal, middle = site - other, (site + other) / 2
        at_a, at_b = (a - middle) @ normal, (b - middle) @ normal
        with np.errstate(divide="ignore", invalid="ignore"):
            zero = at_a / (at_a - at_b)
        low = np.where(at_a >= 0, low, np.where(at_b > 0, np.fmax(low, zero), 2.0))
        high = np.where(at_b >= 0, high, np.where(at_a > 0, np.fmin(high, zero), -1.0))
    rows = np.flatnonzero(low < high)
    runs = np.split(rows, np.flatnonzero(np.diff(rows) > 1) + 1)
    lengths = (high - low) * outline.lengths
    rows = max(runs, key=lambda run: float(lengths[run].sum()))
    return rows, low[rows], high[rows]
