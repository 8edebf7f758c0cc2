"""Figure 4.3: the third and the fourth axis of the curve of figure 4.1, nested.

Every round takes the Voronoi vertices of the last one as further samples. Axes grow into the space between curve and
axis, and the triangles of the initial approximation multiply with them.
"""

from figure import panel, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def draw(small: bool) -> Figure:
    nested = cz.nested(curve(24 if small else 48), iterations=4, method="initial")
    figure = Figure(figsize=(10, 5.2), layout="constrained")
    for ax, i in zip(figure.subplots(1, 2), (2, 3), strict=True):
        panel(ax, nested[i], f"axis {i + 1}: {len(nested[i].axis.edges)} edges", reach=1.35, samples=2)
    return figure


if __name__ == "__main__":
    save(__doc__, "figure_4_3", draw)
