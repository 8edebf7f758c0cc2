"""All steps of a recipe in one call, and the numbers of each step as the core takes them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core
from crazing.arguments import count, entries, number
from crazing.crack import Crack
from crazing.drawing import Drawing
from crazing.graph import PlanarGraph

#: The shortest reach of a source, data units: widths fade by a power of the distance over it.
NEAREST = 1e-300
#: Standard deviation of the angle of stubs to the right angle, degrees.
LEAN = 8.0

Key: TypeAlias = tuple[int, int]
#: Numbers in the order of the fields that the core has.
Straightening: TypeAlias = tuple[int, float, float, float, int]
Stubs: TypeAlias = tuple[float, float, float, float]
Roughness: TypeAlias = tuple[float, float, float, float, float]
Widths: TypeAlias = tuple[float, float, float, float, float, float, float, tuple[float, float], float, float]


@dataclass(frozen=True)
class Course:
    """The steps of a recipe in their order, those that are wanted; each with the key it draws by.

    Attributes
    ----------
    widths : (numbers, key)
    straight : numbers or None
    warp : (length, key) or None
    turn : radians or None
    hooks : (radians, length, length) or None
    stubs, rough : (numbers, key) or None
    detail : length or None
    """

    widths: tuple[Widths, Key]
    straight: Straightening | None = None
    warp: tuple[float, Key] | None = None
    turn: float | None = None
    hooks: tuple[float, float, float] | None = None
    stubs: tuple[Stubs, Key] | None = None
    rough: tuple[Roughness, Key] | None = None
    detail: float | None = None

    def crack(self, drawing: Drawing) -> Crack:
        """What comes of a drawing: the same bits as step after step, without what lies between."""
        steps = (self.straight, self.warp, self.turn, self.hooks, self.stubs, self.rough, self.detail, self.widths)
        age = np.ascontiguousarray(drawing.age)
        found = _core.crack_course(drawing.net, drawing.fence, drawing.partner, age, drawing.bounds, steps)
        (vertices, edges, shifts), looks = found[:3], found[3:]
        return widened(vertices, edges, shifts, drawing, looks)


def widened(
    vertices: NDArray[np.float64],
    edges: NDArray[np.int32],
    shifts: NDArray[np.int8],
    drawing: Drawing,
    looks: tuple[NDArray[np.float64], NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]],
) -> Crack:
    """A crack pattern of vertices that lie in the period, within the bounds of a drawing."""
    widths, strand, generation, parent = looks
    graph = PlanarGraph(vertices, edges)
    if not any(drawing.period):
        return Crack(graph, widths, strand, generation, drawing.bounds, parent=parent)
    return Crack(graph, widths, strand, generation, drawing.bounds, drawing.period, shifts, parent)


def straightening(rounds: int, pull: float, slide: float, clamp: float, unbend: int) -> Straightening:
    """The numbers of :func:`crazing.steps.straighten`."""
    return (
        count(rounds, "rounds", high=100_000),
        number(pull, "pull", low=0, high=1),
        number(slide, "slide", low=0, high=1),
        number(clamp, "clamp", low=0, high=0.5),
        count(unbend, "unbend", high=100_000),
    )


def hooks(hairpin: float, reach: float, spacing: float) -> tuple[float, float, float]:
    """The numbers of :func:`crazing.steps.part`."""
    return (
        float(np.radians(number(hairpin, "hairpin", low=0, high=180))),
        number(reach, "reach", low=0),
        number(spacing, "spacing", low=0),
    )


def turning(turn: float) -> float:
    """The number of :func:`crazing.steps.follow`."""
    return float(np.radians(number(turn, "turn", low=0, high=180)))


def stubbing(rate: float, length: float, unit: float, spread: float, lean: float) -> Stubs:
    """The numbers of :func:`crazing.steps.stubs`."""
    unit = number(unit, "unit", low=NEAREST)
    return (
        number(rate, "rate", low=0, high=1e6) / unit,
        number(length, "length", low=0, high=1e6) * unit,
        number(spread, "spread", low=0, high=4),
        float(np.radians(number(lean, "lean", low=0, high=60))),
    )


def roughness(roughness: float, unit: float, hurst: float, grain: float, rounding: float) -> Roughness:
    """The numbers of :func:`crazing.steps.roughen`."""
    unit = number(unit, "unit", low=0)
    return (
        number(roughness, "roughness", low=0, high=10),
        number(hurst, "hurst", low=0, high=2),
        unit,
        unit * number(grain, "grain", low=0, high=1e6),
        number(rounding, "rounding", low=0, high=1),
    )


def widths(
    width: float,
    hierarchy: float,
    shrink: float,
    taper: float,
    abutting: float,
    unevenness: float,
    unit: float,
    source: ArrayLike,
    reach: float,
    fade: float,
) -> Widths:
    """The numbers of :func:`crazing.steps.widen`."""
    x, y = entries(source, "source", 2, "(x, y)")
    return (
        number(width, "width", low=0),
        number(hierarchy, "hierarchy", low=0),
        number(shrink, "shrink", low=0),
        number(taper, "taper", low=0),
        number(abutting, "abutting", low=0),
        number(unevenness, "unevenness", low=0, high=4),
        number(unit, "unit", low=0),
        (number(x, "source[0]"), number(y, "source[1]")),
        number(reach, "reach", low=NEAREST),
        number(fade, "fade", low=0, high=100),
    )
