"""Crust, edge filter and one-step against the same pipeline on SciPy, and on Shewchuk's Triangle with NumPy.

``python python/benchmarks/skeletons.py`` prints two tables: what each step of ours costs beside the diagram, and time,
peak memory and crust edges of whole pipelines. Every pipeline runs in a process of its own, so that a peak is its own.
Samples of a curve have exactly as many crust edges as samples; where a pipeline finds another number, it is wrong.

Triangle is timed where the package ``triangle`` is installed; crazing does not need it. Sites on one circle, as on
either side of a mirror line, have one Voronoi vertex, which its pipeline computes once a triangle, a rounding apart.
Joining these copies counts as axis (all of ``coincident`` below that its second triangulation keeps), and an edge that
the second triangulation hangs on the other copy is lost. So its count is given as it is, and once more with copies
merged by the rule of crazing (1e-9 of the radius), untimed: this is the one to compare, and it is equal.
"""

from __future__ import annotations

import argparse
import importlib
import importlib.util
import json
import math
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Indices = NDArray[np.int32]
Mask = NDArray[np.bool_]
#: Seconds of each step of a pipeline by name, and how many edges it found.
Outcome = tuple[dict[str, float], dict[str, int]]


def uniform(count: int) -> Points:
    return np.random.default_rng(1).random((count, 2))


def curve(count: int) -> Points:
    """A flower, sampled evenly by angle."""
    t = np.linspace(0, 2 * np.pi, count, endpoint=False)
    r = 1000 * (1 + 0.3 * np.cos(5 * t) + 0.1 * np.cos(13 * t))
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


DATA = {"uniform": uniform, "curve": curve}


def crazing(points: Points, clock: Callable[[], float]) -> Outcome:
    """Diagram, then each method from it, as a user calls them."""
    import crazing as cz

    marks = [clock()]
    diagram = cz.diagram(points)
    marks.append(clock())
    one_step = cz.medial_axis(diagram, method="one-step")
    marks.append(clock())
    two_pass = cz.crust(diagram, method="two-pass")
    marks.append(clock())
    filtered = cz.medial_axis(diagram, method="edge-filter")
    marks.append(clock())
    seconds = dict(zip(("diagram", "one-step", "two-pass", "edge-filter"), np.diff(marks).tolist(), strict=True))
    return seconds, {
        "one-step": len(one_step.crust.edges),
        "two-pass": len(two_pass.edges),
        "axis": int(filtered.axis_mask.sum()) if filtered.axis_mask is not None else 0,
    }


def one_step(points: Points, edges: Indices, vertices: Points, dual: Indices) -> Mask:
    """Gold and Snoeyink's test in floating point: some circle through both ends holds neither end of the dual."""
    p, q = points[edges[:, 0]], points[edges[:, 1]]
    along, middle = q - p, (p + q) / 2
    half = np.hypot(*along.T) / 2
    normal = np.column_stack([-along[:, 1], along[:, 0]]) / (2 * half[:, None])
    first, second = (((vertices[dual[:, side]] - middle) * normal).sum(axis=1) for side in (0, 1))
    # An edge of the hull is crust when its one vertex lies on the side of the other sites, which is that of their mean.
    inner = ((points.mean(axis=0) - middle) * normal).sum(axis=1)
    one = np.where(dual[:, 0] < 0, second, first)
    kept: Mask = np.where((dual < 0).any(axis=1), one * inner > 0, -first * second >= half**2)
    return kept


def keys(pairs: Indices) -> NDArray[np.int64]:
    """One number a pair, whatever its order."""
    ordered = np.sort(pairs, axis=1).astype(np.int64)
    return (ordered[:, 0] << 32) | ordered[:, 1]


def counted(points: Points, second: Indices, first: tuple[Indices, Points, Indices]) -> dict[str, int]:
    """Edges of every kind by the second triangulation's edges and the first one's edges, vertices and dual edges."""
    edges, vertices, dual = first
    low, high = second.min(axis=1), second.max(axis=1)
    axis = keys(second[low >= len(points)] - len(points))
    return {
        "one-step": int(one_step(points, edges, vertices, dual).sum()),
        "two-pass": int((high < len(points)).sum()),
        "axis": int(np.isin(keys(dual), axis).sum()),
    }


