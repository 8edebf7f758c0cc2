"""Delaunay triangulation and Voronoi dual of points, edge by edge."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments
from crazing.arguments import bounds_tuple, index_chains, period_pair, points_array
from crazing.graph import PlanarGraph
from crazing.quad_edge import QuadEdge
from crazing.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False)
class Diagram(Record):
    """A Delaunay triangulation and its Voronoi dual: edge `k` is one thing with two faces.

    Row `k` of `edges` and row `k` of `dual_edges` are the same edge and its dual, Voronoi vertex `i` is triangle `i`,
    cell `i` is site `i`. Made by :func:`crazing.diagram`.

    Attributes
    ----------
    sites : (n, 2) float64
        Distinct points, in the order of their first appearance.
    site_of : (rows,) int32
        The site of every input row.
    triangles : (t, 3) int32
        Rows of `sites`, counter-clockwise, in the order of a Hilbert curve. Empty when all sites lie on one line.
    vertices : (t, 2) float64
        Voronoi vertices, the circumcentres of the triangles. Exact in number and neighbourhood, rounded in position.
        Neighbours that coincide (cocircular sites) are equal to the last bit.
    edges : (m, 2) int32
        Rows of `sites`, in the order of a Hilbert curve. Edges of the hull have the outside on their left, all others
        run from the lower site to the higher.
    dual_edges : (m, 2) int32
        Rows of `vertices`: the triangle on the right of the edge and the one on its left; -1 is infinity.
    period : (width, height) or None
        Of a periodic diagram: what is repeated. Its sites and vertices lie in [0, width) x [0, height), it has no
        outside, and two sites may have several edges, or one an edge to a copy of itself.
    shifts : (m, 2) int8
        Periods that edge `k` crosses in x and y: it runs from ``sites[edges[k, 0]]`` to
        ``sites[edges[k, 1]] + shifts[k] * period``. Zeros without a period.
    dual_shifts : (m, 2) int8
        The same for the dual edge, from the vertex on the right to the one on the left.
    constrained : (m,) bool
        Whether edge `k` lies on a constraint. Where one does, the triangulation is a constrained Delaunay one: circles
        about triangles are empty only of sites that can be seen from within across no constraint. `vertices` are then
        circumcentres still, and `dual_edges` the neighbourhood of triangles, but no Voronoi diagram; what needs one,
        such as curves and Voronoi mazes, refuses it.
    """

    sites: NDArray[np.float64]
    site_of: NDArray[np.int32]
    triangles: NDArray[np.int32]
    vertices: NDArray[np.float64]
    edges: NDArray[np.int32]
    dual_edges: NDArray[np.int32]
    shifts: NDArray[np.int8] = field(default=None)  # type: ignore[arg-type]
    dual_shifts: NDArray[np.int8] = field(default=None)  # type: ignore[arg-type]
    period: tuple[float, float] | None = None
    constrained: NDArray[np.bool_] = field(default=None)  # type: ignore[arg-type]

    def __post_init__(self) -> None:
        # The core takes C-contiguous arrays of these types, whoever made them.
        for name in ("sites", "vertices"):
            object.__setattr__(self, name, arguments.cast(getattr(self, name), name, np.float64))
        for name in ("site_of", "triangles", "edges", "dual_edges"):
            object.__setattr__(self, name, arguments.cast(getattr(self, name), name, np.int32))
        for name in ("shifts", "dual_shifts"):
            # Zeros that take no memory.
            given = np.int8(0) if getattr(self, name) is None else getattr(self, name)
            object.__setattr__(self, name, arguments.shaped(given, name, np.int8, self.edges.shape))
        given = vars(self)["constrained"]
        constrained = arguments.shaped(False if given is None else given, "constrained", bool, (len(self.edges),))
        object.__setattr__(self, "constrained", constrained)
        super().__post_init__()

    @property
    def arrays(self) -> Arrays:
        """Sites, triangles, vertices, edges and dual edges, as the core takes them."""
        return self.sites, self.triangles, self.vertices, self.edges, self.dual_edges

    @cached_property
    def quad_edge(self) -> QuadEdge:
        """The edge table seen through Guibas and Stolfi's operators."""
        return QuadEdge(
            self, _core.onext(self.arrays, None if self.period is None else np.ascontiguousarray(self.shifts))
        )

    @property
    def delaunay(self) -> PlanarGraph:
        """The Delaunay edges: vertices are the sites, row `k` is edge `k`.

        Of a periodic diagram, edges that leave the period are cut there and go on at the opposite side.
        """
        if self.period is None:
            return PlanarGraph(self.sites, self.edges)
        return tiled(self.sites, self.edges, self.shifts, self.period)

    def voronoi(self, bounds: ArrayLike | None = None) -> PlanarGraph:
        """The Voronoi edges within bounds, rays cut at the bounds.

        Parameters
        ----------
        bounds : (xmin, ymin, xmax, ymax), optional
            Data units. By default the bounding box of the sites, grown by a tenth of its size. A periodic diagram is
            drawn in one period, where edges that leave it are cut and go on at the opposite side; it takes no bounds.

        Returns
        -------
        PlanarGraph
            Edges in the order of `dual_edges`, those without length or outside the bounds left out. Vertices are
            those of the diagram in the same numbering, then the points where edges were cut.

        Raises
        ------
        ValueError
            If the bounds are not finite or have no area, or are given for a periodic diagram, or the diagram has
            constraints.

        Examples
        --------
        >>> import crazing as cz
        >>> d = cz.diagram([(0, 0), (1, 0), (0, 1), (1, 1), (0.5, 0.4)])
        >>> d.voronoi((0, 0, 1, 1)).length > 2
        True
        """
        unconstrained(self)
        if self.period is not None:
            bounds_of(self, bounds)
            return tiled(self.vertices, self.dual_edges, self.dual_shifts, self.period)
        everything = np.ones(len(self.edges), dtype=bool)
        vertices, edges, _ = _core.dual_edges(self.arrays, bounds_of(self, bounds), everything)
        return PlanarGraph(vertices, edges)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        delaunay: bool = True,
        voronoi: bool | None = None,
        bounds: ArrayLike | None = None,
        **line_style: Any,
    ) -> Axes:
        """Draws the Delaunay edges in blue and the Voronoi edges in vermilion with Matplotlib, at equal scales.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; the current axes of pyplot if not given.
        delaunay : bool
            Whether to draw the Delaunay edges; constraints are black.
        voronoi : bool, optional
            Whether to draw the Voronoi edges; by default wherever there are no constraints.
        bounds : (xmin, ymin, xmax, ymax), optional
            What is shown, as for :meth:`voronoi`.
        **line_style
            Of all lines, as for `matplotlib.collections.LineCollection`: `color`, `linewidth`, `alpha`...

        Returns
        -------
        matplotlib.axes.Axes
            What was drawn on; showing it is left to the caller. The lines have labels for a legend.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.
        ValueError
            If Voronoi edges of a diagram with constraints are asked for, or the bounds are none.

        Examples
        --------
        >>> import crazing as cz
        >>> from matplotlib.figure import Figure
        >>> ax = cz.diagram(cz.sample.uniform(50, rng=1)).plot(Figure().subplots())
        >>> [lines.get_label() for lines in ax.collections]
        ['Voronoi', 'Delaunay']
        """
        from crazing import plots

        box = bounds_of(self, bounds)
        is_wanted = not self.constrained.any() if voronoi is None else voronoi
        dual = self.voronoi(bounds) if is_wanted else None
        return plots.diagram(self, ax, delaunay=delaunay, voronoi=dual, box=box, style=line_style)

    def _repr_svg_(self) -> str | None:
        return None if self.period is not None else self.delaunay._repr_svg_()

    def __repr__(self) -> str:
        period = "" if self.period is None else f", period {self.period}"
        return f"Diagram({len(self.sites)} sites, {len(self.edges)} edges, {len(self.triangles)} triangles{period})"


