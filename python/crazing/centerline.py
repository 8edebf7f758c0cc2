"""Centrelines of polygons."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.arguments import number
from crazing.conforming import (
    QUICK,
    ROUNDS,
    Floats,
    Mask,
    conforming,
    is_touched,
    side_lengths,
    with_feet,
    within,
)
from crazing.diagram import Diagram
from crazing.errors import CrazingError, DegenerateInputError
from crazing.graph import PlanarGraph
from crazing.polygons import Ring, polygons

#: By what a limit is passed surely: the arms into the corners of an end that is just so wide are alike, whatever the
#: last bit, and a dead end that is just so long stays.
SLIGHT = 1e-9
#: Points on the boundary by default: at least so many, and at most.
FEWEST, MOST = 400, 250_000
#: Points round a hole of several polygons, at least.
ROUND = 12
#: Parts of the mean width that default points are apart.
PARTS = 4
#: Rounds of points opposite to others in straits that are narrower than points are apart.
STRAITS = 8
#: Coordinates below two to this power, and above its inverse, are taken as they are.
PLAIN = 256


def centerline(
    polygon: Any, *, spacing: float | None = None, residual: float = 0.025, elongation: float | None = None
) -> PlanarGraph:
    """The inner medial axis of a polygon with holes, without hairs.

    Parameters
    ----------
    polygon : shapely geometry, mapping, (shell, holes), rings or (n, 2) array_like
        A polygon or several: anything with a ``__geo_interface__`` (of shapely, of GeoPandas) or a GeoJSON mapping of
        type Polygon, MultiPolygon, Feature or a collection of them, or a file of it; a list of such; a shell, an (n, 2)
        array_like, and a list of such holes; a shell alone; or a list of rings, of which those in an odd number of
        others are holes. Rings may repeat their first point, run either way and touch in points; heights are left out.
        Coordinates are taken as numbers in a plane, whatever reference system a table of GeoPandas names: project
        degrees before.
    spacing : float, optional
        Largest distance between two points of the boundary, in data units; the corners are always among them. By
        default a quarter of the mean width (twice the area over the perimeter), but from 400 to 250,000 points; of
        several polygons, small ones have their own.
    residual : float, default 0.025
        Part of its ring, at least 0 and below 0.5, that a corner or lobe has to span for an arm; 0 keeps all hairs.
    elongation : float, optional
        Dead ends at least so many times as long as they are wide have an arm, too, whatever they span: the streets of
        a town, the small tributaries of a river. They are those whose outline is at least 2 `elongation` + 1 times as
        long as a chord across them: of an alley with a square end, the length from its mouth over the width. A round
        end counts .21 widths less, a point half a width less; a corner of 90 degrees has .21, one of 60 degrees .5,
        one of 30 degrees 1.4. For networks take 1, or 2 if their outline runs along pixels, and a `residual` of 0.2:
        then the corners of small blocks and islands have no arms.

    Returns
    -------
    PlanarGraph
        One path round every hole and one arm into every corner, lobe and dead end that spans enough. An arm goes on as
        long as one way leads on: to the middle of a round end, into a corner of less than about 130 degrees, past
        niches; where an end has two corners, it stops where the ways into these part. Of a circle, whose axis is a
        point, nothing.

    Raises
    ------
    DegenerateInputError
        If a ring has no area.
    CrazingError
        If a coordinate is NaN or infinite, or the boundary crosses or overlaps itself (``shapely.make_valid`` mends
        such polygons).
    TypeError, ValueError
        If `polygon` is nothing of the above, `spacing` is not positive or asks for too many points, or `residual` or
        `elongation` is out of range.

    Notes
    -----
    The duals of the Delaunay edges inside, with the boundary itself as the crust: boundary edges that the
    triangulation lacks are halved until it has them. Parts that share a whole side are one polygon. Source:
    Gold, Snoeyink 2001 (the axis); Ogniewicz, Kübler 1995 (its arc residual).

    Examples
    --------
    >>> import crazing as cz
    >>> line = cz.centerline([(0, 0), (8, 0), (8, 2), (0, 2)])
    >>> line.components, line.leaves
    (1, 4)
    >>> corridor = cz.centerline([(0, 0), (100, 0), (100, 1), (0, 1)])
    >>> corridor.leaves, round(corridor.length)
    (2, 99)
    """
    limits = _Limits.of(residual, elongation)
    parts = [
        [_opened(ring, f"ring {j} of polygon {i}") for j, ring in enumerate(part)]
        for i, part in enumerate(polygons(polygon, "polygon"))
    ]
    if not parts:
        raise DegenerateInputError("polygon is empty; a ring of at least 3 points is wanted")
    rings, exponent = _scaled([ring for part in parts for ring in part])
    areas = [abs(_area(ring)) for ring in rings]
    area = 2 * areas[0] - sum(areas)
    if len(parts) > 1 or area <= 0:
        # Neighbours that share a side become one polygon, and of several only plain rings tell what is a hole.
        rings = _plain(rings)
        area = sum(map(_area, rings))
    if not area:
        raise DegenerateInputError("the polygon has no area")
    length = float(sum(side_lengths(ring).sum() for ring in rings))
    apart = _default_spacing(length, area) if spacing is None else _checked(spacing, length, exponent)
    several = spacing is None and len(parts) > 1
    found, edges = _axis(rings, lambda lines: _spacings(lines, apart) if several else [apart] * len(lines), limits)
    vertices = np.ldexp(found.vertices, exponent) if exponent else found.vertices
    return PlanarGraph._of_core(vertices, edges).compact()


@dataclass(frozen=True)
class _Limits:
    """What a part of the axis has to span: a part of its ring, or so many times the width of its mouth."""

    residual: float
    elongation: float | None

    @classmethod
    def of(cls, residual: float, elongation: float | None) -> _Limits:
        part = number(residual, "residual", low=0.0)
        if part >= 0.5:
            raise ValueError(f"residual is {part}; a part of a ring below 0.5 is wanted")
        return cls(part, None if elongation is None else number(elongation, "elongation", low=0.0))

    def kept(self, found: Diagram, inside: Mask, residual: Floats, arc: Floats) -> Mask:
        """The axis inside without what spans less, grown at its tips."""
        if self.elongation is not None:
            # Two sides and the end of an alley.
            outline = (2 * self.elongation + 1) * found.delaunay.lengths
            residual = np.where(arc >= (1 - SLIGHT) * outline, np.inf, residual)
        return _core.reaching(found.arrays, inside, residual, arc, self.residual * (1 + SLIGHT))


def _axis(
    rings: list[Ring], apart: Callable[[list[Ring]], list[float]], limits: _Limits
) -> tuple[Diagram, NDArray[np.int32]]:
    """The diagram of points along the rings, and the pairs of its vertices that are the axis."""
    made = conforming([*map(_densified, rings, apart(rings))], QUICK)
    is_quick = made is not None and not is_touched(*made[:2])
    if not is_quick:
        # Rare, and half as dear as all the rest: sides that cross are named, rings that touch come apart.
        rings = _plain(rings)
        made = conforming([*map(_densified, rings, apart(rings))], ROUNDS)
    if made is None:
        raise CrazingError("the boundary of the polygon comes too near to itself; touches in single points are fine")
    for rounds in range(STRAITS + 1):
        found, boundary, rings = made
        spans = _core.spans(found.arrays, boundary) if is_quick else within(found, boundary, rings)
        # A neck before a hole spans little of its ring, and is no hair.
        kept = limits.kept(found, *spans)
        finer = with_feet(found, boundary, rings, kept) if rounds < STRAITS else None
        made = None if finer is None else conforming(finer, ROUNDS)
        if made is None:
            break
        is_quick = is_quick and not is_touched(*made[:2])
    return found, _core.axis_edges(found.arrays, kept)


def _plain(rings: list[Ring]) -> list[Ring]:
    """The rings without doubled sides, cut where they touch, the inside on the left of every side."""
    try:
        coords, offsets = _core.region_rings((np.concatenate(rings), np.cumsum([0, *map(len, rings)])))
    except CrazingError as error:
        raise CrazingError(f"the boundary of the polygon is not plain: {error}") from None
    if not len(coords):
        raise DegenerateInputError("the polygon has no area")
    return np.split(coords, offsets[1:-1])


def _scaled(rings: list[Ring]) -> tuple[list[Ring], int]:
    """The rings over a power of two, where products of coordinates neither overflow nor vanish; and its exponent."""
    exponent = int(np.frexp(max(map(_largest, rings)))[1])
    if abs(exponent) < PLAIN:
        return rings, 0
    return [np.ldexp(ring, -exponent) for ring in rings], exponent


def _largest(ring: Ring) -> float:
    return max(float(ring.max()), -float(ring.min()))


def _opened(given: Ring, name: str) -> Ring:
    """The ring without repeated points."""
    ring = given
    if len(ring) and not np.isfinite(_largest(ring)):
        row = int(np.argmin(np.isfinite(ring).all(axis=1)))
        raise CrazingError(f"{name} has {tuple(ring[row].tolist())} in row {row}; every coordinate must be finite")
    while len(ring) > 1 and (ring[0] == ring[-1]).all():
        # By a slice: a ring of many points is not copied.
        ring = ring[1:]
    differs = ring[1:] != ring[:-1]
    is_new = np.logical_or(differs[:, 0], differs[:, 1])
    if not is_new.all():
        ring = ring[np.append(True, is_new)]
    if len(ring) < 3:
        distinct = len(np.unique(given, axis=0))
        plural = "s" * (distinct != 1)
        raise DegenerateInputError(f"{name} has {distinct} distinct point{plural}; at least 3 are wanted")
    # Nearly always the first few points tell.
    if _is_straight(ring[:FEWEST]) and _is_straight(ring):
        raise DegenerateInputError(f"{name} has no area")
    return ring


def _is_straight(points: Ring) -> bool:
    """Whether all lie on one line, as far as products of floats tell."""
    (scaled,), _ = _scaled([points])
    away = scaled - scaled[0]
    along = away[np.abs(away).argmax() // 2]
    return not bool((away[:, 0] * along[1] != away[:, 1] * along[0]).any())


def _checked(spacing: float, length: float, exponent: int) -> float:
    """The spacing at the scale of the rings, if it asks for a bearable number of points."""
    asked = number(spacing, "spacing", low=0.0)
    apart = float(np.ldexp(asked, -exponent))
    least = length / (40 * MOST)
    if not apart >= least:
        least, length = (float(np.ldexp(value, exponent)) for value in (least, length))
        raise ValueError(f"spacing is {asked}; at least {least} is wanted for a boundary of {length}")
    return apart


def _default_spacing(length: float, area: float) -> float:
    """Fine enough for the mean width, in a bearable number of points."""
    return min(max(2 * area / length / PARTS, length / MOST), length / FEWEST)


def _spacings(rings: list[Ring], apart: float) -> list[float]:
    """For every plain ring of several polygons: small ones, and small holes, have points of their own."""
    lengths, areas = [float(side_lengths(ring).sum()) for ring in rings], [*map(_area, rings)]
    fewest = min(FEWEST, max(MOST // len(rings), ROUND))
    each = zip(lengths, areas, strict=True)
    return [
        min(apart, length / fewest, max(2 * area / length / PARTS, length / MOST))
        if area > 0
        else min(apart, length / ROUND)
        for length, area in each
    ]


def _area(ring: Ring) -> float:
    x, y = np.ascontiguousarray((ring - ring[0]).T)
    across = np.empty(len(ring))
    across[:-1] = x[:-1] * y[1:] - y[:-1] * x[1:]
    across[-1] = x[-1] * y[0] - y[-1] * x[0]
    return float(across.sum() / 2)


def _densified(ring: Ring, apart: float) -> Ring:
    """The ring with every side cut into equal parts no longer than `apart`."""
    lengths = side_lengths(ring)
    if lengths.max() <= apart:
        return ring
    parts = np.maximum(np.ceil(lengths / apart), 1).astype(np.int64)
    step = np.roll(ring, -1, axis=0) - ring
    side = np.repeat(np.arange(len(ring)), parts)
    share = (np.arange(len(side)) - np.repeat(np.cumsum(parts) - parts, parts)) / parts[side]
    return np.asarray(ring[side] + share[:, None] * step[side])
