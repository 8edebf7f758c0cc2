"""Time of a polygon's centreline beside `centerline` and `pygeoops`, and how near the lines are to each other.

User time of the process, both sides on the same polygons, whose corners are half a unit apart: a flower of thirteen
petals, and a wavy outline with two holes that are circles, the worst that a triangulation can be given.
``centerline`` is called with its default, a point every .5, and so is given as many points as there are corners;
``pygeoops`` is told the same distance. Peers that are not installed are left out. Those that take quadratic time are
measured up to ``--most`` points; the ratio at 100,000 is extrapolated from the last two sizes, with the order of growth
between these, and said to be so. ``--whole`` measures it instead: some ten minutes each.
"""

from __future__ import annotations

import argparse
import resource
from collections.abc import Callable, Collection
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import shapely.affinity

import crazing as cz

AIM = 100_000
#: Distance of points by default of `centerline`, in its unit.
STEP = 0.5
#: Seconds that a peer may take before it is given nothing larger.
PATIENCE = 5.0


def flower(n: int) -> Any:
    """An outline of thirteen petals, `n` points of boundary, half a unit apart in the mean."""
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    radius = 1000 * (1 + 0.3 * np.cos(5 * t) + 0.1 * np.cos(13 * t))
    return stepped(shapely.Polygon(radius[:, None] * np.column_stack([np.cos(t), np.sin(t)])), n)


def pierced(n: int) -> Any:
    """A wavy outline with two round holes, `n` points of boundary in all, half a unit apart in the mean."""
    t = np.linspace(0, 2 * np.pi, n // 2, endpoint=False)
    radius = 100 * (1 + 0.25 * np.cos(5 * t))
    shell = radius[:, None] * np.column_stack([np.cos(t), np.sin(t)])
    turn = np.linspace(0, 2 * np.pi, n // 4, endpoint=False)
    holes = [(x, 0) + 15 * np.column_stack([np.cos(turn), np.sin(turn)]) for x in (-35.0, 35.0)]
    return stepped(shapely.Polygon(shell, holes), n)


def stepped(shape: Any, n: int) -> Any:
    """The shape at the scale where its `n` corners are half a unit apart in the mean."""
    by = STEP * n / shape.length
    return shapely.affinity.scale(shape, by, by, origin=(0, 0))


SHAPES: dict[str, Callable[[int], Any]] = {"flower": flower, "holes": pierced}


def ours(shape: Any) -> Any:
    # So coarse that only the polygon's own points are used, as the peers do.
    return cz.centerline(shape, spacing=shape.length).to_shapely()


def peers() -> dict[str, Callable[[Any], Any]]:
    found: dict[str, Callable[[Any], Any]] = {}
    if find_spec("centerline"):
        geometry = import_module("centerline.geometry")
        found["centerline"] = lambda shape: geometry.Centerline(shape).geometry
    if find_spec("pygeoops"):
        pygeoops = import_module("pygeoops")
        found["pygeoops"] = lambda shape: pygeoops.centerline(shape, densify_distance=STEP)
    return found


def timed(function: Callable[[Any], Any], shape: Any) -> tuple[float, Any]:
    start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    result = function(shape)
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime - start, result


def beside(kind: str, n: int, names: Collection[str]) -> tuple[list[str], dict[str, float]]:
    """The lines of the table for one size, and the seconds of ours and of the peers named."""
    shape = SHAPES[kind](n)
    # The first call is not the one to time: it also loads what it uses.
    own, line = min((timed(ours, shape) for _ in range(3)), key=lambda found: found[0])
    lines = [f"{n:8} {'crazing':12} {own:9.3f}"]
    seconds = {}
    for name, function in peers().items():
        if name in names:
            seconds[name], other = timed(function, shape)
            near = [shapely.distance(shapely.points(shapely.get_coordinates(a)), b).max()
                    for a, b in ((line, other), (other, line))]  # fmt: skip
            ratio = seconds[name] / max(own, 1e-9)
            lines.append(f"{n:8} {name:12} {seconds[name]:9.3f} {ratio:8.0f} {near[0]:11.3f} {near[1]:11.3f}")
    return lines, {"crazing": own, **seconds}


def table(kind: str, sizes: list[int], aim: int, whole: bool) -> str:
    lines = [f"{kind:>8} {'package':12} {'seconds':>9} {'ratio':>8} {'ours to it':>11} {'it to ours':>11}"]
    measured: dict[str, list[tuple[int, float]]] = {name: [] for name in peers()}
    for n in sizes:
        text, seconds = beside(kind, n, [name for name, each in measured.items() if not each or each[-1][1] < PATIENCE])
        lines += text
        for name in measured.keys() & seconds.keys():
            measured[name].append((n, seconds[name]))
    text, last = beside(kind, aim, list(measured) if whole else [])
    lines += text
    for name, each in measured.items() if not whole else ():
        (before, less), (most, longest) = each[-2:]
        power = np.log(longest / less) / np.log(most / before)
        guess = longest * (aim / most) ** power
        ratio = guess / max(last["crazing"], 1e-9)
        lines.append(f"{aim:8} {name:12} {guess:9.1f} {ratio:8.0f}  extrapolated from {most}, order {power:.2f}")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, for checks")
    parser.add_argument("--most", type=int, default=32_000, help="most points that the peers are given")
    parser.add_argument("--whole", action="store_true", help="give the peers 100,000 points, too")
    parser.add_argument("-o", "--output", type=Path, metavar="FOLDER", help="also write the table here")
    given = parser.parse_args()
    most = 1600 if given.small else given.most
    sizes, aim = [most // 16, most // 8, most // 4, most // 2, most], 2000 if given.small else AIM
    text = "\n".join(table(kind, sizes, aim, given.whole) for kind in SHAPES)
    print(text)
    if given.output is not None:
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "polygon_axis.txt").write_text(text + "\n")


if __name__ == "__main__":
    main()
