"""Diagrams, skeletons and cracks on Matplotlib axes; the colours are those of the figure of a comparison."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from crazing import strokes, vectors
from crazing.arguments import bounds_tuple
from crazing.extras import axes, require
from crazing.graph import PlanarGraph
from crazing.panels import CRUST, FIRST, SECOND, draw_lines, view_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crazing.crack import Crack
    from crazing.diagram import Diagram
    from crazing.skeleton import Skeleton


def diagram(
    drawn: Diagram, ax: Axes | None, *, delaunay: bool, voronoi: PlanarGraph | None, box: tuple[float, ...], style: Any
) -> Axes:
    """Draws one or both faces of a diagram; see `Diagram.plot`."""
    ax = axes(ax)
    parts: list[tuple[str, PlanarGraph, str]] = []
    if voronoi is not None:
        parts.append(("Voronoi", voronoi, FIRST))
    if delaunay:
        parts.append(("Delaunay", drawn.delaunay, SECOND))
        if drawn.constrained.any():
            parts.append(("constraints", PlanarGraph(drawn.sites, drawn.edges[drawn.constrained]), CRUST))
    for label, graph, color in parts:
        _lines(ax, graph, box, {"color": color, "linewidth": 0.8, "label": label} | style)
    return _shown(ax, box)


def skeleton(drawn: Skeleton, ax: Axes | None, *, bounds: ArrayLike | None, style: Any) -> Axes:
    """Draws crust and axis; see `Skeleton.plot`."""
    ax = axes(ax)
    box = tuple(view_of(drawn.diagram.sites).ravel().tolist()) if bounds is None else bounds_tuple(bounds)
    # The crust lies over the axis: where it has a gap, the gap is to be seen.
    for label, graph, color, order in (("axis", drawn.axis, FIRST, 2), ("crust", drawn.crust, CRUST, 3)):
        _lines(ax, graph, box, {"color": color, "linewidth": 1.0, "label": label, "zorder": order} | style)
    return _shown(ax, box)


def crack(drawn: Crack, ax: Axes | None, *, style: Any) -> Axes:
    """Fills the outlines of the strands; see `Crack.plot`."""
    ax = axes(ax)
    outlines = [outline for strand in strokes.strands(drawn) for outline in strokes.outlines(strand)]
    moves = vectors.copies(drawn, outlines)
    outlines = [outline + move for outline, each in zip(outlines, moves, strict=True) for move in each]
    own = {} if "color" in style else {"facecolor": CRUST, "edgecolor": "none"}
    polygons = require("matplotlib.collections", "plot").PolyCollection(outlines, **own | {"linewidth": 0} | style)
    ax.add_collection(polygons, autolim=False)
    if drawn.period is not None:
        xmin, ymin, xmax, ymax = drawn.bounds
        rectangle = require("matplotlib.patches", "plot").Rectangle
        polygons.set_clip_path(rectangle((xmin, ymin), xmax - xmin, ymax - ymin, transform=ax.transData))
    return _shown(ax, drawn.bounds)


def _lines(ax: Axes, graph: PlanarGraph, box: tuple[float, ...], style: dict[str, Any]) -> None:
    draw_lines(ax, graph, np.reshape(box, (2, 2)), **style)


def _shown(ax: Axes, box: tuple[float, ...]) -> Axes:
    """The axes, at equal scales and wide enough for a box: what lies beyond, often far, is not looked for."""
    ax.update_datalim(np.reshape(box, (2, 2)))
    ax.set_aspect("equal")
    ax.autoscale_view()
    return ax
