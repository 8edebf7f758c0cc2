"""Figure 5.8: the one-step skeleton against edge filtering, on a maple leaf.

One-step keeps the axis together, with a hair wherever the outline is not quite smooth. The edge filter looks cleaner
because it drops edges: some hairs go, of others a piece stays behind, cut off, and outside true branches are cut too.
"""

import argparse
from pathlib import Path

from leaf import picture
from matplotlib.figure import Figure

import crazing as cz


def draw(comparison: cz.Comparison) -> Figure:
    figure = Figure(figsize=(13, 5))
    places = {"left": 0.006, "right": 0.994, "bottom": 0.13, "top": 0.93, "wspace": 0.02}
    comparison.plot(figure.subplots(1, 3, gridspec_kw=places))
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(cz.compare(cz.sample.from_image(picture(), n=200 if given.small else 600))).savefig(
        given.output / "figure_5_8.png", dpi=150
    )


if __name__ == "__main__":
    main()
