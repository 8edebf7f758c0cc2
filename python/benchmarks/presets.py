"""How near every preset comes to its targets on fresh seeds: part of the statistics in range, and score.

A score is given where masks were measured; see `CrackStatistics.score`.
"""

from __future__ import annotations

import argparse
from collections import Counter
from pathlib import Path

import numpy as np

import crazing as cz

#: Seeds that no search has used.
FIRST = 10_000


def row(name: str, seeds: int) -> tuple[int, int, str]:
    targets = cz.targets(name)
    recipe = cz.preset(name)
    found = [targets.measure(recipe.crack(rng=FIRST + seed)) for seed in range(seeds)]
    flags = [targets.within(each) for each in found]
    held = sum(sum(each.values()) for each in flags)
    total = sum(map(len, flags))
    misses = Counter(name for each in flags for name, is_in in each.items() if not is_in)
    scores = [each.score(targets.measured) for each in found] if targets.measured else []
    score = f"{np.mean(scores):6.2f}" if scores else "     -"
    worst = ", ".join(f"{name} {count / seeds:.0%}" for name, count in misses.most_common(3))
    return held, total, f"{name:20}{held / total:7.1%} {score}   {worst}"


def table(names: list[str], seeds: int) -> str:
    lines = [f"{'preset':20}{'in range':>7} {'score':>5}   most often out of range"]
    held = total = 0
    for name in names:
        good, all_of_it, line = row(name, seeds)
        held, total = held + good, total + all_of_it
        lines.append(line)
        print(line, flush=True)
    return "\n".join([*lines, f"{'all':20}{held / total:7.1%}, {seeds} seeds"])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=list(cz.presets()), help="presets; all by default")
    parser.add_argument("--seeds", type=int, default=200)
    parser.add_argument("--small", action="store_true", help="one seed")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the table to a file in this folder")
    arguments = parser.parse_args()
    found = table(arguments.names, 1 if arguments.small else arguments.seeds)
    print(found.splitlines()[-1])
    if arguments.folder is not None:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        (arguments.folder / "presets.txt").write_text(found + "\n")


if __name__ == "__main__":
    main()
