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

from crazing import arguments, course, files, steps
from crazing import rng as _rng
from crazing.arguments import areal, bounds_tuple, choice, count, meant, number, period_pair
from crazing.crack import Crack
from crazing.diagram import Diagram
from crazing.maze import TREES
from crazing.site import Site

#: One TOML file a preset.
PRESETS = Path(__file__).parent / "presets"

GENERATORS = ("maze", "splitting", "impact")
SAMPLERS = ("uniform", "poisson-disk", "normal", "laplace")

# What a number may be: lowest and highest; ints are counts.
_RANGES: dict[str, tuple[float, float]] = {
    "n": (0, 2**31 - 1),
    "relax": (0, 1000),
    "falloff": (0, 8),
    "patchiness": (0, 4),
    "patch": (0.5, 1000),
    "anisotropy": (1, 32),
    "angle": (-360, 360),
    "opening": (0, 1),
    "unbend": (0, 1000),
    "rounds": (0, 1000),
    "pull": (0, 1),
    "slide": (0, 1),
    "clamp": (0, 0.5),
    "turn": (0, 180),
    "hairpin": (0, 180),
    "jitter": (0, 4),
    "bend": (0, 1),
    "speed": (1, 10_000),
    "arcs": (0, 1),
    "stubs": (0, 20),
    "stub_length": (0, 2),
    "stub_spread": (0, 2),
    "warp": (0, 4),
    "roughness": (0, 4),
    "hurst": (0, 2),
    "grain": (0.001, 1000),
    "rounding": (0, 1),
    "thickness": (0, 8),
    "hierarchy": (0, 8),
    "shrink": (0, 2),
    "taper": (0, 1),
    "abutting": (0, 2),
    "unevenness": (0, 2),
    "fade": (0, 16),
    "variant": (0, 2**31 - 1),
}
_WORDS = {"generator": GENERATORS, "sampler": SAMPLERS, "tree": TREES}

#: Rough cracks look rough where no straight piece is longer than this, pixels: the `detail` of pictures.
SEEN = 3.0
#: Within so many spacings to both sides a crack that turns back is a hook.
HOOK = 1.5
#: Within this part of the smaller side of the bounds about the source cracks are widest.
_REACH = 0.25


