"""Looking for the numbers that make an expensive, noisy function small, without its slopes."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from crazing import rng as _rng
from crazing import sample

Objective: TypeAlias = Callable[[NDArray[np.float64]], "float | NDArray[np.float64]"]
Loss: TypeAlias = Callable[[NDArray[np.float64]], NDArray[np.float64]]
Progress: TypeAlias = Callable[[int, float], Any]

#: Trials a generation, and the best of them that the next one is drawn about: half, as fewer are the lucky ones of a
#: noisy function. How many are remembered of all.
TRIALS, ELITE, KEPT = 16, 8, 4
#: What comes of a search: those that are remembered, the middle of the last generation, the start.
CANDIDATES = KEPT + 2
#: What the spread keeps of its old self, so that one lucky generation does not end the search, and its smallest value.
INERTIA, LEAST_SPREAD = 0.5, 0.015
#: With a loss, so many trials of a generation are the best of so many draws by a linear model of the last trials; what
#: holds its slopes down, and how much wider than the others these draws are.
FORESEEN, DRAWS, RIDGE, REACH = 8, 256, 0.1, 1.5
#: Trials that the model is of, at most.
MEMORY = 320


def minimize(
    objective: Objective,
    start: Sequence[float] | NDArray[np.float64],
    spread: Sequence[float] | NDArray[np.float64],
    *,
    budget: int,
    loss: Loss | None = None,
    ending: float | None = None,
    spared: int = 0,
    rng: _rng.RNG = None,
    progress: Progress | None = None,
) -> list[NDArray[np.float64]]:
    """Look for the point of the unit cube where a function is smallest.

    The cross-entropy method: trials are drawn from a normal distribution along each axis, which moves and shrinks to
    the best of them. Where the function is a loss of many residuals, half of the trials are the best of many draws by
    a linear model of the residuals: from each trial it learns as many numbers as there are. With the same seed and
    `budget` the result is the same; an `ending` makes it depend on the machine.

    Parameters
    ----------
    objective : callable
        Takes a point of the unit cube. The smaller its result the better; with `loss` it gives (m,) residuals.
    start, spread : (d,) array_like
        Where the search begins, and how far it looks along each axis; 0 keeps a coordinate.
    budget : int
        Most evaluations.
    loss : callable, optional
        Takes residuals, (..., m), and gives what is to be small, (...).
    ending : float, optional
        When to stop, by `time.monotonic`; the evaluation that runs is finished.
    spared : int, optional
        So many evaluations, of those so far, take no longer than what is then left.
    rng : int, numpy.random.Generator or None, optional
        Seed.
    progress : callable, optional
        Called after each evaluation with the number of evaluations and the smallest value so far.

    Returns
    -------
    list of (d,) float64
        Candidates, of which the caller may choose by a better look: the best points tried, best first, the middle of
        the last generation, the start.

    Examples
    --------
    >>> from crazing.search import minimize
    >>> found = minimize(lambda x: ((x - 0.3) ** 2).sum(), [0.5, 0.5], [0.3, 0.3], budget=200, rng=1)
    >>> bool(abs(found[0] - 0.3).max() < 0.03)
    True

    Notes
    -----
    Source: Rubinstein, The cross-entropy method for combinatorial and continuous optimization, 1999.
    """
    seed = _rng.generator(rng)
    began = time.monotonic()
    middle, width = np.asarray(start, dtype=np.float64), np.asarray(spread, dtype=np.float64)
    first, kept = middle, [(np.inf, 0, middle)]
    seen: list[tuple[NDArray[np.float64], NDArray[np.float64]]] = []
    spent = 0
    while spent < budget:
        points = _drawn(middle, width, TRIALS, seed)
        if spent == 0:
            points[0] = first
        elif loss is not None:
            points[:FORESEEN] = _foreseen(seen[-MEMORY:], middle, width, loss, seed)
        values = np.full(len(points), np.inf)
        for i, point in enumerate(points[: budget - spent]):
            found = np.asarray(objective(point), dtype=np.float64)
            seen.append((point, found))
            values[i] = found if loss is None else loss(found)
            spent += 1
            kept = sorted([*kept, (float(values[i]), spent, point)], key=lambda each: each[:2])[:KEPT]
            if progress is not None:
                progress(spent, kept[0][0])
            now = time.monotonic()
            if ending is not None and now + spared * (now - began) / spent > ending:
                return [*(each[2] for each in kept), middle, first]
        if np.isfinite(values).sum() >= ELITE:
            elite = points[np.argsort(values, kind="stable")[:ELITE]]
            middle = elite.mean(axis=0)
            fresh = INERTIA * width + (1 - INERTIA) * elite.std(axis=0)
            width = np.where(width > 0, np.maximum(fresh, LEAST_SPREAD), 0.0)
    return [*(each[2] for each in kept), middle, first]


def _drawn(
    middle: NDArray[np.float64], width: NDArray[np.float64], trials: int, seed: np.random.Generator
) -> NDArray[np.float64]:
    """Some trials in the unit cube: what falls outside is put on its side."""
    draws = sample.normal(trials * len(middle), rng=seed)[:, 0].reshape(trials, len(middle))
    return np.asarray(np.clip(middle + width * draws, 0.0, 1.0))


def _foreseen(
    seen: list[tuple[NDArray[np.float64], NDArray[np.float64]]],
    middle: NDArray[np.float64],
    width: NDArray[np.float64],
    loss: Loss,
    seed: np.random.Generator,
) -> NDArray[np.float64]:
    """Of several lots of draws each the one that has the smallest loss by a linear model of the residuals."""
    safe = np.where(width > 0, width, 1.0)
    away = np.array([(point - middle) / safe for point, _ in seen])
    # Those near count most: the model is linear, what it is of is not.
    weight = 1 / (1 + (away**2).mean(axis=1))
    rows = np.column_stack([np.ones(len(away)), away])
    held = RIDGE * weight.sum() * np.diag([0.0, *np.ones(len(middle))])
    slopes = np.linalg.solve(rows.T * weight @ rows + held, rows.T * weight @ np.array([found for _, found in seen]))
    draws = _drawn(middle, REACH * width, FORESEEN * DRAWS, seed)
    expected = loss(slopes[0] + (draws - middle) / safe @ slopes[1:]).reshape(FORESEEN, DRAWS)
    # Rounded, so that last bits, in which platforms differ, do not choose.
    best = np.round(expected, 6).argmin(axis=1)
    return np.asarray(draws.reshape(FORESEEN, DRAWS, -1)[np.arange(FORESEEN), best])
