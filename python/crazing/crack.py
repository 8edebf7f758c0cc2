"""Crack patterns: drawings with a width, and who abuts whom."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from crazing.graph import PlanarGraph
from crazing.record import Record


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
        The strand of each edge: a crack that runs through several edges. Of a maze strand 0 is the longest.
    generation : (e,) int32
        0 for a strand that abuts no older one, else one more than its parent's. Of two strands of a maze the longer is
        the older; strands that split cells know their age.
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
        edges = len(self.graph.edges)
        # What is not given takes no memory.
        for name, value, dtype, shape in (
            ("shifts", 0, np.int8, (edges, 2)),
            ("parent", -1, np.int32, (edges,)),
        ):
            given = getattr(self, name)
            array = np.asarray(value if given is None else given, dtype=dtype)
            object.__setattr__(self, name, np.broadcast_to(array, shape))
        super().__post_init__()

    @property
    def segments(self) -> NDArray[np.float64]:
        """(e, 2, 2) float64, the positions of both ends of every edge; the second may lie beyond the period."""
        ends = self.graph.segments
        if self.period is not None:
            ends[:, 1] += self.shifts * np.asarray(self.period)
        return ends

    def __repr__(self) -> str:
        strands = int(self.strand.max(initial=-1)) + 1
        period = "" if self.period is None else f", period {self.period}"
        return f"Crack({len(self.graph.edges)} edges, {strands} strands, bounds {self.bounds}{period})"
