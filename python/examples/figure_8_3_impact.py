"""Figure 8.3: the crack of a blow, which the thesis shows from a simulation on a mesh of 4094 triangles.

Left the thesis' pattern on 300 Laplace points; then ours at the same density: concrete spalled by a blow, and glass,
with straight spokes as many as the square root of the speed says and arcs between them.
"""

import argparse
from pathlib import Path

from matplotlib.figure import Figure

import crazing as cz

BOUNDS = (-3.2, -3.2, 3.2, 3.2)


def draw(side: int) -> Figure:
    walls = cz.crack(cz.sample.laplace(300, rng=6), bounds=BOUNDS, rng=6)
    style = cz.Style(width=0.02, ink="#000", ground="#fff")
    pictures = {"300 Laplace points: walls": cz.render(walls.graph, side, bounds=BOUNDS, style=style)}
    for name in ("concrete-spall", "glass-impact"):
        pictures[f"{name}, 300 plates"] = cz.render(cz.crack(preset=name, n=300, bounds=BOUNDS, rng=6), side)
    figure = Figure(figsize=(13, 4.8), layout="constrained")
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
    draw(128 if given.small else 1024).savefig(given.output / "figure_8_3.png", dpi=150)


if __name__ == "__main__":
    main()
