"""The figure of a comparison."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from crazing import arguments
from crazing.extras import require
from crazing.graph import PlanarGraph

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from crazing.compare import Comparison

# M. Okabe and K. Ito, Color Universal Design, 2008: vermilion, blue, black; and greys beside them.
FIRST, SECOND, CRUST = "#d55e00", "#0072b2", "#000000"
SHARED, SAMPLE, FAINT = "#8c8c8c", "#4d4d4d", "#d0d0d0"

#: Part of the longer side that is shown around the samples.
MARGIN = 0.05

#: Points across of a dot in the legend.
LEGEND_DOT = 4.0

#: Width of the figure in inches: three panels across a page of two columns, readable at half its size.
INCHES = 13.0

#: Inches above the panels for a title, below them for a legend, and between them.
TITLE, LEGEND, GAP = 0.34, 0.62, 0.08


def draw(comparison: Comparison, axes: Sequence[Axes] | NDArray[np.object_] | None) -> NDArray[np.object_]:
    """Draws the three panels; see `Comparison.plot`."""
    if axes is None:
        axes = row(comparison, require("matplotlib.pyplot", "plot").figure)
    panels = np.atleast_1d(np.asarray(axes, dtype=object))
    if panels.shape != (3,):
        raise ValueError(f"axes has shape {panels.shape}; three axes are wanted")
    if not all(hasattr(ax, "add_collection") for ax in panels):
        raise TypeError(f"axes is {arguments.found(axes)}; three axes of Matplotlib are wanted")
    view = view_of(comparison.first.diagram.sites)
    sites = comparison.first.diagram.sites
    pen, dot = _pen(len(sites)), _dot(comparison, view)
    for ax, skeleton, color in zip(panels, (comparison.first, comparison.second), (FIRST, SECOND), strict=False):
        axis = skeleton.axis
        _samples(ax, sites, SAMPLE, dot)
        # The crust lies over the axis: where it has a gap, the gap is to be seen.
        draw_lines(
            ax,
            skeleton.crust,
            view,
            color=CRUST,
            linewidth=1.2 * pen,
            zorder=3,
            label=f"crust ({_edges(skeleton.crust)})",
        )
        draw_lines(ax, axis, view, color=color, linewidth=pen, label=f"axis ({_edges(axis)}, {_pieces(axis)})")
        _finish(ax, skeleton.method, view, dot)
    _overlay(panels[2], comparison, view, pen, dot)
    return panels


def row(comparison: Comparison, make: Callable[..., Figure]) -> NDArray[np.object_]:
    """Three panels on a figure as high as they need; `make` takes its size."""
    width, height = np.diff(view_of(comparison.first.diagram.sites), axis=0)[0]
    panel = (INCHES - 4 * GAP) / 3
    whole = TITLE + panel * float(np.clip(height / width, 0.2, 2.0)) + LEGEND
    # Placed to the inch: Matplotlib's own layouts leave white around panels of a fixed aspect.
    places = {"left": GAP / INCHES, "right": 1 - GAP / INCHES, "wspace": GAP / panel}
    places |= {"bottom": LEGEND / whole, "top": 1 - TITLE / whole}
    panels: NDArray[np.object_] = make(figsize=(INCHES, whole)).subplots(1, 3, gridspec_kw=places)
    return panels


def _overlay(ax: Axes, comparison: Comparison, view: NDArray[np.float64], pen: float, dot: float) -> None:
    """Both axes; what only one has lies over what they share, and is wider."""
    _samples(ax, comparison.first.diagram.sites, FAINT, dot)
    draw_lines(ax, comparison.first.crust, view, color=FAINT, linewidth=0.8 * pen, zorder=1)
    parts = {
        "in both axes": (comparison.shared, SHARED, 0.8),
        f"only {comparison.first.method}": (comparison.only_first, FIRST, 1.4),
        f"only {comparison.second.method}": (comparison.only_second, SECOND, 1.4),
    }
    for name, (graph, color, weight) in parts.items():
        draw_lines(ax, graph, view, color=color, linewidth=weight * pen, label=f"{name} ({len(graph.edges)})")
    _finish(ax, "both", view, dot)


def _edges(graph: PlanarGraph) -> str:
    return f"{len(graph.edges)} edge{'s' * (len(graph.edges) != 1)}"


def _pieces(graph: PlanarGraph) -> str:
    return f"{graph.components} piece{'s' * (graph.components != 1)}"


def view_of(sites: NDArray[np.float64]) -> NDArray[np.float64]:
    """[[xmin, ymin], [xmax, ymax]] of what is shown."""
    box = np.array([sites.min(axis=0), sites.max(axis=0)])
    margin = MARGIN * float((box[1] - box[0]).max())
    box += np.array([[-margin], [margin]])
    return box


def _samples(ax: Axes, sites: NDArray[np.float64], color: str, dot: float) -> None:
    style: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": dot, "markeredgewidth": 0.0}
    ax.plot(*sites.T, label=f"samples ({len(sites)})", color=color, zorder=1, **style)


def _pen(samples: int) -> float:
    """Points across a line; finer where there are many, so that they do not run together."""
    return float(np.clip(45.0 / np.sqrt(samples), 0.25, 1.0))


def _dot(comparison: Comparison, view: NDArray[np.float64]) -> float:
    """Points across; half as far as neighbours on the curve are apart, so that dots do not run together."""
    lengths = comparison.first.crust.lengths
    apart = float(np.median(lengths)) / float((view[1] - view[0]).max()) if len(lengths) else 0.0
    # A panel of our own figure is 4 inches across, 72 points each.
    return float(np.clip(0.5 * apart * 288, 0.4, 3.0))


def draw_lines(ax: Axes, graph: PlanarGraph, view: NDArray[np.float64], **style: Any) -> None:
    """The edges whose boxes meet the view; the rest, often far away, would cost time and be cut off."""
    segments = graph.segments
    meets = (segments.max(axis=1) >= view[0]).all(axis=1) & (segments.min(axis=1) <= view[1]).all(axis=1)
    # Polylines are several times fewer than edges, and drawn in proportion.
    coords, offsets = PlanarGraph(graph.vertices, graph.edges[meets]).polylines()
    lines = require("matplotlib.collections", "plot").LineCollection(
        np.split(coords, offsets[1:-1]) if len(offsets) > 1 else [],
        capstyle="round",
        joinstyle="round",
        **{"zorder": 2, **style},
    )
    ax.add_collection(lines, autolim=False)


def _finish(ax: Axes, title: str, view: NDArray[np.float64], dot: float) -> None:
    ax.set(title=title, xticks=[], yticks=[], aspect="equal")
    ax.set(xlim=tuple(view[:, 0]), ylim=tuple(view[:, 1]))
    for spine in ax.spines.values():
        spine.set(color=FAINT, linewidth=0.6)
    # In the legend dots and lines are as large as can be seen, whatever they are in the picture.
    scale = LEGEND_DOT / dot
    place: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, 0.0), "ncols": 2}
    legend = ax.legend(**place, frameon=False, fontsize="small", markerscale=scale)
    for line in legend.get_lines():
        line.set_linewidth(1.8)
