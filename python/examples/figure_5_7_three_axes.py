"""Figure 5.7: initial, pole-filtered and edge-filtered axis of one point cloud."""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    points = curve(40 if small else 120)
    methods = ("initial", "poles", "edge-filter")
    return draw([[(method, cz.medial_axis(points, method=method)) for method in methods]], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_5_7", __doc__)
