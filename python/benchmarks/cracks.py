"""Times of crack recipes as ratios: a full recipe to its diagram, presets to SciPy's Voronoi of as many points.

Processor time of all threads, and wall time beside it; every pair is timed in turn, and the least of the rounds counts.
"""

import argparse
import json
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from scipy.spatial import Voronoi

import crazing as cz

FULL = cz.preset("painting-italian")
FRAME = 16.0


def times(work: dict[str, Callable[[], object]], rounds: int) -> dict[str, tuple[float, float]]:
    """Least (processor, wall) seconds of each, taken in turn."""
    best = dict.fromkeys(work, (np.inf, np.inf))
    for _ in range(rounds):
        for name, call in work.items():
            start = time.process_time(), time.perf_counter()
            call()
            spent = time.process_time() - start[0], time.perf_counter() - start[1]
            best[name] = min(best[name][0], spent[0]), min(best[name][1], spent[1])
    return best


def full(n: int, rounds: int) -> list[dict[str, object]]:
    """The whole recipe and its parts, as ratios to the diagram of as many uniform points."""
    points = cz.sample.uniform(n, rng=1)
    d = cz.diagram(points)
    carved = cz.maze(d, opening=FULL.opening, bounds=(0, 0, 1, 1), rng=1)
    plain = cz.steps.walls(carved)
    straight = cz.steps.straighten(plain, rounds=FULL.rounds)
    unit = 1 / np.sqrt(n)
    how = {"roughness": FULL.roughness, "unit": unit, "grain": FULL.grain}
    rough = cz.steps.roughen(straight, **how, rng=1)
    work = {
        "diagram": lambda: cz.diagram(points),
        f"relax, {FULL.relax} rounds": lambda: cz.sample.relax(points, iterations=FULL.relax, bounds=(0, 0, 1, 1)),
        "maze": lambda: cz.maze(d, opening=FULL.opening, bounds=(0, 0, 1, 1), rng=1),
        "walls and strands": lambda: cz.steps.walls(carved),
        f"straighten, {FULL.rounds} rounds": lambda: cz.steps.straighten(plain, rounds=FULL.rounds),
        "roughen": lambda: cz.steps.roughen(straight, **how, rng=1),
        "widen": lambda: cz.steps.widen(rough, width=0.1 * unit),
        "splitting": lambda: cz.steps.split(n, rng=1),
        "full recipe": lambda: FULL.replace(n=n).crack(rng=1),
    }
    best = times(work, rounds)
    base = best["diagram"]
    rows = [
        {"what": name, "n": n, "processor": cpu / base[0], "wall": wall / base[1]} for name, (cpu, wall) in best.items()
    ]
    print(f"{n} plates, diagram {1e3 * base[0]:.0f} ms of processor, {1e3 * base[1]:.0f} ms")
    for row in rows:
        print(f"  {row['what']:<24} {row['processor']:6.2f} x the diagram, wall {row['wall']:6.2f} x")
    return rows


def small(n: int, rounds: int) -> list[dict[str, object]]:
    """Presets of n plates: milliseconds, and the ratio to SciPy's Voronoi of n points."""
    points = cz.sample.uniform(n, rng=1)
    work: dict[str, Callable[[], object]] = {"SciPy's Voronoi": lambda: Voronoi(points)}
    for name in cz.presets():
        work[name] = partial(cz.preset(name).replace(n=n).crack, rng=1)
    best = times(work, rounds)
    base = best["SciPy's Voronoi"][0]
    rows = []
    print(f"presets at {n} plates, diagram included; a frame has {FRAME:.0f} ms")
    for name, (cpu, wall) in best.items():
        rows.append({"what": name, "n": n, "ms": 1e3 * cpu, "wall": 1e3 * wall, "ratio": cpu / base})
        print(f"  {name:<24} {1e3 * cpu:6.1f} ms, {cpu / base:6.2f} x SciPy's Voronoi; wall {1e3 * wall:6.1f} ms")
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the JSON is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    rows = full(2_000 if given.small else 1_000_000, 1 if given.small else 3)
    rows += small(300, 1 if given.small else 20)
    (given.output / "cracks.json").write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
