"""What the figure scripts share: how they are called, and how a skeleton is drawn."""

import argparse
from collections.abc import Callable
from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure

import crazing as cz


def save(doc: str | None, name: str, draw: Callable[[bool], Figure]) -> None:
    """Calls `draw`, with whether a quick picture is wanted, and saves what it returns."""
    parser = argparse.ArgumentParser(description=doc)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    draw(given.small).savefig(given.output / f"{name}.png", dpi=150)


def panel(ax: Axes, s: cz.Skeleton, title: str, *, reach: float, samples: float = 2.5) -> None:
    """Axis in blue, samples in red, out to `reach` from the origin."""
    s.axis.plot(ax, color="#0072b2", linewidth=0.7)
    ax.plot(*s.diagram.sites.T, "o", color="#d55e00", markersize=samples, markeredgewidth=0, zorder=3)
    ax.set(title=title, xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal")
    ax.set_axis_off()
