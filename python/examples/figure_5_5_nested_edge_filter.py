"""Figure 5.5: nested curves, their axes before and after the edge filter.

Third iteration, when all vertices of the first two have joined the samples.
"""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    points = curve(16 if small else 48)
    pair = [(method, cz.nested(points, iterations=3, method=method)[-1]) for method in ("initial", "edge-filter")]
    return draw([pair], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_5_5", __doc__)
