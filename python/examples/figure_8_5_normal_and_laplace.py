"""Figure 8.5: crack patterns from 300 points, normal and Laplace.

Above as in the thesis, walls of one width; below ours on the same points, with the steps of the preset concrete-spall.
Cracks are fine and many at the source of the stress, and grow rare away from it; Laplace keeps some near the edges.
"""

import argparse
from pathlib import Path

from matplotlib.figure import Figure

import crazing as cz

BOUNDS = (-3.2, -3.2, 3.2, 3.2)


def draw(side: int) -> Figure:
    figure = Figure(figsize=(9, 9.4), layout="constrained")
    axes = figure.subplots(2, 2)
    for column, name in zip(axes.T, ("normal", "laplace"), strict=True):
        points = getattr(cz.sample, name)(300, rng=6)
        c = cz.crack(points, bounds=BOUNDS, rng=6)
        ours = cz.crack(points, preset="concrete-spall", source=(0, 0), bounds=BOUNDS, rng=6)
        even = cz.render(c.graph, side, bounds=c.bounds, style=cz.Style(width=0.02, ink="#000", ground="#fff"))
        for ax, picture, title in zip(column, (even, cz.render(ours, side)), ("walls", "ours"), strict=True):
            ax.imshow(picture)
            ax.set(title=f"{name}, 300 points, {title}", xticks=[], yticks=[])
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(128 if given.small else 1024).savefig(given.output / "figure_8_5.png", dpi=150)


if __name__ == "__main__":
    main()
