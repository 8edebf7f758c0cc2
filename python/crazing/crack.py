"""Crack patterns: the walls of a maze, with a width."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, sample
from crazing import rng as _rng
from crazing.arguments import bounds_tuple, count, number
from crazing.diagram import Diagram, as_diagram, bounds_of
from crazing.graph import PlanarGraph
from crazing.maze import maze
from crazing.record import Record


@dataclass(frozen=True, eq=False, repr=False)
class Crack(Record):
    """A crack pattern. Made by :func:`crazing.crack`.

    Attributes
    ----------
    graph : PlanarGraph
        Centrelines; every vertex has an edge.
    width : (e, 2) float64
        Width at the two ends of each edge, data units; 0 at a free tip.
    strand : (e,) int32
        The strand of each edge: a crack that runs through several edges. Strand 0 is the longest.
    generation : (e,) int32
        0 for a strand that abuts no longer one, else one more than the youngest longer strand it abuts.
    bounds : (xmin, ymin, xmax, ymax)
        What the pattern is clipped to, data units.
    """

    graph: PlanarGraph
    width: NDArray[np.float64]
    strand: NDArray[np.int32]
    generation: NDArray[np.int32]
    bounds: tuple[float, float, float, float]

    @property
    def period(self) -> None:
        """None: the pattern does not repeat."""
        return None

    def __repr__(self) -> str:
        strands = int(self.strand.max(initial=-1)) + 1
        return f"Crack({len(self.graph.edges)} edges, {strands} strands, bounds {self.bounds})"


def crack(
    points: ArrayLike | Diagram | None = None,
    *,
    n: int | None = None,
    opening: float = 1.0,
    width: float | None = None,
    hierarchy: float = 0.5,
    taper: float = 0.5,
    bounds: ArrayLike | None = None,
    rng: _rng.RNG = None,
) -> Crack:
    """A crack pattern: the walls of a depth-first maze over points, with widths that run out to the free tips.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram, optional
        Where the plates between the cracks are; cracks are finest where points are dense. By default `n` uniform
        points in `bounds`.
    n : int, optional
        Number of uniform points when `points` is not given, 300 by default.
    opening : float, optional
        The share of the maze's passages that are really opened: 1 is the thesis (cracks are trees), 0 leaves every
        plate closed all round. Paint and glaze measure .6 to .85.
    width : float, optional
        Width of the longest crack, data units. By default an eighth of the median distance between neighbouring points.
    hierarchy : float, optional
        Width grows with this power of the length of a crack: 0 makes all alike, .5 is what real cracks show.
    taper : float, optional
        The part of a crack over which a free tip runs out, 0 to 1.
    bounds : (xmin, ymin, xmax, ymax), optional
        What the pattern is clipped to, data units. By default the unit square without `points`, else their bounding
        box grown by a tenth.
    rng : int, numpy.random.Generator or None, optional
        Seed. The same seed gives the same pattern on every platform.

    Returns
    -------
    Crack

    Raises
    ------
    TypeError, ValueError
        If both `points` and `n` are given, or a number is out of range.
    CrazingError
        If a coordinate is NaN or infinite.

    Notes
    -----
    Source: thesis, section 8; strands and width after measurements of real cracks.

    Examples
    --------
    >>> import crazing as cz
    >>> uniform = cz.crack(n=200, rng=7)
    >>> impact = cz.crack(cz.sample.laplace(200, rng=7), rng=7)
    >>> uniform.bounds, bool(impact.width.min() == 0)
    ((0.0, 0.0, 1.0, 1.0), True)
    """
    opening = number(opening, "opening", low=0, high=1)
    hierarchy = number(hierarchy, "hierarchy", low=0, high=8)
    taper = number(taper, "taper", low=0, high=1)
    if points is not None and n is not None:
        raise ValueError("points and n are both given; n is for uniform points without points")
    seed = np.random.default_rng(rng)
    if points is None:
        bounds = bounds_tuple((0, 0, 1, 1) if bounds is None else bounds)
        points = sample.uniform(300 if n is None else count(n, "n"), bounds=bounds, rng=seed)
    diagram = as_diagram(points)
    box = bounds_of(diagram, bounds)
    width = _default_width(diagram) if width is None else number(width, "width", low=0)
    open_doors = maze(diagram, opening=opening, bounds=box, rng=seed).open
    found = _core.crack(diagram.arrays, open_doors, box, width, hierarchy, taper)
    vertices, edges, widths, strand, generation = found
    return Crack(PlanarGraph(vertices, edges), widths, strand, generation, box)


def _default_width(diagram: Diagram) -> float:
    """An eighth of the median length of the Delaunay edges: the mean would follow far outliers."""
    if not len(diagram.edges):
        return 0.0
    ends = diagram.sites[diagram.edges]
    return float(np.median(np.hypot(*(ends[:, 1] - ends[:, 0]).T))) / 8
