"""Recipes: which steps a crack is made of, kept as TOML; presets are recipes that come with the package."""

from __future__ import annotations

import dataclasses
import os
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crazing import files, sample, steps
from crazing import rng as _rng
from crazing.arguments import bounds_tuple, choice, count, number, period_pair
from crazing.crack import Crack
from crazing.diagram import Diagram, as_tiling
from crazing.maze import TREES, maze

#: One TOML file a preset.
PRESETS = Path(__file__).parent / "presets"

SAMPLERS = ("uniform", "normal", "laplace")

# What a number may be: lowest and highest; ints are counts.
_RANGES: dict[str, tuple[float, float]] = {
    "n": (0, 2**31 - 1),
    "relax": (0, 1000),
    "opening": (0, 1),
    "rounds": (0, 1000),
    "pull": (0, 1),
    "slide": (0, 1),
    "clamp": (0, 0.5),
    "thickness": (0, 8),
    "hierarchy": (0, 8),
    "taper": (0, 1),
}
_WORDS = {"sampler": SAMPLERS, "tree": TREES}


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """What a crack is made of, step by step; by default the thesis' own pattern.

    Numbers have no unit: lengths are in spacings, the median distance between neighbouring plates.

    Parameters
    ----------
    n : int
        Number of plates, when no points are given.
    sampler : {"uniform", "normal", "laplace"}
        How the plates are spread, when no points are given.
    relax : int
        Rounds of Lloyd's relaxation: plates become alike. 0 to 2; more is a honeycomb.
    tree : {"depth-first", "kruskal", "prim", "wilson"}
        The tree of the maze whose walls the cracks are, see :func:`crazing.maze`.
    opening : float
        The share of the maze's passages that are really opened: 1 leaves no loop, 0 closes every plate.
    rounds : int
        Rounds of straightening. 2 to 5 measure like paint, 40 are too straight.
    pull : float
        The part of the way to the chord of its crack that a place on it goes in a round.
    slide : float
        The part of the way along the chord to where the abutting crack meets it at 90 degrees: more makes more T.
    clamp : float
        The part of the chord at both ends that sliding keeps out of.
    thickness : float
        Width of the longest crack, in spacings.
    hierarchy : float
        Width grows with this power of the length of a crack: 0 makes all alike, .5 is what real cracks show.
    taper : float
        The part of a crack over which a free tip runs out.
    title : str
        What the recipe makes.
    citation : str
        Where its numbers are from.

    Raises
    ------
    TypeError, ValueError
        If a value is of the wrong type or out of range.

    Examples
    --------
    >>> import crazing as cz
    >>> paint = cz.Recipe(n=166, opening=0.57, rounds=5)
    >>> paint.crack(rng=1).bounds
    (0.0, 0.0, 1.0, 1.0)
    """

    n: int = 300
    sampler: str = "uniform"
    relax: int = 0
    tree: str = "depth-first"
    opening: float = 1.0
    rounds: int = 0
    pull: float = 0.64
    slide: float = 0.18
    clamp: float = 0.2
    thickness: float = 0.125
    hierarchy: float = 0.5
    taper: float = 0.5
    title: str = field(default="", compare=False)
    citation: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        for each in dataclasses.fields(self):
            object.__setattr__(self, each.name, _checked(each.name, getattr(self, each.name)))

    def replace(self, **changes: Any) -> Recipe:
        """The same recipe with some values changed.

        Parameters
        ----------
        **changes
            Fields by name.

        Returns
        -------
        Recipe

        Raises
        ------
        TypeError, ValueError
            If there is no such field, or its value is out of range.

        Examples
        --------
        >>> import crazing as cz
        >>> cz.Recipe().replace(opening=0.6).opening
        0.6
        """
        for name in changes:
            choice(name, "the name of a step", _NAMES)
        return dataclasses.replace(self, **changes)

    def crack(
        self,
        points: ArrayLike | Diagram | None = None,
        *,
        width: float | None = None,
        source: ArrayLike | None = None,
        bounds: ArrayLike | None = None,
        period: ArrayLike | None = None,
        rng: _rng.RNG = None,
    ) -> Crack:
        """Make a crack pattern.

        Parameters
        ----------
        points : (n, 2) array_like or Diagram, optional
            Where the plates are, instead of the recipe's own.
        width : float, optional
            Width of the longest crack, data units, instead of `thickness` spacings.
        source : (x, y), optional
            Where the damage starts, data units.
        bounds : (xmin, ymin, xmax, ymax), optional
            What the pattern is clipped to, data units.
        period : (width, height), optional
            What is repeated, data units.
        rng : int, numpy.random.Generator or None, optional
            Seed.

        Returns
        -------
        Crack

        Raises
        ------
        TypeError, ValueError
            If an argument is of the wrong type or out of range.
        CrazingError
            If a coordinate is NaN or infinite.
        """
        seed = np.random.default_rng(rng)
        torus = None if period is None else period_pair(period)
        if points is None:
            if torus is not None and bounds is not None:
                raise ValueError("bounds and period are both given; a periodic picture is one period")
            sides = (1.0, 1.0) if torus is None else torus
            box = bounds_tuple((0.0, 0.0, *sides) if bounds is None else bounds)
            bounds = box if torus is None else None
            points = self._sites(box, seed)
        diagram = as_tiling(points, torus)
        width = self.thickness * _spacing(diagram) if width is None else number(width, "width", low=0)
        carved = maze(diagram, tree=self.tree, opening=self.opening, bounds=bounds, rng=seed)
        net, fence = steps.walls(carved)
        return self._finish(net, fence, width, carved.bounds)

    def _sites(self, bounds: tuple[float, float, float, float], seed: np.random.Generator) -> Any:
        if self.sampler == "uniform":
            return sample.uniform(self.n, bounds=bounds, rng=seed)
        draw = sample.normal if self.sampler == "normal" else sample.laplace
        low, high = np.reshape(bounds, (2, 2))
        return draw(self.n, loc=(low + high) / 2, scale=(high - low).min() / 8, rng=seed)

    def _finish(self, net: steps.Net, fence: steps.Fence, width: float, bounds: Any) -> Crack:
        """The steps after the drawing: straightening, then width."""
        partner = steps.pairs(net)
        if self.rounds:
            net = steps.straightened(
                net, partner, fence, rounds=self.rounds, pull=self.pull, slide=self.slide, clamp=self.clamp
            )
        return steps.widened(net, partner, bounds, width, self.hierarchy, self.taper)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Recipe:
        """Read a recipe from a TOML file: its table `recipe`; other tables are not looked at.

        Parameters
        ----------
        path : str or path-like

        Returns
        -------
        Recipe

        Raises
        ------
        ValueError, TypeError
            If the file is no TOML, or a key or value is wrong; the message names file and key.
        OSError
            If the file cannot be read.
        """
        name = os.fspath(path)
        try:
            with Path(path).open("rb") as file:
                tables = tomllib.load(file)
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise ValueError(f"{name} is no TOML file: {error}") from None
        table = tables.get("recipe")
        if not isinstance(table, dict):
            raise ValueError(f"{name} has no table [recipe]")
        unknown = [key for key in table if key not in _NAMES or key in _TEXTS]
        if unknown:
            raise ValueError(f"{name}: [recipe] has no key {unknown[0]!r}; it may have {', '.join(_STEPS)}")
        given = {**table, **{key: tables[key] for key in _TEXTS if key in tables}}
        for key, value in given.items():
            try:
                _checked(key, value)
            except (TypeError, ValueError) as error:
                raise type(error)(f"{name}: {error}") from None
        return cls(**given)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the recipe as a TOML file, which :meth:`load` reads back to an equal one.

        Parameters
        ----------
        path : str or path-like
            An existing file is replaced.

        Raises
        ------
        OSError
            If the file cannot be written; what stood there before is then untouched.
        """
        with files.atomic_write(path) as file:
            file.write(self.to_toml().encode())

    def to_toml(self) -> str:
        """The recipe as the text of a TOML file.

        Returns
        -------
        str

        Examples
        --------
        >>> import crazing as cz
        >>> print(cz.Recipe(opening=0.6).to_toml().splitlines()[:5])
        ['[recipe]', 'n = 300', 'sampler = "uniform"', 'relax = 0', 'tree = "depth-first"']
        """
        heads = [f"{key} = {_toml(getattr(self, key))}" for key in _TEXTS if getattr(self, key)]
        rows = [f"{key} = {_toml(getattr(self, key))}" for key in _STEPS]
        return "\n".join([*heads, *([""] if heads else []), "[recipe]", *rows, ""])


_NAMES = tuple(each.name for each in dataclasses.fields(Recipe))
_TEXTS = ("title", "citation")
_STEPS = tuple(name for name in _NAMES if name not in _TEXTS)


def _checked(name: str, value: Any) -> Any:
    """A value of a field, of its type and in its range."""
    if name in _TEXTS:
        if not isinstance(value, str):
            raise TypeError(f"{name} is {value!r}; text is wanted")
        return value
    if name in _WORDS:
        return choice(value, name, _WORDS[name])
    low, high = _RANGES[name]
    if isinstance(low, int) and isinstance(getattr(Recipe, name), int):
        return count(value, name, low=int(low), high=int(high))
    return number(value, name, low=low, high=high)


def _toml(value: str | float) -> str:
    if not isinstance(value, str):
        return repr(value)
    escaped = value.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + "".join(c if c >= " " and c != "\x7f" else f"\\u{ord(c):04x}" for c in escaped) + '"'


def _spacing(diagram: Diagram) -> float:
    """The median length of the Delaunay edges: the mean would follow far outliers."""
    if not len(diagram.edges):
        return 0.0
    ends = diagram.sites[diagram.edges]
    step = ends[:, 1] - ends[:, 0]
    if diagram.period is not None:
        step = step + diagram.shifts * np.asarray(diagram.period)
    return float(np.median(np.hypot(*step.T)))


def presets() -> tuple[str, ...]:
    """The names of the recipes that come with the package.

    Returns
    -------
    tuple of str

    Examples
    --------
    >>> import crazing as cz
    >>> "glaze" in cz.presets()
    True
    """
    return tuple(sorted(path.stem for path in PRESETS.glob("*.toml")))


def preset(name: str) -> Recipe:
    """A recipe that comes with the package.

    Parameters
    ----------
    name : str
        One of :func:`presets`.

    Returns
    -------
    Recipe

    Raises
    ------
    ValueError
        If there is no such preset.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.preset("glaze").crack(rng=1).bounds
    (0.0, 0.0, 1.0, 1.0)
    """
    return Recipe.load(PRESETS / f"{choice(name, 'preset', presets())}.toml")


_named = preset


def crack(
    points: ArrayLike | Diagram | None = None,
    *,
    preset: str | None = None,
    n: int | None = None,
    opening: float | None = None,
    width: float | None = None,
    source: ArrayLike | None = None,
    bounds: ArrayLike | None = None,
    period: ArrayLike | None = None,
    rng: _rng.RNG = None,
    **steps: Any,
) -> Crack:
    """A crack pattern: the walls of a depth-first maze over points, with widths that run out to the free tips.

    Parameters
    ----------
    points : (n, 2) array_like or Diagram, optional
        Where the plates between the cracks are; cracks are finest where points are dense. By default `n` points of the
        recipe's own.
    preset : str, optional
        A recipe by name, see :func:`crazing.presets`. By default the thesis' pattern.
    n : int, optional
        Number of points when `points` is not given; 300 by default, or as in the preset.
    opening : float, optional
        The share of the maze's passages that are really opened: 1, the default, is the thesis (cracks are trees), 0
        leaves every plate closed all round. Paint and glaze measure .6 to .85.
    width : float, optional
        Width of the longest crack, data units. By default an eighth of the median distance between neighbouring
        points, or as in the preset.
    source : (x, y), optional
        Where the damage starts, data units: see `falloff` and `fade` of :class:`crazing.Recipe`.
    bounds : (xmin, ymin, xmax, ymax), optional
        What the pattern is clipped to, data units. By default the unit square without `points`, else their bounding
        box grown by a tenth.
    period : (width, height), optional
        Make a pattern that repeats: cracks leave on one side and come in on the opposite one. Excludes `bounds`.
    rng : int, numpy.random.Generator or None, optional
        Seed. The same seed gives the same pattern on every platform.
    **steps
        Any field of :class:`crazing.Recipe`, instead of the preset's.

    Returns
    -------
    Crack

    Raises
    ------
    TypeError, ValueError
        If both `points` and `n` are given, a number is out of range, or no preset or field has such a name.
    CrazingError
        If a coordinate is NaN or infinite.

    Notes
    -----
    Source: thesis, section 8; strands, width and the other steps after measurements of real cracks.

    Examples
    --------
    >>> import crazing as cz
    >>> uniform = cz.crack(n=200, rng=7)
    >>> impact = cz.crack(cz.sample.laplace(200, rng=7), rng=7)
    >>> uniform.bounds, bool(impact.width.min() == 0)
    ((0.0, 0.0, 1.0, 1.0), True)
    >>> cz.crack(preset="glaze", period=(1, 1), rng=7).period
    (1.0, 1.0)
    """
    changes = {"n": n, "opening": opening, **steps}
    recipe = (Recipe() if preset is None else _named(preset)).replace(
        **{name: value for name, value in changes.items() if value is not None}
    )
    if points is not None and n is not None:
        raise ValueError("points and n are both given; n is for uniform points without points")
    return recipe.crack(points, width=width, source=source, bounds=bounds, period=period, rng=rng)
