"""Figure 3.2: a Voronoi diagram and its duality with the Delaunay triangulation.

Left the cells; right both drawings over one another. Edge and dual edge are one row of the diagram: where a black
Voronoi edge parts two cells, the grey Delaunay edge of the same row joins their sites, at a right angle.
"""

import argparse
from pathlib import Path

from matplotlib.figure import Figure

import crazing as cz


def draw(d: cz.Diagram) -> Figure:
    figure = Figure(figsize=(9, 4.7), layout="constrained")
    bounds = (-0.1, -0.1, 1.1, 1.1)
    for ax, title in zip(figure.subplots(1, 2), ("Voronoi diagram", "and its dual"), strict=True):
        if title == "and its dual":
            d.delaunay.plot(ax, color="#b0b0b0", linewidth=0.8)
            ax.plot(*d.vertices.T, "o", color="#0072b2", markersize=2.5)
        d.voronoi(bounds).plot(ax, color="black", linewidth=1.1)
        ax.plot(*d.sites.T, "o", color="#d55e00", markersize=4)
        ax.set(title=title, xlim=bounds[::2], ylim=bounds[1::2])
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    d = cz.diagram(cz.sample.uniform(10 if given.small else 40, rng=3))
    draw(d).savefig(given.output / "figure_3_2.png", dpi=150)


if __name__ == "__main__":
    main()
