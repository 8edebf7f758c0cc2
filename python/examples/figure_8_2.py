"""Figure 8.2: nested curves of a star at the third iteration, the maze over them, and a part of it enlarged.

The Voronoi vertices of the samples join them, and again: that draws the star's axis, the axis between axis and
outline, and so on. As cells the points make a maze whose ways follow the shape: narrow in the corners, wide between.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.path import Path as Path2D
from numpy.typing import NDArray

import crazing as cz

WAY = "#d55e00"


def star(samples: int) -> NDArray[np.float64]:
    """Points at even distances along a five-pointed star, corners among them."""
    turn = np.pi / 2 + np.arange(10) * np.pi / 5
    radius = np.where(np.arange(10) % 2, 0.42, 1.0)
    corners = np.column_stack([radius * np.cos(turn), radius * np.sin(turn)])
    part = np.arange(samples // 10)[:, None] / (samples // 10)
    return np.concatenate([a + part * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)])


def inside(outline: NDArray[np.float64], graph: cz.PlanarGraph) -> cz.PlanarGraph:
    """The edges of a drawing that lie in the star."""
    middles = graph.segments.mean(axis=1)
    return cz.PlanarGraph(graph.vertices, graph.edges[Path2D(outline).contains_points(middles)])


def draw(samples: int) -> Figure:
    outline = star(samples)
    nested = cz.nested(outline, iterations=3)
    # The cells are those of the points whose axis is the third: samples, their axis, and the curves between.
    m = cz.maze(nested[-1].diagram, within=outline, rng=5)
    figure = Figure(figsize=(13.5, 4.9), layout="constrained")
    curves, whole, snippet = figure.subplots(1, 3)
    for s, color, width in zip(nested, ("#d55e00", "#009e73", "#0072b2"), (1.4, 0.9, 0.5), strict=True):
        inside(outline, s.axis).plot(curves, color=color, linewidth=width)
    curves.fill(*outline.T, facecolor="none", edgecolor="black", linewidth=1.2)
    curves.set(title="nested curves, to the third iteration", xlim=(-1.05, 1.05), ylim=(-0.9, 1.1))
    box = (0.02, 0.1, 0.5, 0.54)
    for ax, width in ((whole, 0.6), (snippet, 1.6)):
        m.walls.plot(ax, color="black", linewidth=width, capstyle="round")
        m.path(m.solve(*m.ends)).plot(ax, color=WAY, linewidth=1.3 * width)
    whole.add_patch(
        Rectangle(box[:2], box[2] - box[0], box[3] - box[1], fill=False, edgecolor="#0072b2", linewidth=1.4)
    )
    whole.set(title="their maze, and the way through it", xlim=(-1.05, 1.05), ylim=(-0.9, 1.1))
    snippet.set(title="enlarged", xlim=box[::2], ylim=box[1::2], xticks=[], yticks=[])
    for spine in snippet.spines.values():
        spine.set_color("#0072b2")
    for ax in (curves, whole):
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(40 if given.small else 240).savefig(given.output / "figure_8_2.png", dpi=150)


if __name__ == "__main__":
    main()
