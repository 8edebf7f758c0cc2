"""Nested curves of figures 5.3 and 5.5: one row a method, one column a round."""

from collections.abc import Sequence

from figure import panel
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def rows(methods: Sequence[str], n: int, *, rounds: Sequence[int] = (1, 2, 3)) -> Figure:
    """Axes of `n` samples of the curve of figure 4.1 after each of some rounds."""
    figure = Figure(figsize=(4.2 * len(rounds), 4.5 * len(methods)), layout="constrained")
    for row, method in zip(figure.subplots(len(methods), len(rounds), squeeze=False), methods, strict=True):
        nested = cz.nested(curve(n), iterations=max(rounds), method=method)
        for ax, i in zip(row, rounds, strict=True):
            s = nested[i - 1]
            panel(ax, s, f"{method}, round {i}: {len(s.axis.edges)} edges", reach=1.35, samples=3.5 / i)
    return figure
