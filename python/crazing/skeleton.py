"""Curves and skeletons of point samples."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing.arguments import choice
from crazing.diagram import Diagram, as_diagram
from crazing.graph import PlanarGraph
from crazing.record import Record

Mask: TypeAlias = NDArray[np.bool_]


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
        Which edges of the diagram are crust, and which dual edges are axis; None for `"initial"`, whose axis holds
        edges that are not dual. For `"one-step"` each is the complement of the other.
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
    method : {"two-pass", "one-step"}
        ``"two-pass"``: edges of the Delaunay triangulation of samples and Voronoi vertices that join two samples
        (Amenta, Bern, Eppstein 1998). ``"one-step"``: Delaunay edges with a circle through both ends that holds
        neither end of the dual edge (Gold, Snoeyink 2001); a superset, and much cheaper.

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
    masks: dict[str, Callable[[Diagram], Mask]] = {"two-pass": _two_pass_mask, "one-step": _one_step_mask}
    mask_of = masks[choice(method, "method", masks)]
    diagram = as_diagram(points)
    return _crust_graph(diagram, mask_of(diagram))


def medial_axis(points: ArrayLike | Diagram, *, method: str = "edge-filter") -> Skeleton:
    """Curve and medial axis (topological skeleton) of point samples.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram
        Samples of one or more curves.
    method : {"edge-filter", "one-step", "initial"}
        ``"initial"``: edges of the second Delaunay triangulation, of samples and Voronoi vertices, that join two
        Voronoi vertices. ``"edge-filter"``: those of them that are Voronoi edges (the thesis' own method).
        ``"one-step"``: the duals of all edges that are not one-step crust (Gold and Snoeyink's anti-crust).

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
    Source: thesis, sections 4.2, 5.2 and 5.3.

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
    }
    skeleton_of = methods[choice(method, "method", methods)]
    return skeleton_of(as_diagram(points))


def _one_step_mask(diagram: Diagram) -> Mask:
    return _core.one_step(diagram.arrays)


def _two_pass_mask(diagram: Diagram) -> Mask:
    return _core.two_pass(diagram.arrays)


def _crust_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    # Several times faster than indexing with the mask.
    return PlanarGraph(diagram.sites, np.compress(mask, diagram.edges, axis=0))


def _axis_graph(diagram: Diagram, mask: Mask) -> PlanarGraph:
    return PlanarGraph(diagram.vertices, _core.axis_edges(diagram.arrays, mask))


def _one_step(diagram: Diagram) -> Skeleton:
    mask = _one_step_mask(diagram)
    return Skeleton(diagram, "one-step", _crust_graph(diagram, mask), _axis_graph(diagram, ~mask), mask, ~mask)


def _edge_filter(diagram: Diagram) -> Skeleton:
    crust, axis = _core.edge_filter(diagram.arrays)
    return Skeleton(diagram, "edge-filter", _crust_graph(diagram, crust), _axis_graph(diagram, axis), crust, axis)


def _initial(diagram: Diagram) -> Skeleton:
    axis = PlanarGraph(diagram.vertices, _core.initial(diagram.arrays))
    return Skeleton(diagram, "initial", _crust_graph(diagram, _two_pass_mask(diagram)), axis, None, None)
