"""From a mask to a recipe whose patterns measure like it."""

from __future__ import annotations

import dataclasses
import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import rng as _rng
from crazing.arguments import count, number
from crazing.errors import CrazingError
from crazing.measure import BORDER, as_mask, measure
from crazing.recipe import Recipe
from crazing.search import CANDIDATES, Progress, minimize
from crazing.statistics import CAP, LEAST_DEVIATION, SCORED, CrackStatistics

#: Pixels of a crop, as in the published figures, and most crops along each side.
CROP, MOST_CROPS = 800, 3
#: Patterns an evaluation measures; the same seeds for every recipe, so that differences are the recipes' own.
PATTERNS = 3
#: So many times as many patterns choose among the best recipes.
FRESH = 3
#: What a fit begins with of steps that a default recipe does without: a little of each, as what there is none of
#: shows nothing of how it would be.
_LIKELY = {"stubs": 0.15, "patchiness": 0.4, "roughness": 0.03, "hairpin": 125.0, "unbend": 2}
#: Lines of one or two pixels measure 2 across, those of three 4; of thin ones that are all alike no widths are known.
THIN, UNEVEN = 3.0, 0.05
#: Patterns whose cracks are all alike, drawn and measured, have up to so wide ones for those in the middle.
ALIKE = 1.2
#: What a fit weighs besides what is scored: how dense and how wide cracks are.
DENSITY = ("segment_length", "intensity", "width")

# Dead ends as a part of the nodes and loops for a junction, for the part of the doors that is open: exact graphs of
# mazes over uniform points.
_OPENINGS = (0.0, 0.2, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0)
_DEAD_ENDS = (0.0, 0.010, 0.048, 0.132, 0.198, 0.282, 0.381, 0.5)
_LOOPS = (0.476, 0.469, 0.447, 0.393, 0.345, 0.273, 0.163, 0.0)


@dataclass(frozen=True)
class _Axis:
    """One number of a recipe that is looked for."""

    name: str
    low: float
    high: float
    spread: float

    def value(self, part: float) -> float:
        return self.low + part * (self.high - self.low)

    def part(self, value: float) -> float:
        return min(max((value - self.low) / (self.high - self.low), 0.0), 1.0)


_AXES = (
    _Axis("relax", 0, 3, 0.3),
    _Axis("patchiness", 0, 1.6, 0.15),
    _Axis("opening", 0, 1, 0.12),
    _Axis("unbend", 0, 8, 0.2),
    _Axis("rounds", 1, 6, 0.2),
    _Axis("pull", 0, 1, 0.3),
    _Axis("slide", 0, 0.6, 0.2),
    _Axis("clamp", 0.05, 0.45, 0.2),
    _Axis("turn", 20, 120, 0.2),
    _Axis("hairpin", 70, 180, 0.25),
    _Axis("roughness", 0, 0.12, 0.15),
    _Axis("warp", 0, 0.3, 0.15),
    _Axis("stubs", 0, 2, 0.1),
    _Axis("stub_length", 0.05, 0.5, 0.15),
    _Axis("anisotropy", 1, 6, 0.08),
    _Axis("thickness", 0.01, 0.5, 0.1),
    _Axis("hierarchy", 0, 1.5, 0.2),
    _Axis("taper", 0, 1, 0.2),
    _Axis("rounding", 0, 1, 0.25),
)
# Which tree: below the middle of its axis cracks are long, above it they are short and branch often.
_TREES = ("depth-first", "kruskal")
_BRANCHING = _Axis("tree", 0, 1, 0.5)
_WIDTHS = ("thickness", "hierarchy", "taper")
# The number of plates is looked for as its root over that of the guess: lengths go with the root.
_ROOT = _Axis("n", 0.6, 1.6, 0.12)