def simplex_edges(simplices: Indices) -> Indices:
    corners = np.concatenate([simplices[:, [0, 1]], simplices[:, [1, 2]], simplices[:, [2, 0]]])
    found = np.unique(keys(corners))
    return np.column_stack([found >> 32, found & 0xFFFFFFFF]).astype(np.int32)


def scipy(points: Points, clock: Callable[[], float]) -> Outcome:
    """Delaunay, Voronoi, Delaunay of sites and vertices, masks by NumPy."""
    from scipy.spatial import Delaunay, Voronoi

    start = clock()
    Delaunay(points)
    voronoi = Voronoi(points)
    second = simplex_edges(Delaunay(np.concatenate([points, voronoi.vertices])).simplices)
    first = voronoi.ridge_points.astype(np.int32), voronoi.vertices, np.asarray(voronoi.ridge_vertices, dtype=np.int32)
    found = counted(points, second, first)
    return {"all": clock() - start}, found


def circumcentres(points: Points, triangles: Indices) -> Points:
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    b, c = b - a, c - a
    b2, c2 = (b**2).sum(axis=1), (c**2).sum(axis=1)
    twice = 2 * (b[:, 0] * c[:, 1] - b[:, 1] * c[:, 0])
    offset = np.column_stack([c[:, 1] * b2 - b[:, 1] * c2, b[:, 0] * c2 - c[:, 0] * b2])
    return np.asarray(a + offset / twice[:, None])


def duals(triangles: Indices, neighbours: Indices) -> tuple[Indices, Indices]:
    """Edges and dual edges, each once, from the neighbour opposite each corner."""
    own = np.repeat(np.arange(len(triangles), dtype=np.int32), 3)
    other = neighbours.ravel().astype(np.int32)
    ends = np.stack([np.roll(triangles, -1, axis=1), np.roll(triangles, -2, axis=1)], axis=2).reshape(-1, 2)
    once = own > other
    return ends[once].astype(np.int32), np.column_stack([own, other])[once]


def distinct(points: Points, vertices: Points, triangles: Indices, dual: Indices) -> tuple[Points, Indices]:
    """The vertices without copies in neighbouring triangles, the lowest standing for all, and the dual edges so."""
    radius = np.hypot(*(vertices - points[triangles[:, 0]]).T)
    finite = dual[(dual >= 0).all(axis=1)]
    gap = np.hypot(*(vertices[finite[:, 0]] - vertices[finite[:, 1]]).T)
    pairs = finite[gap <= 1e-9 * radius[finite].max(axis=1)]
    lowest = np.arange(len(vertices), dtype=np.int32)
    before = None
    while before is None or (lowest != before).any():
        before = lowest.copy()
        for side in (0, 1):
            np.minimum.at(lowest, pairs[:, side], before[pairs].min(axis=1))
    kept, place = np.unique(lowest, return_inverse=True)
    # The last one is infinity.
    return vertices[kept], np.append(place, -1).astype(np.int32)[dual]


def triangle(points: Points, clock: Callable[[], float]) -> Outcome:
    """Two triangulations by Shewchuk's Triangle, the rest by NumPy."""
    triangulate: Callable[[dict[str, Points], str], dict[str, Any]] = importlib.import_module("triangle").triangulate
    start = clock()
    found = triangulate({"vertices": points}, "n")
    vertices = circumcentres(points, found["triangles"])
    edges, dual = duals(found["triangles"], found["neighbors"])
    second = triangulate({"vertices": np.concatenate([points, vertices])}, "e")["edges"].astype(np.int32)
    counts = counted(points, second, (edges, vertices, dual))
    return {"all": clock() - start}, counts


def merged(points: Points) -> dict[str, int]:
    """What Triangle's pipeline counts when it is given every Voronoi vertex once."""
    triangulate: Callable[[dict[str, Points], str], dict[str, Any]] = importlib.import_module("triangle").triangulate
    found = triangulate({"vertices": points}, "n")
    edges, dual = duals(found["triangles"], found["neighbors"])
    every = circumcentres(points, found["triangles"])
    vertices, dual = distinct(points, every, found["triangles"], dual)
    second = triangulate({"vertices": np.concatenate([points, vertices])}, "e")["edges"].astype(np.int32)
    axis = counted(points, second, (edges, vertices, dual))["axis"]
    return {"merged axis": axis, "coincident": len(every) - len(vertices)}


