"""Figure 7.2: a Delaunay triangulation and one of its mazes, with the way through it.

The cells are triangles now, the same search with the two columns of the edge table exchanged. Corners are sharp, as
the thesis says: a Voronoi maze makes the better crack.
"""

import argparse
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import crazing as cz


def draw(n: int) -> Figure:
    d = cz.diagram(cz.sample.uniform(n, rng=4))
    m = cz.maze(d, cells="delaunay", rng=4)
    middles = d.sites[d.triangles].mean(axis=1)
    first, last = (int(np.argmin(np.hypot(*(middles - corner).T))) for corner in ((0, 1), (1, 0)))
    steps = m.solve(first, last)
    # Through the middle of the side that two neighbouring triangles share.
    doors = [d.sites[np.intersect1d(*d.triangles[[a, b]])].mean(axis=0) for a, b in pairwise(steps)]
    way = np.stack([middles[steps[:-1]], doors], axis=1).reshape(-1, 2)
    way = np.concatenate([way, middles[[last]]])
    figure = Figure(figsize=(13, 4.7), layout="constrained")
    for ax, title in zip(figure.subplots(1, 3), ("Delaunay triangulation", "maze", "and its solution"), strict=True):
        lines = d.delaunay if title == "Delaunay triangulation" else m.walls
        lines.plot(ax, color="black", linewidth=1.2, capstyle="round")
        if title == "and its solution":
            ax.plot(*way.T, color="#d55e00", linewidth=1.6, solid_joinstyle="round")
            ax.plot(*way[[0, -1]].T, "o", color="#d55e00", markersize=5)
        ax.set(title=title, xlim=(-0.01, 1.01), ylim=(-0.01, 1.01))
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(30 if given.small else 150).savefig(given.output / "figure_7_2.png", dpi=150)


if __name__ == "__main__":
    main()
