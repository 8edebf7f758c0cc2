"""Figure 5.2: the medial axis before and after pole filtering.

Only edges between poles are kept. In the plane that takes away less than one would hope: most vertices are a pole of
some cell.
"""

from figure import panel, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def draw(small: bool) -> Figure:
    clouds = curve(40 if small else 120), cz.sample.uniform(40 if small else 100, bounds=(-0.5, -0.5, 0.5, 0.5), rng=5)
    figure = Figure(figsize=(9, 9.4), layout="constrained")
    for row, points, reach in zip(figure.subplots(2, 2), clouds, (1.6, 0.65), strict=True):
        for ax, method in zip(row, ("initial", "poles"), strict=True):
            s = cz.medial_axis(points, method=method)
            panel(ax, s, f"{method}: {len(s.axis.edges)} edges", reach=reach)
    return figure


if __name__ == "__main__":
    save(__doc__, "figure_5_2", draw)
