"""Figure 6.1: the edge-filtered axis of a maple leaf from 192, 209, 383 and 1043 points.

The first two sets lie on one contour, where brightness is 1 of 255; the other two on ten contours, 1 to 10 of 255, a
fraction of a pixel apart. A few points more change crust and axis; ten contours give neither a curve nor an axis of it.
"""

import argparse
from pathlib import Path

from leaf import picture
from matplotlib.figure import Figure

import crazing as cz

ONE, TEN = (1 / 255,), tuple(k / 255 for k in range(1, 11))


def draw(side: int) -> Figure:
    figure = Figure(figsize=(9, 9.4), layout="constrained")
    cases = zip(figure.subplots(2, 2).flat, ((192, ONE), (209, ONE), (383, TEN), (1043, TEN)), strict=True)
    for ax, (n, levels) in cases:
        s = cz.medial_axis(cz.sample.from_image(picture(side), level=levels, n=n))
        s.axis.plot(ax, color="#0072b2", linewidth=0.7)
        s.crust.plot(ax, color="black", linewidth=0.9)
        ax.set(title=f"{n} points, {len(levels)} level{'s'[: len(levels) > 1]}: {s.axis.components} pieces of axis")
        ax.set(xlim=(0, side), ylim=(0, side))
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(200 if given.small else 600).savefig(given.output / "figure_6_1.png", dpi=150)


if __name__ == "__main__":
    main()
