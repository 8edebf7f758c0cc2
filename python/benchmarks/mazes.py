"""How fast mazes and periodic diagrams are, as ratios to a diagram and to NetworkX and mazelib in the same run.

``python python/benchmarks/mazes.py`` prints the ratios beside their goals. Every time is the least of some runs, taken
in turn so that a busy machine is unkind to all of them. NetworkX and mazelib are timed where they are installed.
"""

from __future__ import annotations

import argparse
import importlib.util
import random
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import crazing as cz

Clock = Callable[[], float]
CORNERS = 10_000


def least(works: Mapping[str, Callable[[], object]], runs: int, clock: Clock) -> dict[str, float]:
    """The least time of each work in seconds, all of them run in turn."""
    times = dict.fromkeys(works, np.inf)
    for _ in range(runs):
        for name, work in works.items():
            start = clock()
            work()
            times[name] = min(times[name], clock() - start)
    return times


def outline(corners: int) -> NDArray[np.float64]:
    """A flower with notches all along, most of the unit square in it."""
    t = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    r = 0.47 + 0.02 * np.cos(40 * t) + 0.005 * np.cos(997 * t)
    return 0.5 + np.column_stack([r * np.cos(t), r * np.sin(t)])


def own(count: int, runs: int, clock: Clock) -> list[str]:
    """Mazes against the diagram, a shape against none, a torus against the plane."""
    points = cz.sample.uniform(count, rng=1)
    laplace = cz.sample.laplace(count, rng=1)
    d = cz.diagram(points)
    m, shape = cz.maze(d, rng=1), outline(CORNERS)
    works = {
        "diagram": lambda: cz.diagram(points),
        "torus": lambda: cz.diagram(points, period=(1, 1)),
        "maze": lambda: cz.maze(d, rng=1),
        "triangles": lambda: cz.maze(d, cells="delaunay", rng=1),
        "solve": lambda: m.solve(0, len(d.sites) - 1),
        "shape": lambda: cz.maze(d, within=shape, rng=1),
        "laplace": lambda: cz.diagram(laplace),
        "laplace torus": lambda: cz.diagram(laplace, period=(40, 40)),
    }
    t = least(works, runs, clock)
    rows = [
        ("maze / diagram", t["maze"] / t["diagram"], "at most 0.25"),
        ("solution / diagram", t["solve"] / t["diagram"], "at most 0.1"),
        ("maze of triangles / maze", t["triangles"] / t["maze"], f"{len(d.triangles) / len(d.sites):.1f} x the cells"),
        (f"maze in {CORNERS} corners / maze", t["shape"] / t["maze"], "at most 2"),
        ("periodic diagram / diagram", t["torus"] / t["diagram"], "at most 1.2"),
        ("the same of Laplace points", t["laplace torus"] / t["laplace"], "at most 2"),
    ]
    return [f"{name:<38}{ratio:>9.3f}   {goal}" for name, ratio, goal in rows]


def peers(count: int, clock: Clock) -> list[str]:
    """The same search by others: NetworkX on the same graph, mazelib on a square grid of as many cells.

    From the edges of one diagram to a maze with its solution: NetworkX makes its graph of them, searches depth-first
    with the neighbours of every cell in random order, and then for the way; its parts are also timed alone. Its search
    without chance is told for comparison: it makes the same maze every time, a poor one.
    """
    d = cz.diagram(cz.sample.uniform(count, rng=1))
    m = cz.maze(d, rng=1)
    found = []
    if importlib.util.find_spec("networkx"):
        import networkx as nx

        graph, tree = nx.Graph(d.edges.tolist()), nx.Graph(m.passages.tolist())
        chance = random.Random(1)

        def shuffled(cells: Iterable[int]) -> list[int]:
            cells = list(cells)
            chance.shuffle(cells)
            return cells

        def carved(graph: Any) -> Any:
            return nx.dfs_tree(graph, 0, sort_neighbors=shuffled)

        def whole() -> None:
            nx.shortest_path(carved(nx.Graph(d.edges.tolist())), 0, count - 1)

        works = {
            "ours": lambda: cz.maze(d, rng=1),
            "theirs": lambda: carved(graph),
            "without chance": lambda: list(nx.dfs_edges(graph, 0)),
            "our way": lambda: m.solve(0, count - 1),
            "their way": lambda: nx.shortest_path(tree, 0, count - 1),
            "our whole": lambda: cz.maze(d, start=0, rng=1).solve(0, count - 1),
            "their whole": whole,
        }
        t = least(works, 3, clock)
        found.append(f"{'NetworkX / maze and solution':<38}{t['their whole'] / t['our whole']:>9.1f}   at least 50")
        found.append(f"{'... its search alone / maze':<38}{t['theirs'] / t['ours']:>9.1f}   at least 50")
        found.append(f"{'... its search without chance / maze':<38}{t['without chance'] / t['ours']:>9.1f}")
        found.append(f"{'... its way alone / solution':<38}{t['their way'] / t['our way']:>9.1f}")
    if importlib.util.find_spec("mazelib"):
        from mazelib.generate.BacktrackingGenerator import BacktrackingGenerator

        side = int(count**0.5)
        random.seed(1)
        works = {"ours": lambda: cz.maze(d, rng=1), "theirs": lambda: BacktrackingGenerator(side, side).generate()}
        t = least(works, 2, clock)
        found.append(f"{'mazelib / maze':<38}{t['theirs'] / t['ours']:>9.1f}   at least 50")
    return found or ["neither NetworkX nor mazelib is installed"]


def main() -> None:
    """Print the ratios."""
    parser = argparse.ArgumentParser(description="Time mazes.")
    parser.add_argument("--small", action="store_true", help="few points")
    parser.add_argument("--clock", choices=["wall", "processor"], default="wall", help="what a time is")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the table to a file in this folder")
    given = parser.parse_args()
    clock = time.perf_counter if given.clock == "wall" else time.process_time
    count, runs, few = (2000, 1, 400) if given.small else (1_000_000, 3, 10_000)
    report = [f"{count} points", *own(count, runs, clock)]
    for cells in (few, 10 * few):
        report += ["", f"{cells} cells", *peers(cells, clock)]
    print("\n".join(report))
    if given.folder:
        given.folder.mkdir(parents=True, exist_ok=True)
        (given.folder / "mazes.txt").write_text("\n".join(report) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
