"""Figure 5.4: the medial axis before and after edge filtering, of a closed curve and of scattered points.

Of the curve the filter leaves a clean tree inside and the branches outside. Of points that follow no curve it leaves
branches too, and here and there drops an edge that held them together.
"""

import argparse
from pathlib import Path

import numpy as np
from figure_4_1_crust_steps import curve
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz


def panel(ax: Axes, s: cz.Skeleton, reach: float) -> None:
    s.axis.plot(ax, color="#0072b2", linewidth=0.8)
    s.crust.plot(ax, color="black", linewidth=1.0)
    ax.plot(*s.diagram.sites.T, "o", color="#d55e00", markersize=2.5, zorder=3)
    middle = s.diagram.sites.mean(axis=0)
    ax.set(title=f"{s.method}: {len(s.axis.edges)} edges, {s.axis.components} pieces")
    ax.set(xlim=middle[0] + (-reach, reach), ylim=middle[1] + (-reach, reach))
    ax.set_axis_off()


def draw(clouds: list[NDArray[np.float64]], reaches: tuple[float, float]) -> Figure:
    figure = Figure(figsize=(9, 9.2), layout="constrained")
    for row, points, reach in zip(figure.subplots(2, 2), clouds, reaches, strict=True):
        for ax, method in zip(row, ("initial", "edge-filter"), strict=True):
            panel(ax, cz.medial_axis(points, method=method), reach)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw([curve(40 if given.small else 120), cz.sample.uniform(100, rng=5)], (1.6, 0.6)).savefig(
        given.output / "figure_5_4.png", dpi=150
    )


if __name__ == "__main__":
    main()
