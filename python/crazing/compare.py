"""Two skeleton methods on the same samples: what they share and what only one has."""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.arguments import choice, real_array
from crazing.diagram import Diagram, as_diagram
from crazing.graph import PlanarGraph
from crazing.record import Record
from crazing.skeleton import METHODS, Skeleton, medial_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Parts of the diagonal of the samples' bounding box by which distances are looked at.
STEPS = 1000

Row: TypeAlias = "tuple[str, int | float, int | float]"


@dataclass(frozen=True, eq=False, repr=False)
class Comparison(Record):
    """Two skeletons of one diagram; printed, it is a table.

    Attributes
    ----------
    first, second : Skeleton
        The skeletons, on the same diagram.
    seconds : tuple of two floats
        How long each took, the diagram not counted. Not part of equality.
    known : PlanarGraph or None
        The true inner axis, if one was given.

    Examples
    --------
    >>> import crazing as cz
    >>> corners = [(x, y) for x in range(8) for y in range(4) if x in (0, 7) or y in (0, 3)]
    >>> comparison = cz.compare(corners)
    >>> comparison.first.method, comparison.second.method
    ('one-step', 'edge-filter')
    """

    first: Skeleton
    second: Skeleton
    seconds: tuple[float, float] = field(default=(float("nan"), float("nan")), compare=False)
    known: PlanarGraph | None = None

    @property
    def hausdorff(self) -> float:
        """The largest distance from a point of either axis to the other one, in the bounding box of the samples.

        Edges with an end outside the box are left out. Points of an edge are taken a thousandth of the diagonal apart.
        Infinite if only one axis has an edge there.

        Examples
        --------
        >>> import crazing as cz
        >>> cz.compare(cz.sample.uniform(100, rng=7), "one-step", "one-step").hausdorff
        0.0
        """
        return max(self._ways)

    @cached_property
    def _ways(self) -> tuple[float, float]:
        """How far the first axis goes from the second, and the second from the first."""
        first, second = self._in_box(self.first.axis), self._in_box(self.second.axis)
        alone = self._in_box(self.only_first), self._in_box(self.only_second)
        return self._farthest(alone[0], second), self._farthest(alone[1], first)

    @property
    def shared(self) -> PlanarGraph:
        """Axis edges that both have, on the diagram's vertices, in the order of the first axis.

        Examples
        --------
        >>> import crazing as cz
        >>> comparison = cz.compare(cz.sample.uniform(100, rng=7))
        >>> len(comparison.shared.edges) == len(comparison.second.axis.edges)
        True
        """
        return self._select(self.first.axis, self._both[0])

    @property
    def only_first(self) -> PlanarGraph:
        """Axis edges that only the first has, on the diagram's vertices, in the order of its axis.

        Examples
        --------
        >>> import crazing as cz
        >>> comparison = cz.compare(cz.sample.uniform(100, rng=7), "one-step", "one-step")
        >>> len(comparison.only_first.edges)
        0
        """
        return self._select(self.first.axis, ~self._both[0])

    @property
    def only_second(self) -> PlanarGraph:
        """Axis edges that only the second has, on the diagram's vertices, in the order of its axis.

        Examples
        --------
        >>> import crazing as cz
        >>> comparison = cz.compare(cz.sample.uniform(100, rng=7), "one-step", "edge-filter")
        >>> len(comparison.only_second.edges)
        0
        """
        return self._select(self.second.axis, ~self._both[1])

    @property
    def table(self) -> list[Row]:
        """Rows of (what, of the first, of the second): counts, lengths in data units, seconds.

        Lengths are of the edges with both ends in the bounding box of the samples; outside it an axis has vertices as
        far away as three samples are near a line.

        Examples
        --------
        >>> import crazing as cz
        >>> cz.compare(cz.sample.uniform(100, rng=7)).table[0][0]
        'crust edges'
        """
        skeletons = (self.first, self.second)
        crusts, axes = ([getattr(s, part) for s in skeletons] for part in ("crust", "axis"))
        shared = [int(np.count_nonzero(kept)) for kept in self._both]
        alone = [len(kept) - count for kept, count in zip(self._both, shared, strict=True)]
        return [
            ("crust edges", *_pair(len(crust.edges) for crust in crusts)),
            ("axis edges", *_pair(len(axis.edges) for axis in axes)),
            ("axis length in box", *_pair(self._length(axis) for axis in axes)),
            ("axis components", *_pair(axis.components for axis in axes)),
            ("axis leaves", *_pair(axis.leaves for axis in axes)),
            ("axis branches", *_pair(len(axis.polylines()[1]) - 1 for axis in axes)),
            ("axis edges shared", *_pair(shared)),
            ("axis edges only here", *_pair(alone)),
            ("farthest from the other", *self._ways),
            *self._against_known(),
            ("seconds", *self.seconds),
        ]

    def plot(self, axes: Sequence[Axes] | NDArray[np.object_] | None = None) -> NDArray[np.object_]:
        """Draws the first skeleton, the second, and both over one another, with Matplotlib.

        Every panel shows the bounding box of the samples grown by 5 %; Voronoi vertices can be far outside.
        The colours are of Okabe and Ito's set, which the colour-blind can tell apart.

        Parameters
        ----------
        axes : sequence of three matplotlib.axes.Axes, optional
            Where to draw; a new row of panels of pyplot if not given.

        Returns
        -------
        (3,) ndarray of matplotlib.axes.Axes
            What was drawn on; showing it is left to the caller.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.
        ValueError
            If not three axes are given.

        Examples
        --------
        >>> import crazing as cz
        >>> from matplotlib.figure import Figure
        >>> panels = cz.compare(cz.sample.uniform(100, rng=7)).plot(Figure().subplots(1, 3))
        >>> [panel.get_title() for panel in panels]
        ['one-step', 'edge-filter', 'both']
        """
        from crazing import panels

        return panels.draw(self, axes)

    def __str__(self) -> str:
        rows = [("", self.first.method, self.second.method)]
        rows += [(name, _text(a), _text(b)) for name, a, b in self.table]
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        return "\n".join(f"{name:{widths[0]}}  {a:>{widths[1]}}  {b:>{widths[2]}}" for name, a, b in rows)

    __repr__ = __str__

    @cached_property
    def _both(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """For every axis edge of the first and of the second, whether the other has it too."""
        # Every method names the same one of coincident vertices, so rows can be compared.
        vertices = len(self.first.diagram.vertices)
        first, second = (_keys(skeleton.axis.edges, vertices) for skeleton in (self.first, self.second))
        return np.isin(first, second), np.isin(second, first)

    def _against_known(self) -> list[Row]:
        """How far the part of each axis that is on the side of the known one goes from it, and it from them."""
        if self.known is None:
            return []
        known = self.known
        axes = [self._in_box(skeleton.inner) for skeleton in (self.first, self.second)]
        return [
            ("inner axis from known", *_pair(self._farthest(axis, known) for axis in axes)),
            ("known from inner axis", *_pair(self._farthest(known, axis) for axis in axes)),
        ]

    def _length(self, axis: PlanarGraph) -> float:
        return self._in_box(axis).length

    def _in_box(self, axis: PlanarGraph) -> PlanarGraph:
        """The edges with both ends in the bounding box of the samples."""
        sites = self.first.diagram.sites
        inside = ((axis.vertices >= sites.min(axis=0)) & (axis.vertices <= sites.max(axis=0))).all(axis=1)
        return PlanarGraph(axis.vertices, axis.edges[inside[axis.edges].all(axis=1)])

    def _farthest(self, axis: PlanarGraph, other: PlanarGraph) -> float:
        """The largest distance from a point of `axis` to the other."""
        sites = self.first.diagram.sites
        with np.errstate(over="ignore"):
            fine = float(np.hypot(*(sites.max(axis=0) - sites.min(axis=0)))) / STEPS
        return float(other.distances(_points_along(axis, fine)).max(initial=0.0))

    def _select(self, axis: PlanarGraph, kept: NDArray[np.bool_]) -> PlanarGraph:
        return PlanarGraph(self.first.diagram.vertices, axis.edges[kept])


def compare(
    points: ArrayLike | Diagram,
    first: str = "one-step",
    second: str = "edge-filter",
    *,
    axis: PlanarGraph | ArrayLike | None = None,
) -> Comparison:
    """Compares two skeleton methods on the same samples, which are triangulated once.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of curves in data units, or their diagram.
    first, second : str
        Methods of `medial_axis`: "initial", "poles", "edge-filter" or "one-step".
    axis : PlanarGraph or (e, 2, 2) array_like, optional
        The true axis inside the curve, if it is known: a drawing, or the ends of its segments. The table then tells
        how far the inner axes are from it, and it from them.

    Returns
    -------
    Comparison
        Both skeletons, the axis edges they share and do not share, the time each took; `print` shows a table.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct points, or all lie on one line.
    CrazingError
        If a coordinate is not finite.
    ValueError
        If a method is unknown, or `axis` has not the shape of segments.

    Notes
    -----
    Source: chapter 5 of the thesis, which sets edge filtering against the one-step algorithm of C. Gold and
    J. Snoeyink, A one-step crust and skeleton extraction algorithm, Algorithmica 30, 2001.

    Examples
    --------
    >>> import crazing as cz
    >>> print(cz.compare([(x, y) for x in range(8) for y in range(4) if x in (0, 7) or y in (0, 3)]))
                           one-step  edge-filter
    crust edges            ...
    seconds                ...
    """
    choice(first, "first", METHODS)
    choice(second, "second", METHODS)
    diagram = as_diagram(points)
    results, seconds = [], []
    for method in (first, second):
        start = time.perf_counter()
        results.append(medial_axis(diagram, method=method))
        seconds.append(time.perf_counter() - start)
    return Comparison(results[0], results[1], (seconds[0], seconds[1]), None if axis is None else _drawing(axis))


def _drawing(axis: PlanarGraph | ArrayLike) -> PlanarGraph:
    if isinstance(axis, PlanarGraph):
        if not np.isfinite(axis.segments).all():
            raise ValueError("axis has a vertex that is not finite")
        return axis
    segments = real_array(axis, "axis")
    if segments.ndim != 3 or segments.shape[1:] != (2, 2):
        raise ValueError(f"axis has shape {segments.shape}; (e, 2, 2) is wanted")
    if not np.isfinite(segments).all():
        raise ValueError("axis has an end that is not finite")
    return PlanarGraph(segments.reshape(-1, 2), np.arange(2 * len(segments), dtype=np.int32).reshape(-1, 2))


def _points_along(graph: PlanarGraph, fine: float) -> NDArray[np.float64]:
    """Both ends of every edge, and points between that are no farther apart than `fine`."""
    parts = (
        np.maximum(np.ceil(graph.lengths / fine), 1).astype(np.int64) + 1 if fine > 0 else np.full(len(graph.edges), 2)
    )
    edge = np.repeat(np.arange(len(parts)), parts)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts)) / (parts[edge] - 1)
    ends = graph.segments[edge]
    return np.asarray(ends[:, 0] + share[:, None] * (ends[:, 1] - ends[:, 0]))


def _pair(values: Iterable[int | float]) -> tuple[int | float, int | float]:
    first, second = values
    return first, second


def _text(value: int | float) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def _keys(edges: NDArray[np.int32], vertices: int) -> NDArray[np.int64]:
    """One number an edge, the same in both directions."""
    ends = np.sort(edges, axis=1).astype(np.int64)
    return ends[:, 0] * vertices + ends[:, 1]
