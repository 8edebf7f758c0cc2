"""Figure 7.1: a Voronoi diagram and one of its mazes, with the way through it.

Every cell can be reached from every other, by one way. The red line runs from site to site through the middles of
the doors that are open.
"""

import argparse
from itertools import pairwise
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz

BOUNDS = (-0.05, -0.05, 1.05, 1.05)


def passage(d: cz.Diagram, a: int, b: int) -> NDArray[np.float64]:
    """A way from site `a` to site `b` through the middle of what the bounds leave of the wall between them."""
    k = np.flatnonzero((d.edges == sorted((a, b))).all(axis=1) | (d.edges == sorted((a, b))[::-1]).all(axis=1))[0]
    right, left = d.dual_edges[k]
    start, (x, y) = d.vertices[right], d.sites[d.edges[k, 1]] - d.sites[d.edges[k, 0]]
    # An edge of the hull has infinity on its left.
    end = d.vertices[left] if left >= 0 else start + 9 * np.array([-y, x])
    wall = np.linspace(start, end, 10_001)
    wall = wall[((wall > BOUNDS[:2]) & (wall < BOUNDS[2:])).all(axis=1)]
    return np.array([d.sites[a], wall[len(wall) // 2]])


def draw(n: int) -> Figure:
    d = cz.diagram(cz.sample.uniform(n, rng=2))
    m = cz.maze(d, bounds=BOUNDS, rng=2)
    first, last = (int(np.argmin(np.hypot(*(d.sites - corner).T))) for corner in ((0.1, 0.9), (0.9, 0.1)))
    steps = m.solve(first, last).tolist()
    way = np.concatenate([passage(d, *step) for step in pairwise(steps)] + [d.sites[[last]]])
    figure = Figure(figsize=(13, 4.7), layout="constrained")
    for ax, title in zip(figure.subplots(1, 3), ("Voronoi diagram", "maze", "and its solution"), strict=True):
        lines = d.voronoi(BOUNDS) if title == "Voronoi diagram" else m.walls
        lines.plot(ax, color="black", linewidth=1.2, capstyle="round")
        ax.plot(*np.array(BOUNDS)[[[0, 2, 2, 0, 0], [1, 1, 3, 3, 1]]], color="black", linewidth=1.2)
        if title == "and its solution":
            ax.plot(*way.T, color="#d55e00", linewidth=1.6, solid_joinstyle="round")
            ax.plot(*way[[0, -1]].T, "o", color="#d55e00", markersize=5)
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
