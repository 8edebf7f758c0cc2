"""Figure 5.7: the medial axis by each method, of a curve and of a star with sharp corners.

One-step, which the thesis shows in figure 5.8, is added: on samples as clean as these it equals the edge filter.
"""

import numpy as np
from figure import panel, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz


def star(n: int, points: int = 5) -> NDArray[np.float64]:
    """About `n` samples, evenly along each side of a star."""
    turn = np.pi / 2 + np.arange(2 * points) * np.pi / points
    corners = np.where(np.arange(2 * points) % 2, 0.5, 1.25)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    steps = np.arange(max(n // (2 * points), 1)) / max(n // (2 * points), 1)
    return np.concatenate(
        [a + steps[:, None] * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0), strict=True)]
    )


def draw(small: bool) -> Figure:
    n = 40 if small else 120
    methods = "initial", "poles", "edge-filter", "one-step"
    figure = Figure(figsize=(15, 7.8), layout="constrained")
    for row, points in zip(figure.subplots(2, 4), (curve(n), star(n)), strict=True):
        for ax, method in zip(row, methods, strict=True):
            s = cz.medial_axis(points, method=method)
            panel(ax, s, f"{method}: {len(s.axis.edges)} edges, {s.axis.components} pieces", reach=1.6)
    return figure


if __name__ == "__main__":
    save(__doc__, "figure_5_7", draw)
