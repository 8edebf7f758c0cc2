"""A grid of skeletons, the frame that the figures of sections 4 and 5 share; by itself, every method on one curve."""

import argparse
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz

AXIS, CURVE, SAMPLE = "#0072b2", "#000000", "#d55e00"


def draw(rows: Sequence[Sequence[tuple[str, cz.Skeleton]]], window: tuple[float, float, float, float]) -> Figure:
    """A panel for each titled skeleton; samples in red, axis in blue, as in the thesis, and the crust in black."""
    across, down = len(rows[0]), len(rows)
    height = (window[3] - window[1]) / (window[2] - window[0])
    figure = Figure(figsize=(4.2 * across, (4.2 * height + 0.3) * down), layout="constrained")
    for row, panels in zip(rows, figure.subplots(down, across, squeeze=False), strict=True):
        for (title, s), ax in zip(row, panels, strict=True):
            pen = float(np.clip(20 / np.sqrt(len(s.diagram.sites)), 0.25, 0.9))
            s.axis.plot(ax, color=AXIS, linewidth=pen)
            s.crust.plot(ax, color=CURVE, linewidth=pen)
            ax.plot(*s.diagram.sites.T, "o", color=SAMPLE, markersize=2.6 * pen, zorder=3)
            ax.set(title=f"{title}: {len(s.axis.edges)} edges, {s.axis.components} pieces")
            ax.set(xlim=window[::2], ylim=window[1::2])
            ax.set_axis_off()
    return figure


def save(figure_of, name: str, words: str | None) -> None:
    """Runs a script: `figure_of(small)` is drawn and written as `name`.png."""
    parser = argparse.ArgumentParser(description=words)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    figure_of(given.small).savefig(given.output / f"{name}.png", dpi=60 if given.small else 150)


def every_method(small: bool) -> Figure:
    points = curve(40 if small else 120)
    methods = ("initial", "poles", "edge-filter", "one-step")
    return draw([[(method, cz.medial_axis(points, method=method)) for method in methods]], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(every_method, "axes_grid", __doc__)
