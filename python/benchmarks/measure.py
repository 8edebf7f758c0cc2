"""Time of `measure` on a Voronoi diagram, over the time of the diagram, and of a mask.

Ratios of user time, of runs in turn: what else the machine does cancels out.
"""

from __future__ import annotations

import argparse
import resource
from collections.abc import Callable
from pathlib import Path
from typing import Any

import crazing as cz
from crazing.measure import stamp


def seconds(work: Callable[[], Any]) -> float:
    start = resource.getrusage(resource.RUSAGE_SELF).ru_utime
    work()
    return resource.getrusage(resource.RUSAGE_SELF).ru_utime - start


def table(sites: int, runs: int) -> str:
    points = cz.sample.uniform(sites, rng=1)
    bounds = (0.0, 0.0, 1.0, 1.0)
    graph = cz.diagram(points).voronoi(bounds)
    maze = cz.crack(n=sites, opening=0.6, rng=1)
    mask = stamp(cz.crack(n=300, opening=0.6, rng=1), 800)
    works: dict[str, Callable[[], Any]] = {
        "diagram": lambda: cz.diagram(points),
        f"measure, Voronoi graph of {len(graph.edges)} edges": lambda: cz.measure(graph, bounds=bounds),
        f"measure, crack of {len(maze.graph.edges)} edges": lambda: cz.measure(maze),
        "measure, mask of 800 x 800 pixels": lambda: cz.measure(mask),
    }
    times = {name: [] for name in works}
    for _ in range(runs):
        for name, work in works.items():
            times[name].append(seconds(work))
    best = {name: min(each) for name, each in times.items()}
    return "\n".join(f"{name:48}{best[name]:9.3f} s{best[name] / (best['diagram'] or 1e-9):7.2f} x" for name in works)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few sites")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the table to a file in this folder")
    arguments = parser.parse_args()
    found = table(3000, 2) if arguments.small else table(333_000, 3)
    print(found)
    if arguments.folder is not None:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        (arguments.folder / "measure.txt").write_text(found + "\n")


if __name__ == "__main__":
    main()
