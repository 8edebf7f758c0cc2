"""Curves and skeletons of point samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing.arguments import choice, count, real_array
from crazing.diagram import Diagram, as_diagram
from crazing.graph import PlanarGraph
from crazing.record import Record

Mask: TypeAlias = NDArray[np.bool_]

#: Methods of `crust`, and ways to choose poles.
CRUSTS = ("two-pass", "one-step", "gabriel", "nn")
VARIANTS = ("thesis", "amenta")


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
    mask = _two_pass_mask(diagram) if method == "two-pass" else _core.crust_mask(diagram.arrays, method)
    return _crust_graph(diagram, mask)


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
    methods: dict[str, Callable[[Diagram], Skeleton]] = {
        "edge-filter": _edge_filter,
        "one-step": _one_step,
        "initial": _initial,
        "poles": partial(_poles, choice(variant, "variant", VARIANTS)),
    }
    skeleton_of = methods[choice(method, "method", methods)]
    return skeleton_of(as_diagram(points))


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
    away. Source: thesis, sections 4.2 and 5.2.

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
        diagram = as_diagram(np.concatenate([diagram.sites, _fed_back(diagram, within)]))
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


def _one_step_mask(diagram: Diagram) -> Mask:
    return _core.crust_mask(diagram.arrays, "one-step")


def _two_pass_mask(diagram: Diagram) -> Mask:
    return _core.second(diagram.arrays)[0]


def _crust_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    return PlanarGraph(diagram.sites, diagram.edges[mask])


def _axis_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    return PlanarGraph(diagram.vertices, _core.axis_edges(diagram.arrays, mask))


def _one_step(diagram: Diagram) -> Skeleton:
    mask = _one_step_mask(diagram)
    return Skeleton(diagram, "one-step", _crust_graph(diagram, mask), _axis_graph(diagram, ~mask), mask, ~mask)


def _edge_filter(diagram: Diagram) -> Skeleton:
    crust, _, axis = _core.second(diagram.arrays)
    return Skeleton(diagram, "edge-filter", _crust_graph(diagram, crust), _axis_graph(diagram, axis), crust, axis)


def _poles(variant: str, diagram: Diagram) -> Skeleton:
    axis = PlanarGraph(diagram.vertices, _core.poles_axis(diagram.arrays, variant == "amenta"))
    return Skeleton(diagram, "poles", _crust_graph(diagram, _two_pass_mask(diagram)), axis, None, None)


def _initial(diagram: Diagram) -> Skeleton:
    crust, edges, _ = _core.second(diagram.arrays)
    axis = PlanarGraph(diagram.vertices, edges)
    return Skeleton(diagram, "initial", _crust_graph(diagram, crust), axis, None, None)
