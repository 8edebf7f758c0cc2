"""Figure 4.3: third and fourth iteration of nested curves by the initial approximation of the axis.

The vertices of each round join the samples of the next; the many edges across the axis are soon most of the picture.
"""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    found = cz.nested(curve(16 if small else 48), iterations=4, method="initial")
    return draw([[("iteration 3", found[2]), ("iteration 4", found[3])]], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_4_3", __doc__)