def fit(
    mask: ArrayLike,
    *,
    level: float = 0.5,
    dark: bool = False,
    budget: int = 320,
    seconds: float | None = None,
    rng: _rng.RNG = None,
    progress: Progress | None = None,
) -> Recipe:
    """A recipe whose patterns measure like a mask.

    The mask is measured in square crops. A first guess comes from closed relations (opening from dead ends and
    loops, number of plates from the length of the cracks, widths as they are); a search then makes patterns, draws them
    on as many pixels, and measures them in the same way.

    Parameters
    ----------
    mask : (H, W) or (H, W, 3 or 4) array_like
        A picture, brighter than `level` where there is crack.
    level : float, optional
        Brightness, 0 to 1.
    dark : bool, optional
        Whether cracks are dark on bright ground instead.
    budget : int, optional
        Recipes that are tried, some three patterns each; 0 gives the first guess.
    seconds : float, optional
        Most time, of which the last part goes to a choice among the best recipes by fresh patterns; what is being
        measured then is finished. With it the result depends on the machine; without, the same seed gives the same
        recipe.
    rng : int, numpy.random.Generator or None, optional
        Seed.
    progress : callable, optional
        Called after each recipe with the number of recipes tried and the best distance so far.

    Returns
    -------
    Recipe
        For the unit square as one crop: min(height, width, 800) pixels of the mask.

    Raises
    ------
    TypeError, ValueError
        If the mask is no picture, is crack in more than half of its pixels or too small to be measured, or a number is
        out of range.
    CrazingError
        If the mask holds no junction and no dead end to measure.

    Notes
    -----
    Recipes are mazes, of the depth-first or of Kruskal's tree. No deviation is known of a mask that is one crop: 12 %
    of each mean stands for it, and patterns of one and the same recipe then score about 1 against one another: a recipe
    that scores 1 against the mask is as near as its own kind.

    A mask of lines one or two pixels wide says nothing of widths: then `thickness`, `hierarchy` and `taper` stay as
    they are by default. See :func:`crazing.measure` for what is measured.

    Examples
    --------
    >>> import crazing as cz
    >>> from crazing.measure import stamp
    >>> mask = stamp(cz.crack(n=200, opening=0.6, rng=1), 400)
    >>> 0.3 < cz.fit(mask, budget=0).opening < 0.8
    True
    """
    began = time.monotonic()
    budget = count(budget, "budget", high=1 << 20)
    ending = None if seconds is None else began + number(seconds, "seconds", low=0)
    cracked = as_mask(mask, level=level, dark=dark)
    if (share := float(cracked.mean())) > 0.5:
        raise ValueError(
            f"mask is crack in {share:.0%} of its pixels; cracks fill at most half of a picture, and with "
            f"dark={not dark} what is {'bright' if dark else 'dark'} would be"
        )
    if min(cracked.shape) <= 2 * BORDER:
        raise ValueError(
            f"mask has shape {cracked.shape}; nodes within {BORDER:g} pixels of its sides are not measured, "
            f"so that more than {2 * BORDER:g} are wanted both ways"
        )
    parts = crops(cracked)
    found = [measure(part) for part in parts]
    wanted = _wanted(found)
    if not {"i_nodes", "intensity"} <= wanted.keys() or wanted["intensity"][0] == 0:
        raise CrazingError(
            "the mask has no line with an end or a junction to measure; is it bright where there is crack?"
        )
    side = len(parts[0])
    guess = _guess(wanted, side)
    if budget == 0:
        return guess
    seed = _rng.generator(rng)
    trial = _Trial(guess, _axes(wanted), wanted, side, tuple(_words(seed, PATTERNS)))
    start = np.array([_start(axis, guess) for axis in trial.axes])
    spread = np.array([axis.spread for axis in trial.axes])
    candidates = minimize(
        trial.deviations,
        start,
        spread,
        budget=budget,
        loss=_lure,
        ending=ending,
        spared=CANDIDATES * FRESH,
        rng=seed,
        progress=progress,
    )
    # By patterns that the search has not seen: the best of many is also the luckiest.
    fresh = dataclasses.replace(trial, seeds=tuple(_words(seed, FRESH * PATTERNS)))
    return trial.recipe(_nearest(candidates, fresh, ending))


def _nearest(candidates: Sequence[NDArray[np.float64]], trial: _Trial, ending: float | None) -> NDArray[np.float64]:
    """The candidate whose patterns are nearest, among those that there is time for; the first if there is none."""
    nearest, least = candidates[0], math.inf
    for point in candidates:
        if ending is not None and time.monotonic() > ending:
            break
        if (far := trial.distance(point)) < least:
            nearest, least = point, far
    return nearest


def _start(axis: _Axis, guess: Recipe) -> float:
    """Where on an axis the search begins."""
    if axis is _BRANCHING:
        return 0.5
    return axis.part(1.0 if axis is _ROOT else float(getattr(guess, axis.name)))


def _words(seed: np.random.Generator, size: int) -> list[int]:
    return [_rng.key(seed)[0] for _ in range(size)]


