"""Figure 6.2: medial axes of a river network and of a glial cell.

The axis outside a river runs along its watersheds, the axis outside a cell where its neighbours would meet it. Without
pictures of your own (`--river`, `--cell`: bright on dark), the river is the branching wall of a maze and the cell a
star with arms, both drawn by the library.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz
from crazing.images import read_image

WHITE_ON_BLACK = cz.Style(ink="#fff", ground="#000", min_width=3)


def river() -> NDArray[np.uint8]:
    return cz.render(cz.crack(n=60, width=0.02, rng=12), 600, style=WHITE_ON_BLACK)


def cell(arms: int = 9) -> NDArray[np.uint8]:
    turn = np.linspace(0, 2 * np.pi, arms, endpoint=False)
    bend = turn + np.where(np.arange(arms) % 2, 0.25, -0.2)
    rings = [r * np.stack([np.cos(a), np.sin(a)], axis=1) for r, a in ((0.05, turn), (0.25, turn), (0.42, bend))]
    rows = np.arange(arms)
    edges = np.stack([np.concatenate([rows, rows + arms]), np.concatenate([rows, rows + arms]) + arms], axis=1)
    body = np.stack([rows, np.roll(rows, -1)], axis=1)
    graph = cz.PlanarGraph(np.concatenate(rings), np.concatenate([body, edges]))
    width = np.concatenate(
        [np.full((arms, 2), 0.12), np.full((arms, 2), (0.06, 0.03)), np.full((arms, 2), (0.03, 0.005))]
    )
    none = np.zeros(len(width), dtype=np.int32)
    return cz.render(cz.Crack(graph, width, none, none, (-0.5, -0.5, 0.5, 0.5)), 600, style=WHITE_ON_BLACK)


def draw(pictures: dict[str, NDArray[np.uint8]], n: int) -> Figure:
    figure = Figure(figsize=(11, 5.8), layout="constrained")
    for ax, (name, image) in zip(figure.subplots(1, 2), pictures.items(), strict=True):
        s = cz.medial_axis(cz.sample.from_image(np.pad(image[..., 0] if image.ndim == 3 else image, 2), n=n))
        s.axis.plot(ax, color="#0072b2", linewidth=0.6)
        s.crust.plot(ax, color="black", linewidth=0.6)
        ax.set(title=f"{name}, {n} points", xlim=(0, image.shape[1] + 4), ylim=(0, image.shape[0] + 4))
        ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    parser.add_argument("--points", type=int, default=1500, help="samples of each")
    parser.add_argument("--river", type=Path, help="a picture of a river")
    parser.add_argument("--cell", type=Path, help="a picture of a cell")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    pictures = {
        "river": read_image(given.river) if given.river else river(),
        "cell": read_image(given.cell) if given.cell else cell(),
    }
    draw(pictures, 500 if given.small else given.points).savefig(given.output / "figure_6_2.png", dpi=150)


if __name__ == "__main__":
    main()
