"""A sheet of textures: every distribution of points by three shares of opened passages.

To the right more doors of the maze are opened: from closed plates, as in a glaze, to the trees of the thesis. All are
drawn from one seed, with `crazing.render` alone.
"""

import argparse
from pathlib import Path

from matplotlib.figure import Figure

import crazing as cz

OPENINGS = (0.3, 0.7, 1.0)
REACH = {"uniform": 0.5, "normal": 2.2, "laplace": 2.5}


def pattern(name: str, opening: float) -> cz.Crack:
    reach = REACH[name]
    bounds = (-reach, -reach, reach, reach)
    points = {
        "uniform": cz.sample.uniform(250, bounds=bounds, rng=3),
        "normal": cz.sample.normal(400, rng=3),
        "laplace": cz.sample.laplace(400, rng=3),
    }
    return cz.crack(points[name], opening=opening, bounds=bounds, rng=3)


def draw(side: int) -> Figure:
    figure = Figure(figsize=(9, 9.4), layout="constrained")
    for row, name in zip(figure.subplots(3, 3), REACH, strict=True):
        for ax, opening in zip(row, OPENINGS, strict=True):
            ax.imshow(cz.render(pattern(name, opening), side))
            ax.set(title=f"{name}, opening {opening}", xticks=[], yticks=[])
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(96 if given.small else 640).savefig(given.output / "texture_sheet.png", dpi=150)


if __name__ == "__main__":
    main()
