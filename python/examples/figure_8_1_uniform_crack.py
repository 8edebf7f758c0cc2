"""Figure 8.1: a crack pattern from 75 random points, and dried mud.

Left as in the thesis, the walls of a Voronoi maze; in the middle the same walls with widths; right ours at the same
density, 75 plates of the preset mud-fresh: what the thesis set its pattern beside was a picture of dried mud.
"""

import argparse
from pathlib import Path

from matplotlib.figure import Figure

import crazing as cz


def draw(side: int) -> Figure:
    c = cz.crack(n=75, rng=8)
    figure = Figure(figsize=(13, 4.8), layout="constrained")
    thesis = cz.render(c.graph, side, bounds=c.bounds, style=cz.Style(width=0.004, ink="#000", ground="#fff"))
    pictures = {
        "75 random points: walls": thesis,
        "the same, with widths": cz.render(c, side),
        "75 plates of the preset mud-fresh": cz.render(cz.crack(preset="mud-fresh", n=75, rng=8), side),
    }
    for ax, (title, picture) in zip(figure.subplots(1, 3), pictures.items(), strict=True):
        ax.imshow(picture)
        ax.set(title=title, xticks=[], yticks=[])
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(128 if given.small else 1024).savefig(given.output / "figure_8_1.png", dpi=150)


if __name__ == "__main__":
    main()
