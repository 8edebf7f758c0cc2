"""Figure 5.3: nested curves, their axes before and after the pole filter.

Third iteration, when all vertices of the first two have joined the samples.
"""

from axes_grid import draw, save
from figure_4_1_crust_steps import curve
from matplotlib.figure import Figure

import crazing as cz


def figure(small: bool) -> Figure:
    points = curve(16 if small else 48)
    pair = [(method, cz.nested(points, iterations=3, method=method)[-1]) for method in ("initial", "poles")]
    return draw([pair], (-1.6, -1.6, 1.6, 1.6))


if __name__ == "__main__":
    save(figure, "figure_5_3", __doc__)
