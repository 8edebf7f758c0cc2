"""Figure 4.2: the initial approximation of the medial axis.

Edges of the second triangulation that join two Voronoi vertices. They follow the axis, but many make small triangles
across it, where the vertices of neighbouring samples lie close together.
"""

import argparse
from pathlib import Path

from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def draw(s: cz.Skeleton) -> Figure:
    figure = Figure(figsize=(5, 5), layout="constrained")
    ax = s.axis.plot(figure.subplots(), color="#0072b2", linewidth=0.8)
    s.crust.plot(ax, color="black", linewidth=1.2)
    ax.plot(*s.diagram.sites.T, "o", color="#d55e00", markersize=3, zorder=3)
    ax.set(title=f"initial medial axis, {len(s.axis.edges)} edges", xlim=(-1.6, 1.6), ylim=(-1.6, 1.6))
    ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(cz.medial_axis(curve(40 if given.small else 120), method="initial")).savefig(
        given.output / "figure_4_2.png", dpi=150
    )


if __name__ == "__main__":
    main()
