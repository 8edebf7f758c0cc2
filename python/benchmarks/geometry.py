"""How fast diagrams, skeletons and mazes are, as ratios to SciPy, to bare spade and to each other in the same run.

``python python/benchmarks/geometry.py`` prints the tables. Every time is the least of some runs, taken in turn so that
a busy machine is unkind to all of them. Bare spade is timed by the Rust benchmark, ``cargo bench --bench diagram``,
which this runs where there is a cargo; ``--small`` leaves it out.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import networkx as nx
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import crazing as cz
from crazing.arguments import points_array

Points = NDArray[np.float64]
Clock = Callable[[], float]

ROOT = Path(__file__).parents[2]
# SciPy needs some 20 s for 1e6 uniform points, and longer for samples of a curve.
MOST_FOR_SCIPY = {"uniform": 1_000_000, "curve": 100_000}
MOST_FOR_NETWORKX = 10_000
EMPTY = np.empty((0, 2))


def uniform(count: int) -> Points:
    return np.random.default_rng(1).random((count, 2))


def curve(count: int) -> Points:
    """Samples of a flower: the main input of skeletons, and the worst case of sorted insertion."""
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    r = 1000 * (1 + 0.3 * np.cos(5 * t) + 0.1 * np.cos(13 * t))
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


DATA = {"uniform": uniform, "curve": curve}


def least(works: Mapping[str, Callable[[], object]], runs: int, clock: Clock) -> dict[str, float]:
    """The least time of each work in seconds, all of them run in turn."""
    times = dict.fromkeys(works, np.inf)
    for _ in range(runs):
        for name, work in works.items():
            start = clock()
            work()
            times[name] = min(times[name], clock() - start)
    return times


def line(*cells: object) -> str:
    """Cells in columns: words, counts, ratios."""
    return "".join(f"{cell:>12.3f}" if isinstance(cell, float) else f"{cell!s:>12}" for cell in cells).rstrip()


def runs_for(count: int) -> int:
    return max(3, min(21, 200_000 // count))


def diagrams(sizes: list[int], clock: Clock) -> list[str]:
    """The diagram against SciPy, and samples of a curve against uniform points."""
    table = [line("points", "data", "ns/point", "to SciPy", "to uniform")]
    for count in sizes:
        points = {name: sample(count) for name, sample in DATA.items()}
        works = {name: (lambda rows=rows: cz.diagram(rows)) for name, rows in points.items()}
        times = least(works, runs_for(count), clock)
        for name, rows in points.items():
            scipy = np.nan
            if count <= MOST_FOR_SCIPY[name]:
                scipy = least({"": lambda rows=rows: Delaunay(rows)}, 1 if count > 100_000 else 3, clock)[""]
            ratios = times[name] / scipy, times[name] / times["uniform"]
            table.append(line(count, name, f"{1e9 * times[name] / count:.0f}", *map(float, ratios)))
    return table


def on_diagram(points: Points, diagram: cz.Diagram, maze: cz.Maze) -> dict[str, Callable[[], object]]:
    """What is computed from a diagram, by the name of its column."""
    return {
        "diagram": lambda: cz.diagram(points),
        "one-step": lambda: cz.crust(diagram, method="one-step"),
        "two-pass": lambda: cz.crust(diagram, method="two-pass"),
        "axis 1-step": lambda: cz.medial_axis(diagram, method="one-step"),
        "edge-filter": lambda: cz.medial_axis(diagram, method="edge-filter"),
        "initial": lambda: cz.medial_axis(diagram, method="initial"),
        "maze": lambda: cz.maze(diagram, rng=1),
        "solve": lambda: maze.solve(0, len(diagram.sites) - 1),
    }


def methods(sizes: list[int], clock: Clock) -> list[str]:
    """Skeletons and mazes of a given diagram against the diagram itself."""
    table = []
    for count in sizes:
        for name, sample in DATA.items():
            points = sample(count)
            diagram = cz.diagram(points)
            times = least(on_diagram(points, diagram, cz.maze(diagram, rng=1)), runs_for(count), clock)
            whole = times.pop("diagram")
            table = table or [line("points", "data", *times)]
            table.append(line(count, name, *(float(part / whole) for part in times.values())))
    return table


def search(count: int, clock: Clock) -> float:
    """The maze against depth-first search in NetworkX, on the same graph."""
    diagram = cz.diagram(uniform(count))
    graph = nx.Graph(diagram.edges.tolist())
    works = {"maze": lambda: cz.maze(diagram, rng=1), "networkx": lambda: list(nx.dfs_edges(graph, 0))}
    times = least(works, runs_for(count), clock)
    return float(times["maze"] / times["networkx"])


def searches(sizes: list[int], clock: Clock) -> list[str]:
    """Mazes against NetworkX, where it is not too slow."""
    counts = [count for count in sizes if count <= MOST_FOR_NETWORKX]
    return [line("points", "to NetworkX"), *(line(count, search(count, clock)) for count in counts)]


def shares(count: int) -> list[object]:
    """Microseconds of each part of a call that is not the core's, and their share of the call in per cent."""
    points = uniform(count)
    found = cz.diagram(points)
    arrays = found.sites, found.site_of, found.triangles, found.vertices, found.edges, found.dual_edges
    parts = {
        "arguments": lambda: points_array(points),
        "wrapping": lambda: cz.Diagram(*arrays),
        "empty call": lambda: cz.diagram(EMPTY),
    }
    # Microseconds are too short for the clock of the processor.
    times = least(parts, 1000, time.perf_counter)
    whole = least({"call": lambda: cz.diagram(points)}, runs_for(count), time.perf_counter)["call"]
    return [*(f"{1e6 * part:.1f}" for part in times.values()), float(100 * sum(times.values()) / whole)]