def crops(mask: NDArray[np.bool_]) -> list[NDArray[np.bool_]]:
    """Squares that cover a mask as evenly as their number allows: what a fit measures.

    Parameters
    ----------
    mask : (H, W) bool

    Returns
    -------
    list of (side, side) bool
        `side` is the smallest of height, width and 800; neighbours share half, where that makes 3 a row at most.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.fit import crops
    >>> [each.shape for each in crops(np.zeros((30, 45), bool))]
    [(30, 30), (30, 30)]
    """
    side = min(*mask.shape, CROP)
    # Neighbours share half of what they show, where that is not too many.
    counts = [min(MOST_CROPS, 1 + -(-2 * (length - side) // side)) for length in mask.shape]
    starts = [
        np.linspace(0, length - side, places).astype(int) for length, places in zip(mask.shape, counts, strict=True)
    ]
    return [np.ascontiguousarray(mask[y : y + side, x : x + side]) for y in starts[0] for x in starts[1]]


def _wanted(found: Sequence[CrackStatistics]) -> dict[str, tuple[float, float]]:
    """Mean and deviation over the crops, without what a mask of thin lines cannot tell."""
    wanted = {}
    flat = not any(each.width > THIN or each.width_cv > UNEVEN for each in found)
    for name in (*SCORED, *DENSITY, "direction"):
        values = np.array([getattr(each, name) for each in found])
        values = values[np.isfinite(values)]
        if len(values) and not (flat and name.startswith("width")):
            wanted[name] = (float(values.mean()), float(values.std()))
    return wanted


def _guess(wanted: dict[str, tuple[float, float]], side: int) -> Recipe:
    """A recipe from closed relations alone."""
    dead, loops = wanted["i_nodes"][0], wanted.get("loops_per_junction", (0.0, 0.0))[0]
    by_ends = float(np.interp(dead, _DEAD_ENDS, _OPENINGS))
    by_loops = float(np.interp(-loops, [-x for x in _LOOPS], _OPENINGS))
    opening = (by_ends + by_loops) / 2
    # All walls of n plates in a unit square measure 2 sqrt(n); an open door takes away one of about three a plate.
    root = wanted["intensity"][0] * side / 2 * 3 / (3 - opening)
    values = {
        "n": max(round(root**2), 3),
        "opening": opening,
        "rounds": 3,
        "relax": 1,
        "turn": 50.0,
        **_LIKELY,
        **_skew(wanted),
    }
    if "width" in wanted:
        values["thickness"] = min(wanted["width"][0] / side * root, 0.5)
        if wanted["width_ratio"][0] < ALIKE:
            values |= {"hierarchy": 0.0, "taper": 0.0}
    return Recipe(**_typed(values))


def _skew(wanted: dict[str, tuple[float, float]]) -> dict[str, float]:
    """How far the pattern is drawn out, and which way."""
    order, direction = wanted["orientation"][0], wanted["direction"][0]
    return {"anisotropy": 1 + 2 * order, "angle": direction}


def _typed(values: dict[str, float]) -> dict[str, Any]:
    """Those values that a recipe has, counts rounded."""
    known = {field.name: field.default for field in dataclasses.fields(Recipe)}
    given = {name: value for name, value in values.items() if name in known}
    return {name: round(value) if isinstance(known[name], int) else float(value) for name, value in given.items()}


def _axes(wanted: dict[str, tuple[float, float]]) -> tuple[_Axis, ...]:
    known = {field.name for field in dataclasses.fields(Recipe)}
    kept = [axis for axis in _AXES if axis.name in known and ("width" in wanted or axis.name not in _WIDTHS)]
    return (_ROOT, _BRANCHING, *kept)


@dataclass(frozen=True)
class _Trial:
    """How far the patterns of a recipe are from what is wanted."""

    guess: Recipe
    axes: tuple[_Axis, ...]
    wanted: dict[str, tuple[float, float]]
    side: int
    seeds: tuple[int, ...]

    def recipe(self, point: NDArray[np.float64]) -> Recipe:
        values = {axis.name: axis.value(float(part)) for axis, part in zip(self.axes, point, strict=True)}
        values["n"] = max(self.guess.n * values["n"] ** 2, 3)
        tree = _TREES[values.pop(_BRANCHING.name) > 0.5]
        return self.guess.replace(tree=tree, **_typed(values))

    def deviations(self, point: NDArray[np.float64]) -> NDArray[np.float64]:
        """What is found less what is wanted, in deviations: every statistic of every pattern."""
        recipe = self.recipe(point)
        found = [measure(recipe.crack(rng=seed), raster=self.side) for seed in self.seeds]
        wanted = [(name, pair) for name, pair in self.wanted.items() if name != "direction"]
        far = [(getattr(each, name) - pair[0]) / _scale(*pair) for each in found for name, pair in wanted]
        return np.asarray(np.nan_to_num(np.array(far), nan=CAP, posinf=CAP, neginf=-CAP))

    def distance(self, point: NDArray[np.float64]) -> float:
        """As a score."""
        return float(np.minimum(np.abs(self.deviations(point)), CAP).mean())


def _lure(deviations: NDArray[np.float64]) -> NDArray[np.float64]:
    """A score without flat ground: what lies beyond the cap still says which way is nearer.

    Capped, a statistic that begins far off is given up for lost, and the others are served at its cost.
    """
    far = np.abs(deviations)
    led: NDArray[np.float64] = np.where(far > CAP, CAP * (1 + np.log(np.maximum(far, CAP) / CAP)), far).mean(axis=-1)
    return led


def _scale(mean: float, deviation: float) -> float:
    return max(deviation, LEAST_DEVIATION * abs(mean), 1e-9)
