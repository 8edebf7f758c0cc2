"""Figure 5.1: the poles of random points.

The first pole of a cell is its corner farthest from the site, the second the one farthest beyond the site. Open cells
at the rim have only the corners that are there.
"""

import numpy as np
from figure import save
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

import crazing as cz


def draw(small: bool) -> Figure:
    d = cz.diagram(cz.sample.uniform(12 if small else 24, rng=11))
    poles = cz.poles(d)
    figure = Figure(figsize=(5.6, 5.8), layout="constrained")
    ax = d.voronoi((-0.3, -0.3, 1.3, 1.3)).plot(figure.subplots(), color="0.6", linewidth=0.8)
    for column, (color, name) in enumerate((("#0072b2", "first pole"), ("#009e73", "second pole"))):
        there = poles[:, column] >= 0
        to = d.vertices[poles[there, column]]
        ax.add_collection(LineCollection(np.stack([d.sites[there], to], axis=1), colors=color, linewidths=0.8))
        ax.plot(*to.T, "s", color=color, markersize=5 - column, label=name)
    ax.plot(*d.sites.T, "o", color="#d55e00", markersize=4, label="site")
    ax.set(xlim=(-0.3, 1.3), ylim=(-0.3, 1.3), aspect="equal")
    ax.set_axis_off()
    figure.legend(loc="outside lower center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    save(__doc__, "figure_5_1", draw)