def overhead(sizes: list[int]) -> list[str]:
    """The share of a call that is not the core's.

    The difference of two long times would be noise. What the face does to the arrays is timed alone, and the binding,
    which copies nothing and so costs the same for any number of points, by a call without points.
    """
    head = line("points", "argument us", "wrapping us", "empty us", "share %")
    return [head, *(line(count, *shares(count)) for count in sizes)]


def bare(sizes: list[int]) -> list[str]:
    """The core against bare spade, by the Rust benchmark."""
    if not shutil.which("cargo"):
        return ["no cargo: bare spade was not timed"]
    command = ["cargo", "bench", "--quiet", "--bench", "diagram", "--", *map(str, sizes)]
    return subprocess.run(command, cwd=ROOT, check=True, text=True, capture_output=True).stdout.splitlines()


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description="Time diagrams, skeletons and mazes.")
    parser.add_argument("--small", action="store_true", help="few points, and no Rust benchmark")
    parser.add_argument("--sizes", type=int, nargs="+", default=[10_000, 100_000, 1_000_000])
    parser.add_argument("--clock", choices=["wall", "processor"], default="wall", help="what a time is")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the tables to a file in this folder")
    given = parser.parse_args()
    sizes = [1000] if given.small else given.sizes
    clock = time.perf_counter if given.clock == "wall" else time.process_time
    sections: dict[str, Callable[[], list[str]]] = {
        "cz.diagram": lambda: diagrams(sizes, clock),
        "of a given diagram, as a ratio to cz.diagram": lambda: methods(sizes, clock),
        "depth-first search": lambda: searches(sizes, clock),
        "cz.diagram, what is not the core's": lambda: overhead(sizes),
    }
    if not given.small:
        sections["the core against bare spade"] = lambda: bare(sizes)
    report = []
    for title, section in sections.items():
        report += [title, *section(), ""]
        print("\n".join(report[report.index(title) :]), flush=True)
    if given.folder:
        given.folder.mkdir(parents=True, exist_ok=True)
        (given.folder / "geometry.txt").write_text("\n".join(report), encoding="utf-8")


if __name__ == "__main__":
    main()
