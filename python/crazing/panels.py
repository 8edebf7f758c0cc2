"""The figure of a comparison."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from crazing.extras import require
from crazing.graph import PlanarGraph

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from crazing.compare import Comparison

# M. Okabe and K. Ito, Color Universal Design, 2008: vermilion, blue, black; and greys beside them.
FIRST, SECOND, CRUST = "#d55e00", "#0072b2", "#000000"
SHARED, SAMPLE, FAINT = "#8c8c8c", "#4d4d4d", "#d0d0d0"

#: Part of the longer side that is shown around the samples.
MARGIN = 0.05

#: Points across of a dot in the legend.
LEGEND_DOT = 4.0


def draw(comparison: Comparison, axes: Sequence[Axes] | NDArray[np.object_] | None) -> NDArray[np.object_]:
    """Draws the three panels; see `Comparison.plot`."""
    panels = np.atleast_1d(_row() if axes is None else np.asarray(axes, dtype=object))
    if panels.shape != (3,):
        raise ValueError(f"axes has shape {panels.shape}; three axes are wanted")
    view = _view(comparison.first.diagram.sites)
    pen = _pen(len(comparison.first.diagram.sites))
    for ax, skeleton, color in zip(panels, (comparison.first, comparison.second), (FIRST, SECOND), strict=False):
        _samples(ax, comparison, SAMPLE)
        _lines(ax, skeleton.crust, view, color=CRUST, linewidth=pen, label="crust")
        _lines(ax, skeleton.axis, view, color=color, linewidth=pen, label="axis")
        _finish(ax, skeleton.method, view, len(skeleton.diagram.sites))
    _overlay(panels[2], comparison, view, pen)
    return panels


def _overlay(ax: Axes, comparison: Comparison, view: NDArray[np.float64], pen: float) -> None:
    """Both axes; what only one has lies over what they share, and is wider."""
    _samples(ax, comparison, FAINT)
    first, second = comparison.first.method, comparison.second.method
    _lines(ax, comparison.shared, view, color=SHARED, linewidth=0.8 * pen, label="in both axes")
    _lines(ax, comparison.only_first, view, color=FIRST, linewidth=1.2 * pen, label=f"only {first}")
    _lines(ax, comparison.only_second, view, color=SECOND, linewidth=1.2 * pen, label=f"only {second}")
    _finish(ax, "both", view, len(comparison.first.diagram.sites))


def _row() -> Any:
    return require("matplotlib.pyplot", "plot").subplots(1, 3, figsize=(13, 5), layout="constrained")[1]


def _view(sites: NDArray[np.float64]) -> NDArray[np.float64]:
    """[[xmin, ymin], [xmax, ymax]] of what is shown."""
    box = np.array([sites.min(axis=0), sites.max(axis=0)])
    margin = MARGIN * float((box[1] - box[0]).max())
    box += np.array([[-margin], [margin]])
    return box


def _samples(ax: Axes, comparison: Comparison, color: str) -> None:
    sites = comparison.first.diagram.sites
    size = _dot(len(sites))
    style: dict[str, Any] = {"linestyle": "none", "marker": "o", "markersize": size, "markeredgewidth": 0.0}
    ax.plot(*sites.T, label=f"samples ({len(sites)})", color=color, zorder=1, **style)


def _pen(samples: int) -> float:
    """Points across a line; finer where there are many, so that they do not run together."""
    return float(np.clip(45.0 / np.sqrt(samples), 0.25, 1.0))


def _dot(samples: int) -> float:
    """Points across; they shrink with their number, so that neighbours on a curve stay apart."""
    return float(np.clip(60.0 / np.sqrt(samples), 0.4, 4.0))


def _lines(ax: Axes, graph: PlanarGraph, view: NDArray[np.float64], *, label: str, **style: Any) -> None:
    """The edges whose boxes meet the view; the rest, often far away, would cost time and be cut off."""
    segments = graph.segments
    meets = (segments.max(axis=1) >= view[0]).all(axis=1) & (segments.min(axis=1) <= view[1]).all(axis=1)
    # Polylines are several times fewer than edges, and drawn in proportion.
    coords, offsets = PlanarGraph(graph.vertices, graph.edges[meets]).polylines()
    lines = require("matplotlib.collections", "plot").LineCollection(
        np.split(coords, offsets[1:-1]) if len(offsets) > 1 else [],
        label=f"{label} ({len(segments)})",
        capstyle="round",
        joinstyle="round",
        zorder=2,
        **style,
    )
    ax.add_collection(lines, autolim=False)


def _finish(ax: Axes, title: str, view: NDArray[np.float64], samples: int) -> None:
    ax.set(title=title, xticks=[], yticks=[], aspect="equal")
    ax.set(xlim=tuple(view[:, 0]), ylim=tuple(view[:, 1]))
    for spine in ax.spines.values():
        spine.set(color=FAINT, linewidth=0.6)
    # In the legend dots and lines are as large as can be seen, whatever they are in the picture.
    scale = LEGEND_DOT / _dot(samples)
    place: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.02), "ncols": 2}
    legend = ax.legend(**place, frameon=False, fontsize="small", markerscale=scale)
    for line in legend.get_lines():
        line.set_linewidth(1.8)
