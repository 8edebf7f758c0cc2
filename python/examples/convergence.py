"""How fast the inner axis approaches the true one as the samples double, by method.

The Hausdorff distance between both, on an ellipse, an annulus and a rectangle, whose axes are known. It falls with the
square of the spacing on the smooth shapes, and with the spacing itself on the rectangle, whose corners are never
sampled finely enough. All methods are equally near: the vertices are the same, what differs is which edges join them.
"""

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

import crazing as cz

Points = NDArray[np.float64]
#: Of a true axis, or a part of it.
SAMPLES = 300
METHODS = "initial", "poles", "edge-filter", "one-step"


@dataclass(frozen=True)
class Shape:
    """A shape whose axis is known."""

    outline: Callable[[int], Points]
    axis: Points  # samples
    away: Callable[[Points], NDArray[np.float64]]  # exact distances to the axis


def circle(n: int, radius: float, turn: float = 0.0) -> Points:
    t = (np.arange(n) + turn) * 2 * np.pi / n
    return radius * np.stack([np.cos(t), np.sin(t)], axis=1)


def along(a: tuple[float, float], b: tuple[float, float], n: int) -> Points:
    t = np.arange(n)[:, None] / n
    return (1 - t) * np.array(a) + t * np.array(b)


def rectangle(n: int) -> Points:
    """2 x 1, evenly sampled, its corners left out: a sample there would have a hair of its own."""
    corners = [(-1.0, -0.5), (1.0, -0.5), (1.0, 0.5), (-1.0, 0.5)]
    sides = zip(corners, corners[1:] + corners[:1], (2, 1, 2, 1), strict=True)
    steps = [(a, b, length * n // 6) for a, b, length in sides]
    return np.concatenate([along(a, b, k) + 0.5 / k * np.subtract(b, a) for a, b, k in steps])


def to_segments(points: Points, a: Points, b: Points) -> NDArray[np.float64]:
    """Distance of each point to the nearest of some segments."""
    step = b - a
    seen = points[:, None] - a
    t = np.clip((seen * step).sum(axis=2) / (step**2).sum(axis=1), 0, 1)
    return np.asarray(np.hypot(*(seen - t[..., None] * step).transpose(2, 0, 1)).min(axis=1))


def polyline(outline: Callable[[int], Points], ends: list[tuple[tuple[float, float], tuple[float, float]]]) -> Shape:
    a, b = (np.array(column) for column in zip(*ends, strict=True))
    samples = np.concatenate([*(along(*pair, SAMPLES) for pair in ends), b])
    return Shape(outline, samples, lambda points: to_segments(points, a, b))


def shapes() -> dict[str, Shape]:
    ellipse = polyline(lambda n: circle(n, 1.0, 0.5) * (1.0, 0.6), [((-0.64, 0.0), (0.64, 0.0))])
    # One sample more on the inner circle, and a turn: else cells would lie on rays, which no real data do.
    annulus = Shape(
        lambda n: np.concatenate([circle(2 * n // 3, 1.0), circle(n // 3 + 1, 0.5, 0.3)]),
        circle(SAMPLES, 0.75),
        lambda points: np.abs(np.hypot(*points.T) - 0.75),
    )
    arms = [((x * 0.5, 0.0), (x, y)) for x in (-1.0, 1.0) for y in (-0.5, 0.5)]
    return {
        "ellipse": ellipse,
        "annulus": annulus,
        "rectangle": polyline(rectangle, [((-0.5, 0.0), (0.5, 0.0)), *arms]),
    }


def hausdorff(axis: cz.PlanarGraph, shape: Shape) -> float:
    """Both ways: from the vertices of the axis to the true one, and from that to the edges of the axis."""
    a, b = axis.segments.transpose(1, 0, 2)
    return max(float(shape.away(axis.compact().vertices).max()), float(to_segments(shape.axis, a, b).max()))


def inner_axis(samples: Points, method: str) -> cz.PlanarGraph:
    """The axis inside the crust: edges whose ends both are nearer to the middle of the material than to infinity."""
    s = cz.medial_axis(samples, method=method)
    if s.axis_mask is not None:
        return s.inner
    # Their axis may hold edges that are not dual to any: those between vertices that inner dual edges have.
    one = cz.medial_axis(s.diagram, method="one-step")
    inside = np.zeros(len(s.diagram.vertices), dtype=bool)
    inside[one.inner.edges.ravel()] = True
    return cz.PlanarGraph(s.axis.vertices, s.axis.edges[inside[s.axis.edges].all(axis=1)])


def study(sizes: list[int]) -> dict[str, dict[str, list[float]]]:
    """Distances by shape and method, one a size."""
    return {
        name: {method: [hausdorff(inner_axis(shape.outline(n), method), shape) for n in sizes] for method in METHODS}
        for name, shape in shapes().items()
    }


def order(sizes: list[int], distances: list[float]) -> float:
    """The power of the spacing that distances fall with: the slope of a line through their logarithms."""
    return -float(np.polyfit(np.log(sizes), np.log(distances), 1)[0])


def draw(sizes: list[int], found: dict[str, dict[str, list[float]]]) -> Figure:
    figure = Figure(figsize=(12, 4.2), layout="constrained")
    for ax, (name, methods) in zip(figure.subplots(1, len(found), sharey=True), found.items(), strict=True):
        for marker, (method, distances) in zip("sv^o", methods.items(), strict=True):
            label = f"{method}, order {order(sizes, distances):.2f}"
            ax.loglog(sizes, distances, marker=marker, markersize=4, linewidth=1, label=label)
        ax.set(title=name, xlabel="samples")
        ax.grid(color="0.9")
        ax.legend(frameon=False, fontsize=8)
    figure.axes[0].set_ylabel("Hausdorff distance to the true axis")
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    sizes = [48, 96, 192] if given.small else [96, 192, 384, 768, 1536, 3072]
    found = study(sizes)
    for name, methods in found.items():
        for method, distances in methods.items():
            print(
                f"{name:10} {method:12} order {order(sizes, distances):5.2f}  "
                + " ".join(f"{d:.1e}" for d in distances)
            )
    draw(sizes, found).savefig(given.output / "convergence.png", dpi=150)


if __name__ == "__main__":
    main()
