"""Centrelines of polygons."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.arguments import number, points_array
from crazing.diagram import Diagram, diagram
from crazing.errors import CrazingError, DegenerateInputError
from crazing.graph import PlanarGraph

#: Least part of its ring that an edge of the centreline spans.
RESIDUAL = 0.025
#: Points on the boundary by default: at least so many, and at most.
FEWEST, MOST = 400, 250_000
#: Parts of the mean width that default points are apart.
PARTS = 4
#: Rounds of halving boundary edges that the triangulation lacks; each halves the gap that can be told apart.
ROUNDS = 24

Ring = NDArray[np.float64]


def centerline(polygon: Any, *, spacing: float | None = None) -> PlanarGraph:
    """The inner medial axis of a polygon with holes, without hairs.

    Parameters
    ----------
    polygon : shapely geometry, mapping, (shell, holes) or (n, 2) array_like
        A polygon or several: anything with a ``__geo_interface__`` or a GeoJSON mapping of type Polygon,
        MultiPolygon or Feature; or a shell, an (n, 2) array_like, and a list of such holes; or a shell alone. Rings
        may repeat their first point and run either way.
    spacing : float, optional
        Largest distance between two points of the boundary, in data units; the corners are always among them. By
        default a quarter of the mean width (twice the area over the perimeter), but from 400 to 250,000 points.

    Returns
    -------
    PlanarGraph
        One path round every hole and one arm into every corner and lobe that spans 2.5 % of its ring or more.

    Raises
    ------
    DegenerateInputError
        If a ring has no area.
    CrazingError
        If a coordinate is NaN or infinite, or the boundary crosses or touches itself.
    TypeError, ValueError
        If `polygon` is nothing of the above, or `spacing` is not positive or asks for too many points.

    Notes
    -----
    The duals of the Delaunay edges inside, with the boundary itself as the crust: boundary edges that the
    triangulation lacks are halved until it has them. Source: Gold, Snoeyink 2001 (the axis); Ogniewicz, Kübler 1995
    (its arc residual).

    Examples
    --------
    >>> import crazing as cz
    >>> line = cz.centerline([(0, 0), (8, 0), (8, 2), (0, 2)])
    >>> line.components, line.leaves
    (1, 4)
    """
    rings = [_opened(ring) for ring in _rings(polygon)]
    if not rings:
        raise DegenerateInputError("polygon is empty; a ring of at least 3 points is wanted")
    apart = _default_spacing(rings) if spacing is None else number(spacing, "spacing", low=0.0)
    total = sum(_lengths(ring).sum() for ring in rings)
    if not total <= apart * 40 * MOST:
        raise ValueError(f"spacing is {apart}; at least {total / (40 * MOST)} is wanted for a boundary of {total}")
    found, boundary = _conforming([_densified(ring, apart) for ring in rings])
    if (PlanarGraph(found.sites, found.edges[boundary]).degrees != 2).any():
        raise CrazingError("the boundary of the polygon touches or crosses itself; a valid polygon is wanted")
    inside, _, residual = _core.sides(found.arrays, boundary)
    # A neck before a hole spans little of its ring, and is no hair.
    edges = _core.axis_edges(found.arrays, _core.peeled(found.arrays, inside, residual, RESIDUAL))
    return PlanarGraph(found.vertices, edges).compact()


def _rings(polygon: Any) -> Iterator[Ring]:
    """Every ring, shells and holes alike: what is inside follows from the number of rings around it."""
    kind = getattr(polygon, "geom_type", None)
    if isinstance(kind, str) and kind in ("Polygon", "MultiPolygon"):
        yield from _rings_of_shapely(polygon)
        return
    shape = getattr(polygon, "__geo_interface__", polygon)
    if isinstance(shape, Mapping):
        yield from _rings_of_mapping(shape)
    elif isinstance(shape, Sequence) and len(shape) == 2 and not isinstance(shape, str):
        yield points_array(shape[0], "shell")
        for i, hole in enumerate(shape[1]):
            yield points_array(hole, f"holes[{i}]")
    else:
        yield points_array(shape, "polygon")


def _rings_of_shapely(shape: Any) -> Iterator[Ring]:
    """As of its mapping, without a Python object for every coordinate."""
    for part in getattr(shape, "geoms", [shape]):
        if not part.is_empty:
            yield from (np.array(ring.coords)[:, :2] for ring in (part.exterior, *part.interiors))


def _rings_of_mapping(shape: Mapping[str, Any]) -> Iterator[Ring]:
    kind = shape.get("type")
    if kind == "Feature":
        yield from _rings(shape["geometry"])
    elif kind in ("Polygon", "MultiPolygon"):
        coordinates = shape["coordinates"]
        for rings in [coordinates] if kind == "Polygon" else coordinates:
            # A third coordinate is a height.
            yield from (points_array([point[:2] for point in ring], "coordinates") for ring in rings)
    else:
        raise TypeError(f"polygon is a geometry of type {kind!r}; Polygon or MultiPolygon is wanted")


def _opened(ring: Ring) -> Ring:
    """The ring without repeated points."""
    if not np.isfinite(ring).all():
        raise CrazingError("a ring of the polygon holds nan or infinity; every coordinate must be finite")
    x, y = ring.T
    ring = ring[(x != np.roll(x, 1)) | (y != np.roll(y, 1))]
    if len(ring) < 3:
        raise DegenerateInputError(f"a ring of the polygon has {len(ring)} distinct points; at least 3 are wanted")
    if _area(ring) == 0:
        raise DegenerateInputError("a ring of the polygon has no area")
    return ring


def _lengths(ring: Ring) -> NDArray[np.float64]:
    return np.asarray(np.hypot(*(np.roll(ring, -1, axis=0) - ring).T))


def _default_spacing(rings: list[Ring]) -> float:
    """Fine enough for the mean width, in a bearable number of points."""
    length = float(sum(_lengths(ring).sum() for ring in rings))
    areas = [abs(float(_area(ring))) for ring in rings]
    area = 2 * max(areas) - sum(areas)
    width = 2 * max(area, 0.0) / length
    return min(max(width / PARTS, length / MOST), length / FEWEST)


def _area(ring: Ring) -> float:
    x, y = (ring - ring[0]).T
    return float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2)


def _densified(ring: Ring, apart: float) -> Ring:
    """The ring with every side cut into equal parts no longer than `apart`."""
    parts = np.maximum(np.ceil(_lengths(ring) / apart), 1).astype(np.int64)
    if (parts == 1).all():
        return ring
    side = np.repeat(np.arange(len(ring)), parts)
    share = (np.arange(len(side)) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[side]
    return np.asarray(ring[side] + share[:, None] * (np.roll(ring, -1, axis=0) - ring)[side])


def _conforming(rings: list[Ring]) -> tuple[Diagram, NDArray[np.bool_]]:
    """A diagram that has every side of the rings, halved as often as it takes, and which of its edges these are."""
    for _ in range(ROUNDS):
        found = diagram(np.concatenate(rings))
        starts = np.cumsum([0, *map(len, rings)])
        ends = np.concatenate([np.roll(np.arange(a, b), -1) for a, b in pairwise(starts)])
        boundary = _between(found, ends)
        if np.count_nonzero(boundary) == len(ends):
            return found, boundary
        sides = _keys(np.column_stack([found.site_of, found.site_of[ends]]))
        missing = ~np.isin(sides, _keys(found.edges))
        if not missing.any():
            return found, boundary
        pieces = np.split(missing, starts[1:-1])
        rings = [_halved(ring, part) for ring, part in zip(rings, pieces, strict=True)]
    raise CrazingError("the boundary of the polygon crosses itself or comes too near to itself; a valid one is wanted")


def _between(found: Diagram, ends: NDArray[np.int64]) -> NDArray[np.bool_]:
    """Which edges join a row to the one that `ends` names for it."""
    if len(found.sites) < len(ends):
        # Rings that touch: a site has several ends.
        wanted = _keys(np.column_stack([found.site_of, found.site_of[ends]]))
        return np.isin(_keys(found.edges), wanted)
    # Without duplicates a site is its row: many times faster than looking pairs up.
    low, high = found.edges.T
    return np.asarray((ends[low] == high) | (ends[high] == low))


def _halved(ring: Ring, sides: NDArray[np.bool_]) -> Ring:
    middle = ring + 0.5 * (np.roll(ring, -1, axis=0) - ring)
    return np.insert(ring, np.flatnonzero(sides) + 1, middle[sides], axis=0)


def _keys(ends: NDArray[np.int32]) -> NDArray[np.int64]:
    """One number an edge, the same in both directions."""
    sorted_ends = np.sort(ends, axis=1).astype(np.int64)
    return np.asarray(sorted_ends[:, 0] << 32 | sorted_ends[:, 1])