Arrays: TypeAlias = tuple[
    NDArray[np.float64], NDArray[np.int32], NDArray[np.float64], NDArray[np.int32], NDArray[np.int32]
]


def diagram(points: ArrayLike | Diagram, *, constraints: Any = None, period: ArrayLike | None = None) -> Diagram:
    """Delaunay triangulation and Voronoi diagram of points, in the plane or on a torus.

    Parameters
    ----------
    points : (rows, 2) array_like or Diagram
        Finite coordinates. Duplicates are merged. A coordinate smaller than 2**-126 of the largest one counts as zero.
        A diagram is given back; with constraints, they are put between its sites.
    constraints : (k, 2) array_like of int, or list of array_like of int, optional
        Edges that must be there, as two rows of `points` each; or chains of rows, closed where the first is repeated
        at the end. They may touch, not cross or overlap. One that passes through a site is several edges.
    period : (width, height), optional
        Repeat the points with this period in x and y. Sites are moved into [0, width) x [0, height).

    Returns
    -------
    Diagram
        Its combinatorics are exact for the points as given. With a period they are those of 3 x 3 copies, exact for
        coordinates rounded to 2**-51 of the period; where cocircular sites leave a choice, all copies have the same,
        also of points moved or in another order. Of fewer than three distinct points, or of points all on
        one line, it has the edges between neighbours (with both duals -1) and no triangle. On a torus one point has
        two triangles.

    Raises
    ------
    CrazingError
        If a coordinate is NaN or infinite, or the sides of the period differ more than 2**32 times; if two
        constraints cross or overlap (the message names them by their rows), or one joins a point to itself.
    TypeError, ValueError
        If `points` is not an (n, 2) array of real numbers, `constraints` not rows of it, or `period` not two positive
        numbers; if both are given.

    Notes
    -----
    Source: thesis, sections 3.1 and 3.2. Triangulated by spade, points inserted in rounds of doubling size along a
    Hilbert curve (Amenta, Choi, Rote 2003). With a period: after Caroli and Teillaud (2009), by copies, but only of
    the points near the sides. Constraints: Chew (1989); crossings are found by a sweep with exact signs (Shamos, Hoey
    1976) before any is inserted.

    Examples
    --------
    >>> import crazing as cz
    >>> d = cz.diagram([(0, 0), (1, 0), (0, 1), (1, 0)])
    >>> d
    Diagram(3 sites, 3 edges, 1 triangles)
    >>> d.site_of
    array([0, 1, 2, 1], dtype=int32)
    >>> d.vertices
    array([[0.5, 0.5]])
    >>> torus = cz.diagram([(0.1, 0.2), (0.6, 0.5), (0.3, 0.9)], period=(1, 1))
    >>> torus
    Diagram(3 sites, 9 edges, 6 triangles, period (1.0, 1.0))
    >>> torus.shifts.min(), torus.shifts.max()
    (np.int8(-1), np.int8(1))
    >>> kite = cz.diagram([(0, 0), (2, -1), (4, 0), (2, 1)], constraints=[(0, 2)])
    >>> kite.edges[kite.constrained]
    array([[0, 2]], dtype=int32)
    """
    if constraints is None and isinstance(points, Diagram):
        return as_tiling(points, period)
    if constraints is not None:
        if period is not None:
            raise ValueError("constraints and period are both given; a torus has no constraints")
        rows = points_array(points)
        arrays, constrained = _core.constrained_diagram(rows, index_chains(constraints, "constraints", limit=len(rows)))
        return Diagram(*arrays, constrained=constrained)
    if period is None:
        return Diagram(*_core.diagram(points_array(points)))
    sides = period_pair(period)
    return Diagram(*_core.periodic_diagram(points_array(points), sides), period=sides)


