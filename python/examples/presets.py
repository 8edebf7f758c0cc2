"""Every preset beside the thesis' pattern at the same density: as many plates, the walls of their maze, one width.

With --period the presets are made on a torus and shown over 2 x 2 periods.
"""

import argparse
from pathlib import Path
from types import SimpleNamespace

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz

COLUMNS = 4


def picture(c: cz.Crack, side: int, periods: int = 1) -> NDArray[np.uint8]:
    """The crack with its widths; on a torus so many periods each way."""
    if c.period is None:
        return cz.render(c, side)
    around = range(-1, periods + 1)
    copies = [c.segments + np.multiply((a, b), c.period) for a in around for b in around]
    ends = np.concatenate(copies).reshape(-1, 2)
    graph = SimpleNamespace(vertices=ends, edges=np.arange(len(ends)).reshape(-1, 2))
    bounds = (0.0, 0.0, periods * c.period[0], periods * c.period[1])
    return cz.render(SimpleNamespace(graph=graph, width=np.tile(c.width, (len(copies), 1)), bounds=bounds), side)


def thesis(n: int, side: int) -> NDArray[np.uint8]:
    c = cz.crack(n=n, rng=8)
    return cz.render(c.graph, side, bounds=c.bounds, style=cz.Style(width=0.004, ink="#000", ground="#fff"))


def draw(side: int, periodic: bool) -> Figure:
    names = cz.presets()
    rows = -(-len(names) // COLUMNS)
    figure = Figure(figsize=(5 * COLUMNS, 2.75 * rows), layout="constrained")
    axes = figure.subplots(rows, 2 * COLUMNS)
    for ax in axes.ravel():
        ax.set(xticks=[], yticks=[], frame_on=False)
    for name, (left, right) in zip(names, axes.reshape(-1, 2), strict=False):
        recipe = cz.preset(name)
        c = recipe.crack(period=(1, 1) if periodic else None, rng=8)
        left.imshow(thesis(recipe.n, side))
        left.set_title(f"thesis, {recipe.n} points", fontsize=8)
        right.imshow(picture(c, side, 2 if periodic else 1))
        right.set_title(name, fontsize=8)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("--period", action="store_true", help="on a torus, 2 x 2 periods")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(96 if given.small else 512, given.period).savefig(given.output / "presets.png", dpi=60 if given.small else 130)


if __name__ == "__main__":
    main()