@dataclass(frozen=True, kw_only=True)
class Recipe:
    """What a crack is made of, step by step; by default the thesis' own pattern.

    Numbers have no unit: lengths are in spacings, the median distance between neighbouring plates.

    Parameters
    ----------
    generator : {"maze", "splitting", "impact"}
        What is drawn: the walls of a maze of plates; walls that split plate after plate; spokes and arcs.
    n : int
        Number of plates, when no points are given.
    sampler : {"uniform", "poisson-disk", "normal", "laplace"}
        How the plates of a maze are spread, when no points are given; a Poisson-disk sample has about `n`.
    relax : int
        Rounds of Lloyd's relaxation: plates become alike. 0 to 2; more is a honeycomb.
    falloff : float
        The recipe's own plates are finer near the source: their density is ``(1 + (d / r)**2)**-falloff`` at a
        distance d, with r an eighth of the smaller side. 0 is even.
    patchiness : float
        Standard deviation of the logarithm of the density of the recipe's own plates: finer here, coarser there, as
        old cracks are. 0 is even.
    patch : float
        How far across patches are, in spacings.
    anisotropy : float
        Plates are this many times as long, along `angle`, as they are wide.
    angle : float
        Degrees from the x axis, counter-clockwise. Of a maze on a torus the nearest multiple of 90.
    tree : {"depth-first", "kruskal", "prim", "wilson"}
        The tree of the maze whose walls the cracks are, see :func:`crazing.maze`.
    opening : float
        The share of the maze's passages that are really opened: 1 leaves no loop, 0 closes every plate. The other
        generators look at neither `tree`, `opening`, `turn` and `hairpin` nor `sampler` and `relax`.
    unbend : int
        Rounds of straightening that come first, and pull only where nothing meets a crack: without them what is left
        of the walls about plates winds like a worm. 4 to 10 leave about as many bends as paint has.
    rounds : int
        Rounds of straightening. 2 to 5 measure like paint, 40 are too straight.
    pull : float
        The part of the way to the chord of its crack that a place on it goes in a round.
    slide : float
        The part of the way along the chord to where the abutting crack meets it at 90 degrees: more makes more T.
    clamp : float
        The part of the chord at both ends that sliding keeps out of.
    turn : float
        At a junction of a maze a crack goes on only where it turns by no more than so many degrees.
    hairpin : float
        A crack of a maze that turns back by more than so many degrees is parted there, or ends if another meets it
        there; 180 leaves all whole.
    jitter : float
        Splitting: standard deviation of the logarithm of the size by which the next plate is chosen.
    bend : float
        Splitting: how far new cracks bend to meet old ones at right angles, 0 to 1.
    speed : float
        Impact: of what hits, km/h; the number of spokes grows as its square root, 4 at 70 and 8 at 280.
    arcs : float
        Impact: the share of arcs that are there near the source.
    stubs : float
        Short free branches tried along one spacing of crack; those without room are left out. 0, the default, is none.
    stub_length : float
        Their median length, in spacings.
    stub_spread : float
        Standard deviation of the logarithm of their length.
    warp : float
        Standard deviation of a smooth warp of the whole, in spacings.
    roughness : float
        Standard deviation, in the middle, of a crack one spacing long, in spacings. Tiny for glaze, .05 for asphalt.
    hurst : float
        Deviation grows with this power of length: .5 is a random walk, .7 is what real cracks show.
    grain : float
        Pieces of rough and rounded cracks are no longer than this many spacings, but where they are next to straight,
        see :func:`crazing.steps.roughen`.
    rounding : float
        How far cracks turn in curves instead of corners: 0 not at all, 1 all the way, where there is room.
    thickness : float
        Width of the longest crack, in spacings.
    hierarchy : float
        Width grows with this power of the length of a crack: 0 makes all alike, .5 is what real cracks show.
    shrink : float
        Width is this part of the parent generation's.
    taper : float
        The part of a crack over which a free tip runs out.
    abutting : float
        Width of an abutting end, as a part of the crack's own.
    unevenness : float
        Standard deviation of the logarithm of width from crack to crack; half of it along a crack.
    fade : float
        Width falls with the distance d from the source as ``(1 + (d / r)**2)**(-fade / 2)``, with r a quarter of the
        smaller side.
    variant : int
        Recipes that differ in it make of one seed patterns that have nothing to do with each other, also where all
        their first steps are alike; those of one variant change little by little with their numbers.
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

    generator: str = "maze"
    n: int = 300
    sampler: str = "uniform"
    relax: int = 0
    falloff: float = 0.0
    patchiness: float = 0.0
    patch: float = 4.0
    anisotropy: float = 1.0
    angle: float = 0.0
    tree: str = "depth-first"
    opening: float = 1.0
    unbend: int = 0
    rounds: int = 0
    pull: float = 0.64
    slide: float = 0.18
    clamp: float = 0.2
    turn: float = 180.0
    hairpin: float = 180.0
    jitter: float = 0.3
    bend: float = 1.0
    speed: float = 200.0
    arcs: float = 0.8
    stubs: float = 0.0
    stub_length: float = 0.2
    stub_spread: float = 0.3
    warp: float = 0.0
    roughness: float = 0.0
    hurst: float = 0.7
    grain: float = 0.15
    rounding: float = 0.0
    thickness: float = 0.125
    hierarchy: float = 0.5
    shrink: float = 1.0
    taper: float = 0.5
    abutting: float = 0.6
    unevenness: float = 0.0
    fade: float = 0.0
    variant: int = 0
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
        density: Any = None,
        bounds: ArrayLike | None = None,
        period: ArrayLike | None = None,
        detail: float | None = None,
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
            Where the damage starts, data units; the middle of the bounds by default. See `falloff` and `fade`.
        density : array_like or callable, optional
            Plates are finer where this is larger: an image over the bounds, row 0 at the top, see
            :func:`crazing.sample.from_density`, or a function of x and y (arrays, data units). For plates of the
            recipe's own: not with `points`, nor of the generator `"impact"`.
        bounds : (xmin, ymin, xmax, ymax), optional
            What the pattern is clipped to, data units; by default as in :func:`crazing.crack`.
        period : (width, height), optional
            What is repeated, data units.
        detail : float, optional
            Rough and rounded cracks are cut into pieces no longer than this, data units, where the recipe's `grain` is
            coarser. For pictures that are looked at closely, three pixels: ``3 / 8192`` of a unit square. Finer pieces
            add to a crack, and leave the vertices it has without them where they are. They wander only where they are
            longer than the crack is wide: both sides follow one line, and would look like a string of beads.
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
        seed = _rng.varied(rng, self.variant)
        if period is None and isinstance(points, Diagram):
            period = points.period
        torus = None if period is None else areal(period_pair(period), "period")
        if torus is not None and bounds is not None:
            raise ValueError("bounds and period are both given; a periodic picture is one period")
        if points is not None and self.generator != "maze":
            raise ValueError(f"points are given; the generator {self.generator!r} takes none")
        if density is not None and (points is not None or self.generator == "impact"):
            other = "points are given" if points is not None else "the generator is 'impact'"
            raise ValueError(f"density is given, and {other}; it is for plates of the recipe's own")
        box = None if bounds is None else areal(bounds_tuple(bounds))
        if box is None and (torus is not None or points is None):
            box = (0.0, 0.0, *(torus or (1.0, 1.0)))
        site = Site(self, box, torus, source, density)
        drawing, unit = site.maze(points, seed) if self.generator == "maze" else site.aged(seed)
        areal(drawing.bounds, "the box around the points")
        finest = None if detail is None else number(detail, "detail", low=course.NEAREST)
        return self._course(site, drawing, unit, seed, width, finest).crack(drawing)

    def _course(
        self,
        site: Site,
        drawing: steps.Drawing,
        unit: float,
        seed: np.random.Generator,
        width: float | None,
        detail: float | None,
    ) -> course.Course:
        """The steps that make the pattern of a drawing, its plates `unit` apart."""
        # Every step draws its key, wanted or not: turning one off leaves the others as they are.
        keys = [_rng.key(np.random.default_rng(_rng.key(seed))) for _ in range(3)]
        of_maze = self.generator == "maze"
        where, side = site.centre(drawing.bounds)
        full = self.thickness * unit if width is None else number(width, "width", low=0)
        reach = max(_REACH * side, course.NEAREST)
        looks = (full, self.hierarchy, self.shrink, self.taper, self.abutting, self.unevenness, unit, where, reach)
        straight = (self.rounds, self.pull, self.slide, self.clamp, self.unbend)
        stubs = (self.stubs, self.stub_length, unit, self.stub_spread, course.LEAN)
        rough = (self.roughness, unit, self.hurst, self.grain, self.rounding)
        # Plates of stretched mazes are near each other in one direction and far in the other, whatever their size.
        spacing = 0.0 if site.is_even or self.anisotropy != 1 else unit
        is_rough = bool((self.roughness or self.rounding) and unit)
        return course.Course(
            (course.widths(*looks, self.fade), keys[2]),
            straight=course.straightening(*straight) if self.rounds or self.unbend else None,
            warp=(number(self.warp * unit, "warp", low=0), keys[0]) if self.warp and unit else None,
            turn=course.turning(self.turn) if of_maze and self.turn < 180 else None,
            hooks=course.hooks(self.hairpin, HOOK * unit, spacing) if of_maze and self.hairpin < 180 else None,
            # The last of the keys is drawn here, so that no other is another without stubs.
            stubs=(course.stubbing(*stubs), _rng.key(seed)) if self.stubs and unit else None,
            rough=(course.roughness(*rough), keys[1]) if is_rough else None,
            detail=detail,
        )

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
        name = os.fspath(arguments.file_path(path))
        tables = read_toml(path)
        table = tables.get("recipe")
        if "recipe" in tables and not isinstance(table, dict):
            raise ValueError(f"{name}: recipe is {arguments.found(table)}; one table [recipe] is wanted")
        if table is None:
            raise ValueError(f"{name} has no table [recipe]; it has {', '.join(tables) or 'nothing'}")
        unknown = [key for key in table if key not in _STEPS]
        if unknown:
            asked = meant(unknown[0], _STEPS)
            raise ValueError(f"{name}: [recipe] has no key {unknown[0]!r}{asked}; it may have {', '.join(_STEPS)}")
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
        with files.atomic_write(arguments.file_path(path)) as file:
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
        ['[recipe]', 'generator = "maze"', 'n = 300', 'sampler = "uniform"', 'relax = 0']
        """
        heads = [f"{key} = {_toml(getattr(self, key))}" for key in _TEXTS if getattr(self, key)]
        rows = [f"{key} = {_toml(getattr(self, key))}" for key in _STEPS]
        return "\n".join([*heads, *([""] if heads else []), "[recipe]", *rows, ""])


