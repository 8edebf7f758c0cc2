"""Crack patterns: drawings with a width, and who abuts whom."""

from __future__ import annotations

import os
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments, files
from crazing.arguments import number
from crazing.graph import PlanarGraph
from crazing.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Pixels a side of what a notebook shows.
_SHOWN = 512


@dataclass(frozen=True, eq=False, repr=False)
class Crack(Record):
    """A crack pattern. Made by :func:`crazing.crack`.

    Attributes
    ----------
    graph : PlanarGraph
        Centrelines; every vertex has an edge. On a torus the vertices lie in `bounds`, one period, and edges may run
        on beyond it, see `shifts`.
    width : (e, 2) float64
        Width at the two ends of each edge, data units; 0 at a free tip.
    strand : (e,) int32
        The strand of each edge: a crack that runs through several edges. Strand 0 is the oldest, of a maze the longest.
    generation : (e,) int32
        0 for a strand that abuts no older one, else one more than its parent's. Of two strands of a maze the longer is
        the older; strands that split plates know their age.
    bounds : (xmin, ymin, xmax, ymax)
        What the pattern is clipped to, data units; on a torus one period.
    period : (width, height) or None
        What is repeated.
    shifts : (e, 2) int8
        Periods that edge `k` crosses in x and y: it runs from ``vertices[edges[k, 0]]`` to
        ``vertices[edges[k, 1]] + shifts[k] * period``. Zeros without a period.
    parent : (e,) int32
        The strand that the strand of each edge abuts: the youngest of the older ones at its ends; -1 for none.
    """

    graph: PlanarGraph
    width: NDArray[np.float64]
    strand: NDArray[np.int32]
    generation: NDArray[np.int32]
    bounds: tuple[float, float, float, float]
    period: tuple[float, float] | None = None
    shifts: NDArray[np.int8] = field(default=None)  # type: ignore[arg-type]
    parent: NDArray[np.int32] = field(default=None)  # type: ignore[arg-type]

    def __post_init__(self) -> None:
        edges = len(arguments.of_kind(self.graph, "graph", PlanarGraph).edges)
        # What is not given takes no memory.
        for name, value, dtype, shape in (
            ("width", None, np.float64, (edges, 2)),
            ("strand", None, np.int32, (edges,)),
            ("generation", None, np.int32, (edges,)),
            ("shifts", 0, np.int8, (edges, 2)),
            ("parent", -1, np.int32, (edges,)),
        ):
            given = getattr(self, name)
            object.__setattr__(self, name, arguments.shaped(value if given is None else given, name, dtype, shape))
        super().__post_init__()

    @property
    def segments(self) -> NDArray[np.float64]:
        """(e, 2, 2) float64, the positions of both ends of every edge; the second may lie beyond the period."""
        ends = self.graph.segments
        if self.period is not None:
            ends[:, 1] += self.shifts * np.asarray(self.period)
        return ends

    @property
    def arrivals(self) -> NDArray[np.float64]:
        """(e, 2) float64, when the crack gets to both ends of every edge, 0 to 1.

        Strands are due one after the other, the oldest first, and wait until their parent is there, which younger ones
        may not have to; from the parent, or from their middle, tips advance at one speed.
        """
        period = (0.0, 0.0) if self.period is None else self.period
        shifts = self.shifts if self.period is not None else np.empty((0, 2), dtype=np.int8)
        cut = np.zeros(len(self.graph.vertices), dtype=bool)
        net = self.graph.vertices, self.graph.edges, np.ascontiguousarray(shifts), period, cut
        return _core.crack_arrivals(net, np.ascontiguousarray(self.strand), np.ascontiguousarray(self.parent))

    def at(self, age: float) -> Crack:
        """The pattern while it grows: older strands mostly first, tips advancing, and wider the older a place is.

        Parameters
        ----------
        age : float
            0, when there is nothing yet, to 1, the whole pattern.

        Returns
        -------
        Crack
            What is there at that age; edges on the way are cut where their tip is.

        Raises
        ------
        TypeError, ValueError
            If the age is no number from 0 to 1.

        Examples
        --------
        >>> import crazing as cz
        >>> c = cz.crack(preset="glaze", rng=1)
        >>> [round(c.at(age).graph.length / c.graph.length, 1) for age in (0, 0.5, 1)]
        [0.0, ..., 1.0]
        >>> c.at(1) == c
        True
        """
        age = number(age, "age", low=0, high=1)
        if age == 1:
            return self
        when = self.arrivals
        first = when.argmin(axis=1)
        rows = np.flatnonzero(when.min(axis=1, initial=np.inf) < age)
        edges, segments, when, first = self.graph.edges[rows].copy(), self.segments[rows], when[rows], first[rows]
        width = self.width[rows] * _opened(when, age)
        shifts = self.shifts[rows].copy()
        growing = np.flatnonzero(when.max(axis=1, initial=-np.inf) > age)
        start = first[growing]
        here, there = segments[growing, start], segments[growing, 1 - start]
        early, late = when[growing, start], when[growing, 1 - start]
        part = (age - early) / (late - early)
        tips = here + part[:, None] * (there - here)
        edges[growing, 1 - start] = len(self.graph.vertices) + np.arange(len(growing))
        if self.period is not None:
            tips, away = self._home(tips)
            # A tip that is the second end lies where it went; from the first, the second end is as far as it was.
            shifts[growing] = np.where(start[:, None] == 0, away, shifts[growing] - away)
        width[growing, 1 - start] = 0
        graph = PlanarGraph(np.concatenate([self.graph.vertices, tips]), edges).compact()
        return replace(
            self,
            graph=graph,
            width=width,
            shifts=shifts,
            **{name: getattr(self, name)[rows] for name in ("strand", "generation", "parent")},
        )

    def shifted(self, dx: float, dy: float) -> Crack:
        """The pattern moved on its torus: what leaves on one side comes in on the other.

        Its texture is that of the pattern, rolled: bit for bit in every map, where the shift is a whole number of
        pixels, and the places of vertices and shift can be added without rounding. Else a vertex may be rounded to
        another 65536th of a pixel.

        Parameters
        ----------
        dx, dy : float
            To the right and up, data units.

        Returns
        -------
        Crack

        Raises
        ------
        ValueError
            If the pattern has no period.
        TypeError, ValueError
            If the shift is no finite number.

        Examples
        --------
        >>> import numpy as np
        >>> import crazing as cz
        >>> c = cz.crack(n=60, period=(1, 1), rng=5)
        >>> one, other = (cz.texture(pattern, 64)["mask"] for pattern in (c, c.shifted(5 / 64, 2 / 64)))
        >>> bool((np.roll(one, (-2, 5), axis=(0, 1)) == other).all())
        True
        """
        by = np.array([number(dx, "dx"), number(dy, "dy")])
        if self.period is None:
            raise ValueError("the pattern has no period: only on a torus can it be shifted")
        moved, away = self._home(self.graph.vertices + np.fmod(by, np.asarray(self.period)))
        first, second = self.graph.edges.T
        shifts = (self.shifts + away[second] - away[first]).astype(np.int8)
        return replace(self, graph=PlanarGraph(moved, self.graph.edges), shifts=shifts)

    def _home(self, points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
        """The places in the period that points on its torus have, and how many periods from there they were."""
        period, corner = np.asarray(self.period), np.asarray(self.bounds[:2])
        away = np.floor((points - corner) / period).astype(np.int64)
        # What rounds up to the far side is the near one.
        away += points - away * period >= corner + period
        return points - away * period, away

    def plot(self, ax: Axes | None = None, **style: Any) -> Axes:
        """Fills the cracks with Matplotlib, in their true widths, at equal scales.

        What is drawn are the outlines that `save` writes to SVG. A pattern on a torus is cut at the sides of its
        period, and what leaves on one side comes in on the other.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; the current axes of pyplot if not given.
        **style
            As for `matplotlib.collections.PolyCollection`: `facecolor`, `alpha`, `label`...

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on; showing it is left to the caller.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import crazing as cz
        >>> from matplotlib.figure import Figure
        >>> ax = cz.crack(n=50, rng=1).plot(Figure().subplots(), facecolor="brown")
        >>> len(ax.collections)
        1
        """
        from crazing import plots

        return plots.crack(self, ax, style=style)

    def save(self, path: str | os.PathLike[str], *, millimetres: float | None = None) -> None:
        """Write the pattern as a drawing, in data units; an existing file is replaced.

        A pattern on a torus is drawn over one period: lines that leave it run on beyond its sides.

        Parameters
        ----------
        path : str or path-like
            Its ending decides the format. `.svg`: a group of outlines with the true widths, filled by the nonzero rule,
            and a hidden one of centrelines, a group in each for every generation, moved by a `transform` when far from
            the origin; on a torus copies of both fill the period, so that the picture tiles. `.dxf` (needs ezdxf, the
            extra `cad`): polylines with their widths, a layer for every generation, without a unit. `.geojson`: a line
            for every strand, with the properties strand, generation, parent (null for none), width (largest), widths
            (one a point), without a reference system. A strand that is still growing, or abuts itself, may be
            several lines.
        millimetres : float, optional
            How long a data unit is for a plotter, a cutter or a printer. `.svg` says so by its width and height, its
            coordinates stay; `.dxf` is in millimetres. By default neither has a size, and programs choose one.

        Raises
        ------
        ValueError
            If the ending is another, or a coordinate or width is not finite, or a width negative; if `millimetres` are
            given for `.geojson`, or out of range.
        OSError
            If the file cannot be written; what stood there before is then untouched.
        ImportError
            If ezdxf is needed and not installed.

        Examples
        --------
        >>> import json, os, tempfile
        >>> import crazing as cz
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = os.path.join(folder, "crack.geojson")
        ...     cz.crack(n=50, rng=1).save(path)
        ...     with open(path) as file:
        ...         sorted(json.load(file)["features"][0]["properties"])
        ['generation', 'parent', 'strand', 'width', 'widths']
        """
        from crazing import vectors

        vectors.save(self, path, millimetres)

    def _repr_png_(self) -> bytes | None:
        from crazing.render import render

        try:
            return files.encoded(render(self, _SHOWN))
        except ValueError:
            # Not finite: the notebook then prints the counts.
            return None

    def __repr__(self) -> str:
        strands = int(self.strand.max(initial=-1)) + 1
        period = "" if self.period is None else f", period {self.period}"
        return f"Crack({len(self.graph.edges)} edges, {strands} strands, bounds {self.bounds}{period})"


def _opened(when: NDArray[np.float64], age: float) -> NDArray[np.float64]:
    """The part of its width that a place has reached: it opens with the square root of its own age."""
    rest = np.maximum(1 - when, 1e-9)
    return np.asarray(np.sqrt(np.clip((age - when) / rest, 0, 1)))