def as_diagram(points: ArrayLike | Diagram) -> Diagram:
    """`points` itself if it is a diagram in the plane, else the diagram of the points."""
    if not isinstance(points, Diagram):
        return diagram(points)
    if points.period is not None:
        raise ValueError("points is a periodic diagram; a diagram in the plane is wanted")
    return unconstrained(points)


def unconstrained(diagram: Diagram) -> Diagram:
    """The diagram, if its triangles' circles are empty."""
    if diagram.constrained.any():
        raise ValueError("the diagram has constraints, and so no Voronoi diagram; one without is wanted")
    return diagram


def as_tiling(points: ArrayLike | Diagram, period: ArrayLike | None) -> Diagram:
    """`points` itself if it is a diagram, of that period if one is given, else the diagram of the points."""
    if not isinstance(points, Diagram):
        return diagram(points, period=period)
    if period is not None and period_pair(period) != points.period:
        raise ValueError(f"period is {period_pair(period)}, that of the diagram given as points is {points.period}")
    return points


def tiled(
    points: NDArray[np.float64], edges: NDArray[np.int32], shifts: NDArray[np.int8], period: tuple[float, float]
) -> PlanarGraph:
    """Edges on a torus as a picture of one period that tiles: cut at its sides, and moved into it."""
    return PlanarGraph(*_core.tile(points, edges, np.ascontiguousarray(shifts), period))


def bounds_of(
    diagram: Diagram, bounds: ArrayLike | None, *, closely: bool = False
) -> tuple[float, float, float, float]:
    """`bounds` checked; by default the bounding box of the sites, grown by a tenth of its larger side all round.

    Those of a periodic diagram are its period. Closely, the box grows by no more than half a mean spacing, so that
    cells at its sides are as large as the others.
    """
    if diagram.period is not None:
        if bounds is not None:
            raise ValueError("bounds and period are both given; a periodic picture is one period")
        return 0.0, 0.0, *diagram.period
    if bounds is not None:
        return bounds_tuple(bounds)
    if not len(diagram.sites):
        return 0.0, 0.0, 1.0, 1.0
    # Kept where a width is still a float.
    # Column by column: NumPy takes ten times as long along the first axis of both.
    x, y = diagram.sites.T
    low, high = (np.array(end).clip(-4e307, 4e307) for end in ((x.min(), y.min()), (x.max(), y.max())))
    margin = 0.1 * ((high - low).max() or max(1.0, float(np.abs(high).max())))
    if closely and (high > low).all():
        width, height = np.sqrt(high - low)
        margin = min(margin, 0.5 * width * height / np.sqrt(len(diagram.sites)))
    return bounds_tuple((*(low - margin), *(high + margin)))
