"""Figure 8.4: the densities of the standard normal and the Laplace distribution, and of the samples of the library.

Laplace is more peaked and has the heavier tails: more points at the source of a crack, and more far from it.
"""

import argparse
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import crazing as cz


def draw(n: int) -> Figure:
    x = np.linspace(-5, 5, 501)
    curves = {
        "normal": ("#0072b2", np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi), cz.sample.normal(n, rng=1)),
        "Laplace": ("#d55e00", np.exp(-abs(x)) / 2, cz.sample.laplace(n, rng=1)),
    }
    figure = Figure(figsize=(6.5, 4), layout="constrained")
    ax = figure.subplots()
    for name, (color, density, points) in curves.items():
        ax.plot(x, density, color=color, linewidth=1.8, label=name)
        ax.hist(points[:, 0], bins=80, range=(-5, 5), density=True, color=color, alpha=0.25, label=f"{n} samples")
    ax.set(xlabel="x", ylabel="density", xlim=(-5, 5))
    ax.spines[["top", "right"]].set_visible(False)
    ax.legend(frameon=False)
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(1000 if given.small else 100_000).savefig(given.output / "figure_8_4.png", dpi=150)


if __name__ == "__main__":
    main()
