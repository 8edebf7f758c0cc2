"""Paintings that nothing was tuned on: `fit` finds a recipe for each mask, and its patterns are scored on fresh seeds.

Give masks of cracks, bright on dark. Of each, a recipe is fitted to the whole, and one to its left half that is scored
against its right half, which the fit has not seen. Beside them: what crops of the mask score against all of it; what
patterns of the fitted recipe score against pictures of that recipe, as large as the mask; the thesis' pattern of as
many plates; and the recipes of the other masks. No pattern can be expected to be nearer to a mask than to pictures of
its own kind, and these are not at 0: shares of few nodes vary, and of a mask that is one crop no deviation is known.

A score is the mean difference over the deviation, see `CrackStatistics.score`; a statistic is in range within two
deviations or 24 % of the mean. Without masks two patterns of ours stand in for them.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import crazing as cz
from crazing.fit import CROP, crops
from crazing.images import read_image
from crazing.measure import as_mask, stamp
from crazing.statistics import SCORED, CrackStatistics

#: Seeds that no fit has used, and those of the pictures that stand in for a mask.
FIRST, FIRST_PICTURE = 20_000, 30_000
#: Such pictures of each recipe.
PICTURES = 6

Wanted = dict[str, tuple[float, float]]


@dataclass(frozen=True)
class Model:
    """What the crops of a mask measure: statistics of every crop, their means and deviations, pixels across."""

    found: list[CrackStatistics]
    wanted: Wanted
    side: int

    @classmethod
    def of(cls, mask: NDArray[np.bool_]) -> Model:
        parts = crops(mask)
        found = [cz.measure(part) for part in parts]
        wanted = {}
        for name in SCORED:
            values = np.array([getattr(each, name) for each in found])
            values = values[np.isfinite(values)]
            # Lines one pixel wide say nothing of widths.
            if len(values) and not name.startswith("width"):
                wanted[name] = (float(values.mean()), float(values.std()))
        return cls(found, wanted, len(parts[0]))

    def judge(self, found: list[CrackStatistics]) -> tuple[float, float]:
        """Mean score, and the part of the statistics in range."""
        limits = cz.Targets("", self.side, self.wanted, {})
        held = [flag for each in found for flag in limits.within(each).values()]
        return float(np.mean([each.score(self.wanted) for each in found])), float(np.mean(held))

    def judge_recipe(self, recipe: cz.Recipe, seeds: int) -> tuple[float, float]:
        return self.judge([cz.measure(recipe.crack(rng=FIRST + i), raster=self.side) for i in range(seeds)])


def judge_kin(recipe: cz.Recipe, shape: tuple[int, int], seeds: int) -> tuple[float, float]:
    """What a recipe's patterns score where the mask is a picture of the same recipe."""
    high, wide = shape
    side = min(high, wide, CROP)
    whole = recipe.replace(n=round(recipe.n * high * wide / side**2))
    box = (0, 0, wide / side, high / side)
    pictures = [stamp(whole.crack(bounds=box, rng=FIRST_PICTURE + i), wide) for i in range(PICTURES)]
    found = [cz.measure(recipe.crack(rng=FIRST + i), raster=side) for i in range(seeds)]
    score, held = np.mean([Model.of(picture).judge(found) for picture in pictures], axis=0)
    return float(score), float(held)


def own_masks(side: int) -> dict[str, NDArray[np.bool_]]:
    recipes = {"maze": cz.Recipe(n=90, opening=0.6, rounds=3, relax=1), "split": cz.Recipe(generator="splitting", n=60)}
    return {name: stamp(recipe.crack(bounds=(0, 0, 2, 1), rng=1), 2 * side) for name, recipe in recipes.items()}


def table(masks: dict[str, NDArray[np.bool_]], budget: int, seeds: int, folder: Path | None) -> str:
    models = {name: Model.of(mask) for name, mask in masks.items()}
    fitted = {name: cz.fit(mask, budget=budget, rng=1) for name, mask in masks.items()}
    lines = [f"{'mask':24}{'scored':34}{'score':>6}{'in range':>10}"]

    def row(name: str, what: str, judged: tuple[float, float]) -> None:
        lines.append(f"{name:24}{what:34}{judged[0]:6.2f}{judged[1]:10.0%}")
        print(lines[-1], flush=True)

    for name, mask in masks.items():
        model = models[name]
        row(name, "its own crops", model.judge(model.found))
        row(name, "fitted to it", model.judge_recipe(fitted[name], seeds))
        row(name, "that, on pictures of its own", judge_kin(fitted[name], mask.shape, seeds))
        left, right = np.array_split(mask, 2, axis=1)
        half = cz.fit(left, budget=budget, rng=1)
        other = Model.of(right)
        row(name, "fitted to the left, on the right", other.judge_recipe(half, seeds))
        row(name, "left crops, on the right", other.judge(Model.of(left).found))
        for stranger in sorted(fitted.keys() - {name}):
            row(name, f"fitted to {stranger}", model.judge_recipe(fitted[stranger], seeds))
        row(name, "thesis", model.judge_recipe(cz.Recipe(n=fitted[name].n), seeds))
        if folder is not None:
            fitted[name].save(folder / f"{name}.toml")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("masks", nargs="*", type=Path, help="pictures of masks")
    parser.add_argument("--budget", type=int, default=320, help="recipes tried for each")
    parser.add_argument("--seeds", type=int, default=20, help="patterns scored")
    parser.add_argument("--small", action="store_true", help="small masks of ours, a few recipes")
    parser.add_argument("-o", dest="folder", type=Path, help="also write table and recipes into this folder")
    arguments = parser.parse_args()
    if arguments.folder is not None:
        arguments.folder.mkdir(parents=True, exist_ok=True)
    masks = {path.stem: as_mask(read_image(path)) for path in arguments.masks}
    budget, seeds = (3, 2) if arguments.small else (arguments.budget, arguments.seeds)
    found = table(masks or own_masks(240 if arguments.small else 800), budget, seeds, arguments.folder)
    if arguments.folder is not None:
        (arguments.folder / "unseen.txt").write_text(found + "\n")


if __name__ == "__main__":
    main()
