"""Time of a polygon's centreline beside `centerline` and `pygeoops`, and how near the lines are to each other.

User time of the process, both sides on the same densified polygon with two holes. Peers that are not installed are
left out. Those that take quadratic time are measured up to ``--most`` points; the ratio at 100,000 is extrapolated from
the last two sizes, and said to be so.
"""

from __future__ import annotations

import argparse
import resource
from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np
import shapely

import crazing as cz

AIM = 100_000


def polygon(n: int) -> Any:
    """A wavy outline with two round holes, `n` points of boundary in all."""
    t = np.linspace(0, 2 * np.pi, n // 2, endpoint=False)
    radius = 100 * (1 + 0.25 * np.cos(5 * t))
    shell = radius[:, None] * np.column_stack([np.cos(t), np.sin(t)])
    turn = np.linspace(0, 2 * np.pi, n // 4, endpoint=False)
    holes = [(x, 0) + 15 * np.column_stack([np.cos(turn), np.sin(turn)]) for x in (-35.0, 35.0)]
    return shapely.Polygon(shell, holes)


def ours(shape: Any) -> Any:
    # So coarse that only the polygon's own points are used, as the peers do.
    return cz.centerline(shape, spacing=shape.length).to_shapely()


def peers(n: int) -> dict[str, Callable[[Any], Any]]:
    found: dict[str, Callable[[Any], Any]] = {}
    step = polygon(n).length / n
    if find_spec("centerline"):
        geometry = import_module("centerline.geometry")
        found["centerline"] = lambda shape: geometry.Centerline(shape, interpolation_distance=2 * step).geometry
    if find_spec("pygeoops"):
        pygeoops = import_module("pygeoops")
        found["pygeoops"] = lambda shape: pygeoops.centerline(shape, densify_distance=2 * step)
    return found


def timed(function: Callable[[Any], Any], shape: Any) -> tuple[float, Any]:
    start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    result = function(shape)
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime - start, result


def table(sizes: list[int], aim: int) -> str:
    lines = [f"{'points':>8} {'package':12} {'seconds':>9} {'ratio':>8} {'ours to it':>11} {'it to ours':>11}"]
    seconds: dict[str, list[float]] = {}
    for n in sizes:
        shape = polygon(n)
        own, line = timed(ours, shape)
        lines.append(f"{n:8} {'crazing':12} {own:9.3f}")
        for name, function in peers(n).items():
            theirs, other = timed(function, shape)
            seconds.setdefault(name, []).append(theirs)
            near = [shapely.distance(shapely.points(shapely.get_coordinates(a)), b).max()
                    for a, b in ((line, other), (other, line))]  # fmt: skip
            lines.append(
                f"{n:8} {name:12} {theirs:9.3f} {theirs / max(own, 1e-9):8.0f} {near[0]:11.3f} {near[1]:11.3f}"
            )
    own, _ = timed(ours, polygon(aim))
    lines.append(f"{aim:8} {'crazing':12} {own:9.3f}")
    for name, each in seconds.items():
        power = np.log(each[-1] / each[-2]) / np.log(sizes[-1] / sizes[-2])
        whole = each[-1] * (aim / sizes[-1]) ** power
        lines.append(f"{aim:8} {name:12} {whole:9.1f} {whole / max(own, 1e-9):8.0f}  extrapolated, order {power:.2f}")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, for checks")
    parser.add_argument("--most", type=int, default=16_000, help="most points that the peers are given")
    parser.add_argument("-o", "--output", type=Path, metavar="FOLDER", help="also write the table here")
    given = parser.parse_args()
    most = 800 if given.small else given.most
    text = table([most // 4, most // 2, most], 2000 if given.small else AIM)
    print(text)
    if given.output is not None:
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "polygon_axis.txt").write_text(text + "\n")


if __name__ == "__main__":
    main()
