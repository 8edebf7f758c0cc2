"""Times of crack recipes as ratios: recipes with every step, and with one of each, and presets to the diagram of as
many points (and SciPy's Delaunay, which no change of ours makes faster), small presets to SciPy's Voronoi.

Processor time of all threads, and wall time beside it; every pair is timed in turn, and the least of the rounds counts.
Beside the times stands what explains them: how much of the processor time is the system's, which clears fresh memory,
how many pages of memory were touched for the first time, and how much of it was spent by the calling thread alone.
"""

import argparse
import json
import resource
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay, Voronoi

import crazing as cz

#: Every step of a maze's cracks. Numbers of its own, not those of a preset, so that figures of two versions compare.
FULL = cz.Recipe(
    relax=3,
    opening=0.3816,
    anisotropy=1.4703,
    rounds=3,
    pull=0.1713,
    slide=0.3842,
    clamp=0.0884,
    warp=0.0384,
    turn=40.0,
    stubs=0.5425,
    stub_length=0.3515,
    stub_spread=0.0595,
    roughness=0.0108,
    rounding=0.7049,
    grain=0.1,
    thickness=0.05,
    hierarchy=0.4,
    taper=0.45,
    unevenness=0.2,
)
#: One of each step, and no more: two that measured like paintings when steps were first tried.
PLAIN = {
    "relaxed twice, 5 rounds": cz.Recipe(
        relax=2, opening=0.57, rounds=5, pull=0.64, slide=0.18, clamp=0.2, roughness=0.01
    ),
    "relaxed once, warped": cz.Recipe(
        relax=1, opening=0.8, rounds=2, pull=0.6, slide=0.39, clamp=0.34, roughness=0.02, warp=0.006
    ),
}
FRAME = 16.0
#: What is measured, in this order: seconds, but pages.
MEASURES = ("processor", "wall", "system", "alone", "pages")


def now() -> NDArray[np.float64]:
    """The measures up to now."""
    used = resource.getrusage(resource.RUSAGE_SELF)
    processor = used.ru_utime + used.ru_stime
    return np.array([processor, time.perf_counter(), used.ru_stime, time.thread_time(), used.ru_minflt])


def times(work: dict[str, Callable[[], object]], rounds: int) -> dict[str, NDArray[np.float64]]:
    """Least measures of each, taken in turn."""
    best = {name: np.full(len(MEASURES), np.inf) for name in work}
    for _ in range(rounds):
        for name, call in work.items():
            start = now()
            found = call()
            best[name] = np.minimum(best[name], now() - start)
            del found
    return best


def full(n: int, rounds: int) -> list[dict[str, object]]:
    """The whole recipe and its steps, as ratios to the diagram of as many uniform points."""
    points = cz.sample.uniform(n, rng=1)
    d = cz.diagram(points)
    carved = cz.maze(d, opening=FULL.opening, bounds=(0, 0, 1, 1), rng=1)
    plain = cz.steps.walls(carved)
    straight = cz.steps.follow(cz.steps.straighten(plain, rounds=FULL.rounds), turn=FULL.turn)
    unit = 1 / np.sqrt(n)
    branches = {"rate": FULL.stubs, "length": FULL.stub_length, "spread": FULL.stub_spread, "unit": unit}
    how = {"roughness": FULL.roughness, "rounding": FULL.rounding, "unit": unit, "grain": FULL.grain}
    grown = cz.steps.stubs(straight, **branches, rng=1)
    rough = cz.steps.roughen(grown, **how, rng=1)
    work: dict[str, Callable[[], object]] = {
        "diagram": lambda: cz.diagram(points),
        f"relax, {FULL.relax} rounds": lambda: cz.sample.relax(points, iterations=FULL.relax, bounds=(0, 0, 1, 1)),
        "maze": lambda: cz.maze(d, opening=FULL.opening, bounds=(0, 0, 1, 1), rng=1),
        "walls and strands": lambda: cz.steps.walls(carved),
        f"straighten, {FULL.rounds} rounds": lambda: cz.steps.straighten(plain, rounds=FULL.rounds),
        "follow": lambda: cz.steps.follow(straight, turn=FULL.turn),
        "warp": lambda: cz.steps.warp(straight, amplitude=FULL.warp * unit, rng=1),
        "stubs": lambda: cz.steps.stubs(straight, **branches, rng=1),
        "roughen": lambda: cz.steps.roughen(grown, **how, rng=1),
        "widen": lambda: cz.steps.widen(rough, width=0.1 * unit, unevenness=FULL.unevenness, unit=unit),
        "splitting": lambda: cz.steps.split(n, rng=1),
        "full recipe": lambda: FULL.replace(n=n).crack(rng=1),
        **{name: partial(recipe.replace(n=n).crack, rng=1) for name, recipe in PLAIN.items()},
        "SciPy's Delaunay": lambda: Delaunay(points),
    }
    best = times(work, rounds)
    base = best["diagram"]
    rows = []
    print(f"{n} plates, diagram {1e3 * base[0]:.0f} ms of processor, {1e3 * base[1]:.0f} ms; {len(rough.edges)} pieces")
    for name, found in best.items():
        processor, wall, system, alone = (*(found[:2] / base[:2]), *(found[2:4] / base[0]))
        rows.append({"what": name, "n": n, "processor": processor, "wall": wall, "system": system, "alone": alone})
        print(f"  {name:<24} {processor:6.2f} x the diagram, wall {wall:6.2f} x", end="")
        print(f"; system {system:5.2f}, on one thread {alone:5.2f}, pages {found[4]:9.0f}")
    return rows


def large(n: int, rounds: int) -> list[dict[str, object]]:
    """Presets of n plates, as ratios to the diagram of as many points; impacts have what their speed makes."""
    points = cz.sample.uniform(n, rng=1)
    rows = []
    print(f"presets at {n} plates, beside their diagram")
    for name in (name for name in cz.presets() if cz.preset(name).generator != "impact"):
        call = partial(cz.preset(name).replace(n=n).crack, rng=1)
        best = times({"diagram": lambda: cz.diagram(points), name: call}, rounds)
        processor, wall = best[name][:2] / best["diagram"][:2]
        rows.append({"what": name, "n": n, "processor": processor, "wall": wall})
        print(f"  {name:<24} {processor:6.2f} x the diagram, wall {wall:6.2f} x", flush=True)
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
    for name, (cpu, wall, *_) in best.items():
        rows.append({"what": name, "n": n, "ms": 1e3 * cpu, "wall": 1e3 * wall, "ratio": cpu / base})
        print(f"  {name:<24} {1e3 * cpu:6.1f} ms, {cpu / base:6.2f} x SciPy's Voronoi; wall {1e3 * wall:6.1f} ms")
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, for checks")
    parser.add_argument("-o", "--output", type=Path, metavar="FOLDER", help="also write the figures here as JSON")
    given = parser.parse_args()
    n, rounds = (2_000, 1) if given.small else (1_000_000, 3)
    rows = full(n, rounds) + large(n, min(rounds, 2))
    rows += small(300, 1 if given.small else 20)
    if given.output:
        given.output.mkdir(parents=True, exist_ok=True)
        (given.output / "cracks.json").write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
