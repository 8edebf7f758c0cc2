"""Figure 3.1: a Delaunay triangulation.

No circle through the corners of a triangle holds another site. Four such circles are drawn, with their centres, which
are Voronoi vertices.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

import crazing as cz


def draw(d: cz.Diagram) -> Figure:
    figure = Figure(figsize=(5, 5), layout="constrained")
    ax = d.delaunay.plot(figure.subplots(), color="black", linewidth=0.9)
    radius = np.hypot(*(d.sites[d.triangles[:, 0]] - d.vertices).T)
    for corner in ((0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)):
        i = np.argmin(np.hypot(*(d.vertices - corner).T))
        ax.add_patch(Circle(d.vertices[i], radius[i], fill=False, color="#0072b2", linewidth=0.8))
        ax.plot(*d.vertices[i], "+", color="#0072b2", markersize=5)
    ax.plot(*d.sites.T, "o", color="#d55e00", markersize=4)
    ax.set(title=f"Delaunay triangulation of {len(d.sites)} sites", xlim=(-0.03, 1.03), ylim=(-0.03, 1.03))
    ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    d = cz.diagram(cz.sample.uniform(10 if given.small else 40, rng=3))
    draw(d).savefig(given.output / "figure_3_1.png", dpi=150)


if __name__ == "__main__":
    main()
