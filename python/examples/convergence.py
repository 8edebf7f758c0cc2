"""How fast each method's axis nears the true one as the samples of a curve are doubled.

Largest distance both ways to the analytic inner axis: of an ellipse a segment, of a rectangle a segment with four arms,
of an annulus a circle. Order 2 on smooth curves; order 1 on the rectangle, whose arms end where the samples do.
"""

import numpy as np
from axes_grid import save
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz

METHODS = ("edge-filter", "one-step", "initial", "poles")
Points = NDArray[np.float64]


def ellipse(n: int) -> tuple[Points, Points]:
    t = 2 * np.pi * np.arange(n) / n
    return np.column_stack([2 * np.cos(t), np.sin(t)]), np.array([[(-1.5, 0.0), (1.5, 0.0)]])


def rectangle(n: int) -> tuple[Points, Points]:
    corners = np.array([(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)])
    sides = [
        np.linspace(a, b, n * k // 12, endpoint=False)
        for a, b, k in zip(corners, np.roll(corners, -1, axis=0), (4, 2, 4, 2), strict=True)
    ]
    arms = [(corner, (np.copysign(1.0, corner[0]), 0.0)) for corner in corners]
    return np.concatenate(sides), np.array([((-1.0, 0.0), (1.0, 0.0)), *arms])


def annulus(n: int) -> tuple[Points, Points]:
    t = 2 * np.pi * np.arange(n // 2) / (n // 2)
    circle = np.column_stack([np.cos(t), np.sin(t)])
    turn = 2 * np.pi * np.arange(20_001) / 20_000
    ring = 2 * np.column_stack([np.cos(turn), np.sin(turn)])
    return np.concatenate([circle, 3 * circle]), np.stack([ring[:-1], ring[1:]], axis=1)


SHAPES = {"ellipse": ellipse, "rectangle": rectangle, "annulus": annulus}


def inside(shape: str, p: Points) -> NDArray[np.bool_]:
    x, y = p.T
    if shape == "ellipse":
        return (x / 2) ** 2 + y**2 < 1
    return (abs(x) < 2) & (abs(y) < 1) if shape == "rectangle" else (abs(np.hypot(x, y) - 2) < 1)


def error(shape: str, method: str, n: int) -> float:
    """The Hausdorff distance of the inner axis and the true one, looked at some thousands of places."""
    points, segments = SHAPES[shape](n)
    true = cz.PlanarGraph(segments.reshape(-1, 2), np.arange(2 * len(segments)).reshape(-1, 2))
    axis = cz.medial_axis(points, method=method).axis
    within = inside(shape, axis.vertices)
    axis = cz.PlanarGraph(axis.vertices, axis.edges[within[axis.edges].all(axis=1)])
    share = np.linspace(0, 1, 2 + 4000 // len(segments))[:, None, None]
    along = ((1 - share) * segments[:, 0] + share * segments[:, 1]).reshape(-1, 2)
    return max(true.distances(axis.segments.reshape(-1, 2)).max(), axis.distances(along).max())


def order(errors: list[float]) -> float:
    """How many times the error halves as the samples double."""
    return float(np.log2(errors[0] / errors[-1]) / (len(errors) - 1))


def figure(small: bool) -> Figure:
    sizes = [96 * 2**i for i in range(3 if small else 7)]
    drawing = Figure(figsize=(12, 4.2), layout="constrained")
    print(f"{'shape':10} {'method':12} {'order':>6}  " + "  ".join(f"{n:>8}" for n in sizes))
    for ax, shape in zip(drawing.subplots(1, 3), SHAPES, strict=True):
        for method, mark in zip(METHODS, "os^v", strict=True):
            errors = [error(shape, method, n) for n in sizes]
            print(f"{shape:10} {method:12} {order(errors):6.2f}  " + "  ".join(f"{e:8.1e}" for e in errors))
            ax.loglog(sizes, errors, marker=mark, markersize=4, label=f"{method}, order {order(errors):.2f}")
        ax.set(title=shape, xlabel="samples", ylabel="Hausdorff distance to the true axis")
        ax.grid(alpha=0.3)
        ax.legend(frameon=False, fontsize="small")
    return drawing


if __name__ == "__main__":
    save(figure, "convergence", __doc__)
