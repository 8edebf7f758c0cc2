"""Figure 4.1: the steps of the crust algorithm.

Samples of a curve; their Voronoi diagram; the triangulation of samples and Voronoi vertices together; and the crust,
the edges of that triangulation which join two samples.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz


def curve(n: int) -> NDArray[np.float64]:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    radius = 1 + 0.28 * np.cos(3 * t) + 0.1 * np.sin(5 * t)
    return radius[:, None] * np.stack([np.cos(t), np.sin(t)], axis=1)


def draw(points: NDArray[np.float64]) -> Figure:
    d = cz.diagram(points)
    window = (-1.5, -1.5, 1.5, 1.5)
    steps = {
        "samples": None,
        "Voronoi diagram": d.voronoi(window),
        "samples and vertices, triangulated": cz.diagram(np.concatenate([d.sites, d.vertices])).delaunay,
        "crust": cz.crust(d),
    }
    figure = Figure(figsize=(12, 3.4), layout="constrained")
    for ax, (title, graph) in zip(figure.subplots(1, 4), steps.items(), strict=True):
        if graph is not None:
            graph.plot(ax, color="black", linewidth=1.6 if title == "crust" else 0.6)
        if graph is not None and title != "crust":
            ax.plot(*d.vertices.T, "o", color="#0072b2", markersize=2.5)
        ax.plot(*d.sites.T, "o", color="#d55e00", markersize=3, zorder=3)
        ax.set(title=title, xlim=window[::2], ylim=window[1::2], aspect="equal")
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(curve(24 if given.small else 48)).savefig(given.output / "figure_4_1.png", dpi=150)


if __name__ == "__main__":
    main()
