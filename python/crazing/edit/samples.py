"""Point sets that the page can ask for: the samplers, and outlines to begin with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import arguments, sample
from crazing.edit.knobs import SEED, Knob, choice, count

#: Samplers by the word of `crazing.sample`, and outlines.
SAMPLERS = ("uniform", "normal", "laplace", "poisson_disk")
OUTLINES = ("star", "flower", "blob")

#: What the page turns to make points.
KNOBS: tuple[Knob, ...] = (
    choice("sampler", "Distribution", (*SAMPLERS, *OUTLINES)),
    count("n", "Number", 300, 1, 100_000),
    SEED,
)


def points_of(sampler: str, n: int, seed: int) -> NDArray[np.float64]:
    """The points of one sampler or outline.

    Parameters
    ----------
    sampler : str
        One of `SAMPLERS`, over the unit square or about the origin, or of `OUTLINES`, evenly along them.
    n : int
        How many; a Poisson-disk sample has about as many.
    seed : int
        Of the samplers; outlines have none.

    Returns
    -------
    (n, 2) float64

    Examples
    --------
    >>> from crazing.edit.samples import points_of
    >>> points_of("star", 100, 0).shape
    (100, 2)
    """
    arguments.choice(sampler, "sampler", (*SAMPLERS, *OUTLINES))
    if sampler in OUTLINES:
        return _outline(sampler, n)
    if sampler == "poisson_disk":
        return sample.poisson_disk(_radius(n), rng=seed)
    return np.asarray(getattr(sample, sampler)(n, rng=seed))


def _radius(n: int) -> float:
    """Of a Poisson-disk sample of the unit square with about `n` points, to four figures."""
    return float(f"{(0.7 / n) ** 0.5:.4g}")


def read(raw: Any) -> dict[str, Any] | None:
    """Sampler, n and seed as a page sent them, checked; None for none."""
    if raw is None:
        return None
    if not isinstance(raw, Mapping):
        raise TypeError(f"source is {type(raw).__name__}; an object is wanted")
    return {knob.name: knob.read(raw.get(knob.name, knob.default), "source") for knob in KNOBS}


def source_text(sampler: str, n: int, seed: int) -> str | None:
    """The call that makes the same points; None for outlines, which only the page has."""
    if sampler not in SAMPLERS:
        return None
    first = _radius(n) if sampler == "poisson_disk" else n
    return f"cz.sample.{sampler}({first}, rng={seed})"


def _outline(name: str, n: int) -> NDArray[np.float64]:
    t = np.linspace(0.0, 2 * np.pi, 20_000, endpoint=False)
    if name == "star":
        corner = np.arange(11) * np.pi / 5 + np.pi / 2
        radius = np.where(np.arange(11) % 2 == 0, 0.5, 0.22)
        line = np.column_stack([radius * np.cos(corner), radius * np.sin(corner)])
    elif name == "flower":
        radius = 0.36 + 0.14 * np.cos(5 * t)
        line = np.column_stack([radius * np.cos(t), radius * np.sin(t)])
    else:
        radius = 0.34 + 0.07 * np.cos(2 * t + 1) + 0.06 * np.cos(3 * t + 2) + 0.03 * np.cos(5 * t)
        line = np.column_stack([1.25 * radius * np.cos(t), radius * np.sin(t)])
    line = np.concatenate([line, line[:1]])
    steps = np.hypot(*np.diff(line, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    at = np.linspace(0.0, along[-1], n, endpoint=False)
    # Six decimals: an outline is a drawing, and its numbers are to be read.
    return np.round(np.column_stack([np.interp(at, along, line[:, i]) for i in (0, 1)]) + 0.5, 6)
