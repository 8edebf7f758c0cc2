"""Figure 7.1: a Voronoi diagram and one of its mazes, with the way through it.

Every cell can be reached from every other, by one way. The red line runs through the middles of the open doors.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import crazing as cz

BOUNDS = (-0.05, -0.05, 1.05, 1.05)


def draw(n: int) -> Figure:
    d = cz.diagram(cz.sample.uniform(n, rng=2))
    # Within the frame, not clipped to it: no door lies beyond.
    m = cz.maze(d, within=np.array(BOUNDS)[[[0, 1], [2, 1], [2, 3], [0, 3]]], rng=2)
    first, last = (int(np.argmin(np.hypot(*(d.sites - corner).T))) for corner in ((0.1, 0.9), (0.9, 0.1)))
    way = m.path(m.solve(first, last))
    figure = Figure(figsize=(13, 4.7), layout="constrained")
    for ax, title in zip(figure.subplots(1, 3), ("Voronoi diagram", "maze", "and its solution"), strict=True):
        lines = d.voronoi(BOUNDS) if title == "Voronoi diagram" else m.walls
        lines.plot(ax, color="black", linewidth=1.2, capstyle="round")
        ax.plot(*np.array(BOUNDS)[[[0, 2, 2, 0, 0], [1, 1, 3, 3, 1]]], color="black", linewidth=1.2)
        if title == "and its solution":
            way.plot(ax, color="#d55e00", linewidth=1.6, joinstyle="round")
            ax.plot(*d.sites[[first, last]].T, "o", color="#d55e00", markersize=5)
        ax.set(title=title, xlim=(-0.06, 1.06), ylim=(-0.06, 1.06))
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(30 if given.small else 250).savefig(given.output / "figure_7_1.png", dpi=150)


if __name__ == "__main__":
    main()
