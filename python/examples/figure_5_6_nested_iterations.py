"""Figure 5.6: nested curves by the edge filter, iteration by iteration."""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    found = cz.nested(curve(12 if small else 40), iterations=4, method="edge-filter")
    titled = [(f"iteration {i}", s) for i, s in enumerate(found, 1)]
    return draw([titled[:2], titled[2:]], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_5_6", __doc__)
