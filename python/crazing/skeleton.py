"""Curves and skeletons of point samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, pruning
from crazing.arguments import choice, count, real_array
from crazing.diagram import Diagram, as_diagram
from crazing.errors import CrazingError
from crazing.graph import PlanarGraph
from crazing.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Mask: TypeAlias = NDArray[np.bool_]

#: Methods of `crust`, and ways to choose poles.
CRUSTS = ("two-pass", "one-step", "gabriel", "nn")
#: Methods of `medial_axis`.
METHODS = ("edge-filter", "one-step", "initial", "poles")
VARIANTS = ("thesis", "amenta")
#: Points that feeding back may lead to: as many skeletons are kept, and the next would be some three times as large.
MOST = 1 << 24


@dataclass(frozen=True, eq=False, repr=False)
class Skeleton(Record):
    """Crust and medial axis of one point set by one method. Made by :func:`crazing.medial_axis`.

    Attributes
    ----------
    diagram : Diagram
        Of the samples.
    method : str
        How it was found.
    crust : PlanarGraph
        The curve: vertices are the sites of the diagram.
    axis : PlanarGraph
        The medial axis: vertices are those of the diagram. Edges to infinity and edges without length are left out;
        coincident vertices are represented by the lowest row.
    crust_mask, axis_mask : (m,) bool or None
        Which edges of the diagram are crust, and which dual edges are axis; None for `"initial"` and `"poles"`, whose
        axis may hold edges that are not dual. For `"one-step"` each is the complement of the other.
    """

    diagram: Diagram
    method: str
    crust: PlanarGraph
    axis: PlanarGraph
    crust_mask: Mask | None
    axis_mask: Mask | None

    def __repr__(self) -> str:
        return f"Skeleton({self.method!r}, {len(self.crust.edges)} crust edges, {len(self.axis.edges)} axis edges)"

    @cached_property
    def radius(self) -> NDArray[np.float64]:
        """(t,) float64, the distance from each vertex of the diagram to its nearest site, in data units.

        Examples
        --------
        >>> import crazing as cz
        >>> cz.medial_axis([(0, 0), (6, 0), (0, 8)]).radius
        array([5.])
        """
        site = self.diagram.sites[self.diagram.triangles[:, 0]]
        # Between the ends of the range of floats the radius may be none.
        with np.errstate(over="ignore"):
            return np.asarray(np.hypot(*(self.diagram.vertices - site).T))

    @cached_property
    def inside(self) -> Mask:
        """(m,) bool, the axis edges inside the closed rings of the crust, over the diagram's edges.

        Triangles are flooded from infinity, sides change across rings. Where the crust is not made of rings alone,
        the rings are those of :func:`crazing.curve` on the same diagram; a line whose ends are no more than twelve
        mean steps and a tenth of its length apart counts as closed. For an axis without a mask these are all
        dual edges inside. Of points that lie on no curve, such as random ones, those rings take long to find.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
        >>> s = cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)]), method="one-step")
        >>> bool((s.inside <= s.axis_mask).all()), int(s.inside.sum())
        (True, 197)
        """
        inner = self._sides[0]
        return inner if self.axis_mask is None else inner & self.axis_mask

    @property
    def inner(self) -> PlanarGraph:
        """The axis inside the closed rings of the crust, on the diagram's vertices.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
        >>> cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)])).inner.leaves
        2
        """
        return _axis_graph(self.diagram, self.inside)

    @property
    def main(self) -> PlanarGraph:
        """The longest path of the axis, inside the crust if any of it is: a centreline, on the diagram's vertices.

        In an axis with rings it is a shortest path nearly as long as any.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
        >>> main = cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)])).main
        >>> round(main.length, 2), main.leaves
        (3.0, 2)
        """
        inner = self.inner
        axis = inner if len(inner.edges) else self.axis
        return PlanarGraph(axis.vertices, axis.edges[_core.longest_path(axis.vertices, axis.edges)])

    def prune(
        self,
        residual: float | None = None,
        *,
        chord: float | None = None,
        length: float | None = None,
        ratio: float | None = None,
        height: float | None = None,
        retract: int | None = None,
    ) -> Skeleton:
        """The same skeleton with an axis without hairs.

        What is given is done; what is not given is not done. If nothing is, it is an arc residual of 0.0125, and then
        what the noise of the samples allows, which is estimated on every closed ring of crust from the change of its
        curvature from sample to sample: nothing on a smooth curve or a polygon, about a pixel's stairs on the contour
        of a mask. A tip stays if the middle of its part of the ring rises, in the mean, above the circle about the end
        of it by more than noise does anywhere in a ring, some five standard deviations. The tips left then grow again,
        one way each, up to where the rise is no longer sure; that makes no new tip.

        Nothing falls apart: what hangs together inside the rings, or around them, does so afterwards. A component
        whose edges are all too small vanishes. Edges that cross a ring, through gaps that noise leaves in it, hold
        nothing together.

        Parameters
        ----------
        residual : float, optional
            Least part of the closed ring of crust that an axis edge has to span: the shorter way along the ring
            between its two sites, over the length of the ring. Needs no unit and makes no cycle. Between two lines it
            is infinite; edges that span less stay where they hold such parts together, as before a lobe with a hole.
        chord : float, optional
            Least distance between the two sites of an axis edge, in data units; narrower necks between wider parts
            stay.
        length : float, optional
            Least length of a branch that ends freely, in data units; the shortest goes first.
        ratio : float, optional
            Least ratio of what a branch that ends freely reaches, its length and the radius at its tip, to the
            radius at its junction; 1 is a branch that adds nothing.
        height : float, optional
            Least height, in data units, by which the crust between the two sites of an edge at a tip rises above the
            circle about the end of that edge; tips go from outside in until one rises so far. Edges whose sites are
            a quarter of their ring apart stay.
        retract : int, optional
            How many times every leaf is retracted to its parent; the sample at its tip is moved to the parent's
            circle.

        Returns
        -------
        Skeleton
            The diagram and its numbering are the same. The crust is that of before, but for moved samples.

        Raises
        ------
        ValueError
            If a number is negative or not finite, or the axis has edges that are not dual (methods `"initial"` and
            `"poles"`).

        Notes
        -----
        Measured on 1,000 samples of an ellipse and of a flower with 13 petals, moved by up to a quarter of their
        spacing: the inner one-step axis has about 350 leaves in one component. The edge-filtered axis looks cleaner
        without noise because it drops edges; with it, it falls into a hundred components, which no pruning puts
        together. Pruned by the default, the one-step axis has exactly 2 and 13 leaves, for 1,000 and 3,000 samples.
        When the noise is normal with that deviation, one axis in twenty (of 1,000 samples) or ten (of 3,000) has
        others, nearly always in pieces, as its ring stays open; at 0.4 of the spacing samples change places along the
        curve, and the default fails as often as not. The axis of 1,000 samples is then at most 1.7 times the noise
        from the true one, 2.8 times if that is normal, and its tips are cut by at most 2.9 % of the diameter, 4.4 %
        if it is normal. Normal noise on more samples leaves a tip askew now and then.

        Sources: Ogniewicz, Kübler: Hierarchic Voronoi Skeletons, 1995 (arc residual); Chazal, Lieutier: The
        lambda-medial axis, 2005 (chord); Gold, Thibault: Map generalization by skeleton retraction, 2001. The height
        is our own.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> t = np.linspace(0, 2 * np.pi, 500, endpoint=False)
        >>> noise = 1 + 0.002 * np.cos(np.arange(500) ** 2)
        >>> s = cz.medial_axis(np.column_stack([2 * noise * np.cos(t), noise * np.sin(t)]), method="one-step")
        >>> s.inner.leaves > 20, s.prune().inner.leaves
        (True, 2)
        """
        limits = pruning.Limits(residual, chord, length, ratio, height, retract)
        return pruning.prune(self, limits)

    def plot(self, ax: Axes | None = None, *, bounds: ArrayLike | None = None, **line_style: Any) -> Axes:
        """Draws the crust in black and the axis in vermilion with Matplotlib, at equal scales.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; the current axes of pyplot if not given.
        bounds : (xmin, ymin, xmax, ymax), optional
            What is shown, data units. By default the bounding box of the samples grown by 5 %: vertices of the axis
            may lie far outside.
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
            If the bounds are not finite or have no area.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> from matplotlib.figure import Figure
        >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
        >>> s = cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)]), method="one-step")
        >>> ax = s.prune().plot(Figure().subplots(), linewidth=2)
        >>> [lines.get_label() for lines in ax.collections]
        ['axis', 'crust']
        """
        from crazing import plots

        return plots.skeleton(self, ax, bounds=bounds, style=line_style)

    @cached_property
    def ring_mask(self) -> Mask:
        """(m,) bool, the edges whose rings tell inside from outside: the crust, or the curve where that branches.

        Examples
        --------
        >>> import crazing as cz
        >>> int(cz.medial_axis([(0, 0), (6, 0), (0, 8)]).ring_mask.sum())
        3
        """
        mask = self.crust_mask
        if mask is None:
            mask = _among(self.diagram.edges, self.crust.edges)
        degrees = PlanarGraph(self.diagram.sites, self.diagram.edges[mask]).degrees
        return mask if (degrees == 2).all() else _core.curve(self.diagram.arrays)

    @cached_property
    def _sides(self) -> tuple[Mask, Mask, NDArray[np.float64]]:
        """Whether each dual edge is inside the rings, whether it crosses one, and its arc residual."""
        return _core.sides(self.diagram.arrays, self.ring_mask)


def _among(edges: NDArray[np.int32], wanted: NDArray[np.int32]) -> Mask:
    """Which rows of `edges` are in `wanted`, as they stand."""
    rows, keys = (np.ascontiguousarray(table).view(np.int64).ravel() for table in (edges, wanted))
    return np.isin(rows, keys)


def curve(points: ArrayLike | Diagram) -> PlanarGraph:
    """Closed or open curves through all samples, corners included.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves that do not touch.

    Returns
    -------
    PlanarGraph
        Vertices are the sites of the diagram. Edges are Delaunay edges in its order, then some that each pass across
        one of the others, as a curve does where samples are too few: about one in a hundred on outlines of land, none
        on a smooth curve. No two edges cross, and no site has more than two of them; `polylines` gives the curves.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct samples, or all lie on one line.
    CrazingError
        If a coordinate is NaN or infinite.
    TypeError, ValueError
        If `points` has not that shape, or is a periodic or constrained diagram.

    Notes
    -----
    The one-step crust, but for where a sample has not two edges, the curve turns sharply, or a ring is small. There a
    cost of edge lengths beside their surroundings, turns, uneven lengths, free ends and small rings is lowered: first
    samples tell each other what each edge is worth to them until they agree, then edges are exchanged along short
    trails. Source: after Gold, Snoeyink 2001 (the crust), Ohrhallinger, Mudur 2013 (two cheap edges for every sample),
    Bayati, Shah, Sharma 2008 (max-product) and Lin, Kernighan 1973 (trails); the cost is our own.

    In whatever order the samples come, the curve is the same. They are taken to stand on it: beside it by a normal
    error of a quarter of the spacing, a ring of a thousand samples may come out with a few ends free; `Skeleton` takes
    the rings of its sides with turns that weigh less, which mostly stay closed.

    Points that lie on no curve, such as random ones, are amiss everywhere: they take hundreds of times as long as their
    diagram, about a millisecond each.

    Examples
    --------
    >>> import crazing as cz
    >>> wedge = [(x / 8, s * x / 64) for x in range(9) for s in (1, -1)] + [(1, 0)]
    >>> curve = cz.curve(wedge)
    >>> len(curve.edges), set(curve.degrees.tolist())
    (18, {2})
    """
    diagram = as_diagram(points)
    return PlanarGraph._of_core(diagram.sites, _core.curve_edges(diagram.arrays))


def crust(points: ArrayLike | Diagram, *, method: str = "two-pass") -> PlanarGraph:
    """The curve that points were sampled from.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves.
    method : {"two-pass", "one-step", "gabriel", "nn"}
        ``"two-pass"``: edges of the Delaunay triangulation of samples and Voronoi vertices that join two samples
        (Amenta, Bern, Eppstein 1998). ``"one-step"``: Delaunay edges with a circle through both ends that holds
        neither end of the dual edge (Gold, Snoeyink 2001); a superset, and much cheaper. ``"gabriel"``: edges that
        their dual crosses, i.e. with no obtuse angle opposite (the thesis' wording of one-step); a superset again.
        ``"nn"``: every sample joined to its nearest neighbour in the diagram and to the nearest one beyond, at more
        than 90 degrees from the first (Dey, Kumar 1999); equally near ones are all taken.

    Returns
    -------
    PlanarGraph
        Vertices are the sites of the diagram, edges are in its order.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct samples, or all lie on one line.
    CrazingError
        If a coordinate is NaN or infinite.
    TypeError, ValueError
        If `points` has not that shape, or is a periodic or constrained diagram, or the method is another.

    Notes
    -----
    Source: thesis, sections 4.1 and 5.3.

    Examples
    --------
    >>> import numpy as np, crazing as cz
    >>> t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    >>> curve = cz.crust(np.column_stack([2 * np.cos(t), np.sin(t)]))
    >>> len(curve.edges), set(curve.degrees.tolist())
    (60, {2})
    """
    choice(method, "method", CRUSTS)
    diagram = as_diagram(points)
    return _crust_graph(diagram, _crust_mask(diagram, method))


def poles(points: ArrayLike | Diagram, *, variant: str = "thesis") -> NDArray[np.int32]:
    """Of every cell the two Voronoi vertices that tell best where the medial axis runs.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves.
    variant : {"thesis", "amenta"}
        ``"thesis"``: first the vertex farthest from the site, then the one with the smallest product
        ``<vertex - site, first - site>``; finite vertices only. ``"amenta"``: second the farthest vertex whose product
        is negative; the first pole of an unbounded cell is at infinity, in the mean direction of the normals of its
        two hull edges.

    Returns
    -------
    (n, 2) ndarray of int32
        For every site of the diagram the rows of its poles in `vertices`, the first one first; -1 is infinity for
        the first and none for the second. Coincident vertices are represented by the lowest row, which also wins a
        tie.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct samples, or all lie on one line.
    CrazingError
        If a coordinate is NaN or infinite.
    TypeError, ValueError
        If `points` has not that shape, or is a periodic or constrained diagram, or the variant is another.

    Notes
    -----
    Distances are compared exactly, between vertices as they are rounded. Source: thesis, section 5.1; Amenta, Bern:
    Surface Reconstruction by Voronoi Filtering, 1999.

    Examples
    --------
    >>> import crazing as cz
    >>> d = cz.diagram([(0, 0), (4, 0), (4, 4), (0, 4), (2, 1)])
    >>> d.vertices[cz.poles(d)[4]].round(3).tolist()
    [[2.0, -1.5], [2.0, 3.167]]
    """
    amenta = choice(variant, "variant", VARIANTS) == "amenta"
    return _core.poles(as_diagram(points).arrays, amenta)


def medial_axis(points: ArrayLike | Diagram, *, method: str = "edge-filter", variant: str = "thesis") -> Skeleton:
    """Curve and medial axis (topological skeleton) of point samples.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves.
    method : {"edge-filter", "one-step", "initial", "poles"}
        ``"initial"``: edges of the second Delaunay triangulation, of samples and Voronoi vertices, that join two
        Voronoi vertices. ``"edge-filter"``: those of them that are Voronoi edges (the thesis' own method).
        ``"one-step"``: the duals of all edges that are not one-step crust (Gold and Snoeyink's anti-crust).
        ``"poles"``: edges of the Delaunay triangulation of samples and poles that join two poles.
    variant : {"thesis", "amenta"}
        Which poles ``"poles"`` takes; see :func:`crazing.poles`.

    Returns
    -------
    Skeleton
        Crust and axis on the diagram's numbering, the same for every method. The crust is the two-pass one, for
        ``"one-step"`` its own.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct samples, or all lie on one line.
    CrazingError
        If a coordinate is NaN or infinite.
    TypeError, ValueError
        If `points` has not that shape, or is a periodic or constrained diagram, or the method or variant is
        another.

    Notes
    -----
    Source: thesis, sections 4.2, 5.1, 5.2 and 5.3.

    Examples
    --------
    >>> import numpy as np, crazing as cz
    >>> t = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    >>> s = cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)]), method="one-step")
    >>> s.method, len(s.crust.edges)
    ('one-step', 200)
    >>> bool((s.crust_mask ^ s.axis_mask).all())
    True
    """
    choice(method, "method", METHODS)
    methods: dict[str, Callable[[Diagram], Skeleton]] = {
        "edge-filter": _edge_filter,
        "one-step": _one_step,
        "initial": _initial,
        "poles": partial(_poles, choice(variant, "variant", VARIANTS)),
    }
    return methods[method](as_diagram(points))


def nested(
    points: ArrayLike, *, iterations: int, method: str = "edge-filter", bounds: ArrayLike | None = None
) -> list[Skeleton]:
    """Nested curves: skeletons of a set of points to which the Voronoi vertices are added again and again.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves.
    iterations : int
        How many skeletons, at least 1. The points grow some threefold each time.
    method : str
        As for :func:`crazing.medial_axis`.
    bounds : (xmin, ymin, xmax, ymax), optional
        Vertices outside are not added, those on the border are. By default the bounding box of the points, grown on
        every side by half its width or height; a side may be infinite.

    Returns
    -------
    list of Skeleton
        Skeleton `i` is of the points after `i` rounds: the first is that of the points as given.

    Raises
    ------
    DegenerateInputError
        If there are fewer than three distinct samples, or all lie on one line.
    CrazingError
        If a coordinate is NaN or infinite, or the points become too many.
    ValueError
        If `iterations` is less than 1, or the bounds have no area.

    Notes
    -----
    Without bounds the extent grows beyond all use within a few rounds: a flat triangle at the hull has a vertex far
    away. By ``"poles"``, a fed-back vertex often has two farthest vertices that are mirror images, between which
    rounding decides: from the second skeleton on, a mirrored input may give another axis. Source: thesis, sections
    4.2 and 5.2.

    Examples
    --------
    >>> import crazing as cz
    >>> [len(s.diagram.sites) for s in cz.nested(cz.sample.uniform(75, rng=1), iterations=3)]
    [75, ..., ...]
    """
    rounds = count(iterations, "iterations", low=1)
    diagram = as_diagram(points)
    found = [medial_axis(diagram, method=method)]
    within = _default_box(diagram.sites) if bounds is None else _box(bounds)
    while len(found) < rounds:
        points = np.concatenate([diagram.sites, _fed_back(diagram, within)])
        if len(points) > MOST:
            raise CrazingError(f"skeleton {len(found)} would have {len(points)} points; at most {MOST} are taken")
        diagram = as_diagram(points)
        found.append(medial_axis(diagram, method=method))
    return found


def _default_box(sites: NDArray[np.float64]) -> NDArray[np.float64]:
    """The lower and the upper corner of the bounding box, grown on every side by half its size."""
    low, high = sites.min(axis=0), sites.max(axis=0)
    with np.errstate(over="ignore"):
        return np.array([1.5 * low - 0.5 * high, 1.5 * high - 0.5 * low])


def _box(bounds: ArrayLike) -> NDArray[np.float64]:
    """The lower and the upper corner; unlike the bounds of a picture, those of feeding back may be infinite."""
    corners = real_array(bounds, "bounds")
    if corners.shape != (4,):
        raise ValueError(f"bounds has shape {corners.shape}; (xmin, ymin, xmax, ymax) is wanted")
    if not (corners[:2] < corners[2:]).all():
        raise ValueError(f"bounds is {tuple(corners.tolist())}; xmin < xmax and ymin < ymax are wanted")
    return corners.reshape(2, 2)


def _fed_back(diagram: Diagram, within: NDArray[np.float64]) -> NDArray[np.float64]:
    """The distinct vertices inside the box; no two of coincident ones."""
    distinct = np.unique(_core.representatives(diagram.arrays))
    vertices = diagram.vertices[distinct]
    inside = ((within[0] <= vertices) & (vertices <= within[1])).all(axis=1)
    kept: NDArray[np.float64] = vertices[inside]
    return kept


def _crust_masks(diagram: Diagram) -> dict[str, Mask]:
    """The crusts of a diagram that are known, in a byte an edge: other methods begin or end with them."""
    masks: dict[str, Mask] = vars(diagram).setdefault("_crust_masks", {})
    return masks


def _crust_mask(diagram: Diagram, method: str) -> Mask:
    """The crust of a diagram, found once."""
    masks = _crust_masks(diagram)
    if method not in masks:
        arrays = diagram.arrays
        two_pass = method == "two-pass"
        masks[method] = _frozen(
            _core.two_pass(arrays, _known(diagram)) if two_pass else _core.crust_mask(arrays, method)
        )
    return masks[method]


def _known(diagram: Diagram) -> tuple[Mask, NDArray[np.uint32]]:
    """The one-step crust and the links between triangles, which are made once, too."""
    held = vars(diagram)
    if "_links" not in held:
        held["_links"] = _core.links(diagram.arrays)
    return _one_step_mask(diagram), held["_links"]


def _one_step_mask(diagram: Diagram) -> Mask:
    return _crust_mask(diagram, "one-step")


def _two_pass_mask(diagram: Diagram) -> Mask:
    return _crust_mask(diagram, "two-pass")


def _frozen(mask: Mask) -> Mask:
    mask.flags.writeable = False
    return mask


def _crust_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    # Several times faster than indexing with the mask.
    return PlanarGraph._of_core(diagram.sites, np.compress(mask, diagram.edges, axis=0))


def _axis_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    return PlanarGraph._of_core(diagram.vertices, _core.axis_edges(diagram.arrays, mask))


def _one_step(diagram: Diagram) -> Skeleton:
    masks = _crust_masks(diagram)
    if "one-step" in masks:
        mask = masks["one-step"]
        crust, axis = _crust_graph(diagram, mask), _axis_graph(diagram, ~mask)
    else:
        mask, *drawn = _core.one_step(diagram.arrays)
        masks["one-step"] = _frozen(mask)
        crust, axis = PlanarGraph._of_core(diagram.sites, drawn[0]), PlanarGraph._of_core(diagram.vertices, drawn[1])
    return Skeleton(diagram, "one-step", crust, axis, mask, ~mask)


def _edge_filter(diagram: Diagram) -> Skeleton:
    masks = _crust_masks(diagram)
    if "two-pass" in masks:
        crust, axis = masks["two-pass"], _core.filtered_axis(diagram.arrays, _known(diagram))
    else:
        # Both at once are cheaper than one after the other.
        crust, axis = _core.edge_filter(diagram.arrays, _known(diagram))
        masks["two-pass"] = _frozen(crust)
    return Skeleton(diagram, "edge-filter", _crust_graph(diagram, crust), _axis_graph(diagram, axis), crust, axis)


def _poles(variant: str, diagram: Diagram) -> Skeleton:
    axis = PlanarGraph._of_core(diagram.vertices, _core.poles_axis(diagram.arrays, variant == "amenta"))
    return Skeleton(diagram, "poles", _crust_graph(diagram, _two_pass_mask(diagram)), axis, None, None)


def _initial(diagram: Diagram) -> Skeleton:
    axis = PlanarGraph._of_core(diagram.vertices, _core.initial(diagram.arrays))
    return Skeleton(diagram, "initial", _crust_graph(diagram, _two_pass_mask(diagram)), axis, None, None)
