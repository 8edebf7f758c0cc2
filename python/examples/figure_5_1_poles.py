"""Figure 5.1: the Voronoi poles of random points.

Of every cell the vertex farthest from its site, and the one on the other side; the remaining vertices are let go.
"""

from axes_grid import AXIS, SAMPLE, save
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    d = cz.diagram(cz.sample.uniform(15 if small else 40, rng=4))
    found = cz.poles(d)
    rows = found[found >= 0]
    drawing = Figure(figsize=(5.4, 5.6), layout="constrained")
    ax = d.voronoi((-0.2, -0.2, 1.2, 1.2)).plot(drawing.subplots(), color="#8c8c8c", linewidth=0.8)
    ax.plot(*d.vertices.T, "o", color="white", markeredgecolor="#8c8c8c", markersize=4)
    ax.plot(*d.vertices[rows].T, "o", color=AXIS, markersize=5)
    ax.plot(*d.sites.T, "o", color=SAMPLE, markersize=4)
    for site, pair in zip(d.sites, found, strict=True):
        for pole in d.vertices[pair[pair >= 0]]:
            ax.plot(*zip(site, pole, strict=True), color=AXIS, linewidth=0.6, alpha=0.6)
    ax.set(
        title=f"{len(set(rows.tolist()))} poles among {len(d.vertices)} vertices", xlim=(-0.2, 1.2), ylim=(-0.2, 1.2)
    )
    ax.set_axis_off()
    return drawing


if __name__ == "__main__":
    save(figure, "figure_5_1", __doc__)