PIPELINES: dict[str, Callable[[Points, Callable[[], float]], Outcome]] = {
    "crazing": crazing,
    "scipy": scipy,
    "triangle": triangle,
}
CLOCKS: dict[str, Callable[[], float]] = {"wall": time.perf_counter, "processor": time.process_time}


def work(name: str, data: str, count: int, clock: str) -> None:
    """Run one pipeline in this process, and print what it took as JSON: each step's least time of some runs."""
    points = DATA[data](count)
    runs = 3 if name == "crazing" or count <= 10_000 else 1
    outcomes = [PIPELINES[name](points, CLOCKS[clock]) for _ in range(runs)]
    seconds = {step: min(times[step] for times, _ in outcomes) for step in outcomes[0][0]}
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    more = merged(points) if name == "triangle" else {}
    print(json.dumps({"seconds": seconds, "peak": peak, "found": outcomes[0][1] | more}))


def apart(name: str, data: str, count: int, clock: str) -> dict[str, Any]:
    """The same in a process of its own."""
    command = [sys.executable, __file__, "--worker", name, data, str(count), "--clock", clock]
    result: dict[str, Any] = json.loads(subprocess.run(command, check=True, text=True, capture_output=True).stdout)
    return result


def line(*cells: object) -> str:
    return "".join(f"{cell:>13.3f}" if isinstance(cell, float) else f"{cell!s:>13}" for cell in cells).rstrip()


def steps(ours: dict[tuple[str, int], dict[str, Any]]) -> list[str]:
    """Each step of ours as a ratio to the diagram, and how the cost of a point grows beside the logarithm of n."""
    table = [line("points", "data", "ns/point", "growth", "log growth", "one-step", "two-pass", "edge-filter", "all")]
    before: dict[str, tuple[int, float]] = {}
    for (data, count), result in ours.items():
        seconds = result["seconds"]
        whole, total = seconds["diagram"], sum(seconds.values())
        size, cost = before.get(data, (count, total / count))
        before[data] = count, total / count
        growth = total / count / cost, math.log(count) / math.log(size)
        ratios = [seconds[step] / whole for step in ("one-step", "two-pass", "edge-filter")]
        table.append(line(count, data, f"{1e9 * total / count:.0f}", *growth, *ratios, total / whole))
    return table


def against(ours: dict[tuple[str, int], dict[str, Any]], peers: list[str], clock: str) -> list[str]:
    """Whole pipelines: the peer's time and peak memory over ours, and the crust edges that each finds."""
    table = [
        line("points", "data", "pipeline", "seconds", "times ours", "MiB", "MiB / ours")
        + line("one-step", "two-pass", "axis", "merged axis", "coincident")
    ]
    for (data, count), mine in ours.items():
        results = {"crazing": mine, **{peer: apart(peer, data, count, clock) for peer in peers}}
        for name, result in results.items():
            seconds, base = (sum(each["seconds"].values()) for each in (result, mine))
            ratios = seconds / base, result["peak"] / 1024, result["peak"] / mine["peak"]
            table.append(line(count, data, name, seconds, *ratios, *result["found"].values()))
    return table


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description="Time whole skeleton pipelines.")
    parser.add_argument("--small", action="store_true", help="few points, against SciPy alone")
    parser.add_argument("--sizes", type=int, nargs="+", default=[10_000, 100_000])
    parser.add_argument("--peers", nargs="*", choices=["scipy", "triangle"], default=["scipy", "triangle"])
    parser.add_argument("--clock", choices=[*CLOCKS], default="wall", help="what a time is")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the tables to a file in this folder")
    parser.add_argument("--worker", nargs=3, help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.worker:
        name, data, count = given.worker
        work(name, data, int(count), given.clock)
        return
    sizes = [500, 1000] if given.small else given.sizes
    peers = [
        peer for peer in given.peers if importlib.util.find_spec(peer) and not (given.small and peer == "triangle")
    ]
    ours = {(data, count): apart("crazing", data, count, given.clock) for data in DATA for count in sizes}
    report = ["steps, as ratios to the diagram", *steps(ours), ""]
    print("\n".join(report), flush=True)
    report += ["whole pipelines", *against(ours, peers, given.clock), ""]
    print("\n".join(report[report.index("whole pipelines") :]), flush=True)
    if given.folder:
        given.folder.mkdir(parents=True, exist_ok=True)
        (given.folder / "skeletons.txt").write_text("\n".join(report), encoding="utf-8")


if __name__ == "__main__":
    main()
