"""Figure 5.2: the medial axis before and after pole filtering.

Fewer vertices in the second triangulation, and fewer edges across the axis; most of the hairs stay.
"""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    points = curve(40 if small else 120)
    pair = [(method, cz.medial_axis(points, method=method)) for method in ("initial", "poles")]
    return draw([pair], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_5_2", __doc__)