_NAMES = tuple(each.name for each in dataclasses.fields(Recipe))
_TEXTS = ("title", "citation")
_STEPS = tuple(name for name in _NAMES if name not in _TEXTS)


def read_toml(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The tables of a TOML file; editors on Windows begin one with a byte order mark."""
    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8-sig"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{os.fspath(path)} is no TOML file: {error}") from None


def _checked(name: str, value: Any) -> Any:
    """A value of a field, of its type and in its range."""
    if name in _TEXTS:
        if not isinstance(value, str):
            raise TypeError(f"{name} is {value!r}; text is wanted")
        # The name of a file may hold bytes that are no text, of which no TOML can be made.
        return value.encode(errors="replace").decode()
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
    density: Any = None,
    bounds: ArrayLike | None = None,
    period: ArrayLike | None = None,
    detail: float | None = None,
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
        leaves every plate closed all round. Paint and glaze measure .6 to .85. Refused, as `sampler` is, where cracks
        are not the walls of a maze.
    width : float, optional
        Width of the longest crack, data units. By default an eighth of the median distance between neighbouring
        points, or as in the preset.
    source : (x, y), optional
        Where the damage starts, data units; the middle of the bounds by default. See `falloff` and `fade` of
        :class:`crazing.Recipe`.
    density : array_like or callable, optional
        Plates are finer where this is larger: an image over the bounds, row 0 at the top, see
        :func:`crazing.sample.from_density`, or a function of x and y (arrays, data units). Not with `points`, nor for
        an impact.
    bounds : (xmin, ymin, xmax, ymax), optional
        What the pattern is clipped to, data units. By default the unit square without `points`, else their bounding
        box, grown by half their mean spacing and by no more than a tenth.
    period : (width, height), optional
        Make a pattern that repeats: cracks leave on one side and come in on the opposite one. Excludes `bounds`.
    detail : float, optional
        Rough and rounded cracks are cut into pieces no longer than this, data units, see :meth:`Recipe.crack`: three
        pixels of the picture that is to be made.
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
        If `points` are given beside `n` or `density`, or `opening` where no maze is made; if a number is out of range,
        or no preset or field has such a name.
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
    given = {"n": n, "opening": opening, **steps}
    changes = {name: value for name, value in given.items() if value is not None}
    recipe = (Recipe() if preset is None else _named(preset)).replace(**changes)
    if recipe.generator != "maze" and (idle := [name for name in ("opening", "sampler") if name in changes]):
        raise ValueError(
            f"{idle[0]} is given; it does nothing for the generator {recipe.generator!r}, whose cracks are not the "
            "walls of a maze"
        )
    if isinstance(points, str):
        raise TypeError(f"points is {points!r}; coordinates are wanted; a kind of crack is named by preset={points!r}")
    if points is not None and n is not None:
        raise ValueError("points and n are both given; n is for uniform points without points")
    return recipe.crack(
        points, width=width, source=source, density=density, bounds=bounds, period=period, detail=detail, rng=rng
    )
