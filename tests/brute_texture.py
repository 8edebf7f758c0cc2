"""Maps of a crack by brute force: every edge for every pixel, in double precision, from the words of the docstrings.

Shares no code with the core.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Where = tuple[slice, slice]


@dataclass(frozen=True)
class Near:
    """The nearest disc of a tapered edge for every pixel; pixels, y up."""

    distance: Floats
    radius: Floats
    along: Floats


class Brute:
    """A crack seen from the middles of a grid of pixels, or `beside` these (pixels to the right, pixels up)."""

    def __init__(
        self, crack: Any, size: tuple[int, int], bounds: Any = None, beside: tuple[float, float] = (0.0, 0.0)
    ) -> None:
        xmin, ymin, xmax, ymax = crack.bounds if bounds is None else bounds
        height, width = size
        self.scale = min(width / (xmax - xmin), height / (ymax - ymin))
        # From the middle of the view, where numbers are smallest.
        self.x = np.arange(width) + 0.5 - width / 2 + beside[0]
        self.y = height / 2 - np.arange(height) - 0.5 + beside[1]
        period = getattr(crack, "period", None)
        self.period = None if period is None else np.asarray(period) * self.scale
        vertices = np.asarray(crack.graph.vertices, float).reshape(-1, 2) - [(xmin + xmax) / 2, (ymin + ymax) / 2]
        self.ends = vertices[np.asarray(crack.graph.edges, int).reshape(-1, 2)] * self.scale
        if self.period is not None:
            self.ends[:, 1] += np.asarray(crack.shifts) * self.period
        self.radii = np.asarray(crack.width, float).reshape(-1, 2) * self.scale / 2

    @property
    def shape(self) -> tuple[int, int]:
        return len(self.y), len(self.x)

    def images(self, row: int, reach: float) -> Iterator[tuple[Floats, Where]]:
        """The ends of an edge, on a torus of all its images, that come so near to pixels; and to which."""
        low, high = self.ends[row].min(0) - reach, self.ends[row].max(0) + reach
        axes = (self.x, self.y[::-1])
        if self.period is None:
            turns = [range(1), range(1)]
        else:
            turns = [
                range(math.ceil((at[0] - high[i]) / self.period[i]), math.floor((at[-1] - low[i]) / self.period[i]) + 1)
                for i, at in enumerate(axes)
            ]
        for i in turns[0]:
            for j in turns[1]:
                by = np.zeros(2) if self.period is None else self.period * (i, j)
                x, y = (
                    slice(*np.searchsorted(at, (low[axis] + by[axis], high[axis] + by[axis])))
                    for axis, at in enumerate(axes)
                )
                count = len(self.y)
                yield self.ends[row] + by, (slice(count - y.stop, count - y.start), x)

    def near(self, ends: Floats, radii: Floats, where: Where) -> Near:
        """The nearest of the discs along an edge."""
        (ax, ay), (bx, by) = ends
        dx, dy = np.broadcast_arrays(self.x[where[1]] - ax, self.y[where[0], None] - ay)
        length, grows = math.hypot(bx - ax, by - ay), radii[1] - radii[0]
        if length <= abs(grows):
            # The larger disc holds the other.
            along = np.full(dx.shape, float(grows > 0))
        else:
            u, v = (bx - ax) / length, (by - ay) / length
            ahead = np.abs(dx * v - dy * u) * grows / math.sqrt((length - grows) * (length + grows))
            along = np.clip((dx * u + dy * v + ahead) / length, 0.0, 1.0)
        radius = radii[0] + grows * along
        return Near(np.hypot(dx - along * (bx - ax), dy - along * (by - ay)) - radius, radius, along)

    @cached_property
    def reach(self) -> float:
        """No pixel is farther than this from the nearest edge: that is how far its ends are."""
        least = np.full(self.shape, np.inf if len(self.ends) else 0.0)
        for end in self.ends.reshape(-1, 2):
            apart = [self.x - end[0], self.y[:, None] - end[1]]
            if self.period is not None:
                apart = [by - period * np.round(by / period) for by, period in zip(apart, self.period, strict=True)]
            np.minimum(least, np.hypot(*apart), out=least)
        return float(least.max())

    @cached_property
    def nearest(self) -> tuple[Floats, Floats, Ints, Floats]:
        """Distance, radius, edge and place along it of the nearest disc; edge -1 where there is none."""
        distance, radius = np.full(self.shape, np.inf), np.ones(self.shape)
        edge, along = np.full(self.shape, -1), np.zeros(self.shape)
        for row, radii in enumerate(self.radii):
            for ends, where in self.images(row, self.reach + radii.max()):
                near = self.near(ends, radii, where)
                nearer = near.distance < distance[where]
                for whole, part in ((distance, near.distance), (radius, near.radius), (along, near.along)):
                    whole[where][nearer] = part[nearer]
                edge[where][nearer] = row
        return distance, radius, edge, along

    def candidates(self, slack: float) -> list[Ints]:
        """For every pixel (row by row) the edges that are no farther than the nearest one but for so many pixels."""
        distance, found = self.nearest[0], [set() for _ in range(self.shape[0] * self.shape[1])]
        numbers = np.arange(len(found)).reshape(self.shape)
        for row, radii in enumerate(self.radii):
            for ends, where in self.images(row, self.reach + radii.max() + slack):
                near = self.near(ends, radii, where).distance <= distance[where] + slack
                for number in numbers[where][near]:
                    found[number].add(row)
        return [np.array(sorted(rows)) for rows in found]

    def coverage(self) -> Floats:
        """The most that any edge covers of a pixel, taken as an interval along the line through a disc's middle."""
        most = np.zeros(self.shape)
        for row, radii in enumerate(self.radii):
            for ends, where in self.images(row, radii.max() + 1):
                near = self.near(ends, radii, where)
                centre = near.distance + near.radius
                low, high = np.maximum(centre - 0.5, -near.radius), np.minimum(centre + 0.5, near.radius)
                most[where] = np.maximum(most[where], np.clip(high - low, 0, 1))
        return most
