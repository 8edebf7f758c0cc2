"""What can be turned on the page: one table that checks what the page sends and tells it which controls to draw."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from functools import cache
from typing import Any, TypeAlias

from crazing import arguments
from crazing.maze import TREES
from crazing.recipe import GENERATORS, SAMPLERS, Recipe, preset, presets
from crazing.skeleton import CRUSTS

#: Values of every panel: `values["maze"]["opening"]`.
Values: TypeAlias = dict[str, dict[str, Any]]

#: Methods of `medial_axis`.
AXES = ("edge-filter", "one-step", "poles", "initial")

#: Seeds are whole numbers that a page can hold exactly.
SEED_BITS = 53


@dataclass(frozen=True)
class Knob:
    """One control: its word in the code, its words on the page, and what it may be set to.

    Parameters
    ----------
    name, label, kind
        The word, what the page shows, and "switch", "choice", "number", "count", "seed" or "optional" (a number or
        None).
    default
        What it is when nobody has turned it.
    low, high, step
        Range and grain of a slider; the range is that of what is accepted.
    choices
        The words of a choice.
    needs
        The word of another knob of the panel; this one is shown when that one is on, or has the value after a colon.
    help
        What it does, in a few words.
    group
        Title of the fold it lies in; none for what is always there.
    """

    name: str
    label: str
    kind: str
    default: Any
    low: float = 0.0
    high: float = 1.0
    step: float = 0.01
    choices: tuple[str, ...] = ()
    needs: str = ""
    help: str = ""
    group: str = ""

    def read(self, value: Any, panel: str) -> Any:
        """`value` as this knob takes it; TypeError or ValueError tells what is wrong."""
        name = f"{panel}.{self.name}"
        if self.kind == "switch":
            if not isinstance(value, bool):
                raise TypeError(f"{name} is {str(value)[:40]!r}; true or false is wanted")
            return value
        if self.kind == "choice":
            return arguments.choice(value, name, self.choices)
        if self.kind == "seed":
            return arguments.count(value, name, high=(1 << SEED_BITS) - 1)
        if self.kind == "count":
            return arguments.count(value, name, low=int(self.low), high=int(self.high))
        if self.kind == "optional" and value is None:
            return None
        return arguments.number(value, name, low=self.low, high=self.high)


def switch(name: str, label: str, default: bool = False, **more: Any) -> Knob:
    """A knob that is on or off."""
    return Knob(name, label, "switch", default, **more)


def choice(name: str, label: str, choices: tuple[str, ...], **more: Any) -> Knob:
    """A knob with one of some words; the first is the default."""
    return Knob(name, label, "choice", choices[0], choices=choices, **more)


def number(name: str, label: str, default: float, low: float, high: float, step: float = 0.01, **more: Any) -> Knob:
    """A knob with a slider."""
    return Knob(name, label, "number", default, low, high, step, **more)


def count(name: str, label: str, default: int, low: int, high: int, **more: Any) -> Knob:
    """A knob with a whole number."""
    return Knob(name, label, "count", default, low, high, 1, **more)


SEED = Knob("seed", "Seed", "seed", 7)

SKELETON = (
    switch("delaunay", "Delaunay"),
    switch("voronoi", "Voronoi"),
    switch("crust", "Crust", True),
    choice("crust_method", "Method", CRUSTS, needs="crust"),
    switch("axis", "Medial axis", True),
    choice("axis_method", "Method", AXES, needs="axis"),
    switch("prune", "Prune hairs", needs="axis", help="For edge-filter and one-step"),
    number("residual", "Residual", 0.025, 0.0, 0.25, 0.005, needs="prune"),
    switch("curve", "Curve through all samples"),
    switch("poles", "Poles"),
    switch("nested", "Nested curves"),
    count("iterations", "Iterations", 3, 1, 5, needs="nested"),
)

COMPARE = (
    choice("first", "First", ("one-step", "edge-filter", "poles", "initial")),
    choice("second", "Second", AXES),
)

MAZE = (
    choice("cells", "Cells", ("voronoi", "delaunay", "in the curve")),
    count("fill", "Number of cells", 400, 3, 20_000, needs="cells:in the curve"),
    choice("tree", "Tree", TREES),
    number("opening", "Opened doors", 1.0, 0.0, 1.0, help="1: one way between any two cells"),
    switch("solution", "Solution", True),
    SEED,
)

OWN_PLATES = "of the recipe"

# What is known about the fields of a recipe: label, and for numbers low, high and step of the slider; what it does.
_FIELDS: dict[str, tuple[str, tuple[float, float, float], str]] = {
    "generator": ("Generator", (0, 0, 0), ""),
    "n": ("Number of plates", (3, 20_000, 1), ""),
    "sampler": ("Spread", (0, 0, 0), ""),
    "relax": ("Relaxation", (0, 10, 1), "Rounds that make plates alike"),
    "falloff": ("Falloff", (0, 8, 0.1), "Finer plates near the middle"),
    "patchiness": ("Patchiness", (0, 2, 0.05), "Finer plates here, coarser ones there"),
    "patch": ("Patch", (1, 20, 0.5), "Across a patch, in spacings"),
    "anisotropy": ("Stretch", (1, 10, 0.1), "Of plates, along the angle"),
    "angle": ("Angle", (-180, 180, 1), "Degrees"),
    "tree": ("Tree", (0, 0, 0), ""),
    "opening": ("Opening", (0, 1, 0.01), "0 closes every plate, 1 none"),
    "unbend": ("Unbending", (0, 20, 1), "Rounds, where nothing meets a crack"),
    "rounds": ("Straightening", (0, 20, 1), "Rounds"),
    "pull": ("Pull", (0, 1, 0.01), "Of a round, towards the chord"),
    "slide": ("Slide", (0, 1, 0.01), "Of a round, towards T junctions"),
    "clamp": ("Clamp", (0, 0.5, 0.01), "What sliding keeps out of"),
    "turn": ("Turn", (0, 180, 1), "At junctions, up to which a crack goes on"),
    "hairpin": ("Hairpin", (90, 180, 1), "Cracks that turn back by more are parted"),
    "jitter": ("Jitter", (0, 2, 0.01), "How plates differ in size"),
    "bend": ("Bend", (0, 1, 0.01), "Of new cracks towards old ones"),
    "speed": ("Speed", (10, 600, 5), "Of what hits, km/h"),
    "arcs": ("Arcs", (0, 1, 0.01), "Around the impact"),
    "stubs": ("Stubs", (0, 4, 0.05), "Short branches off every crack"),
    "stub_length": ("Stub length", (0, 1, 0.01), "In spacings of plates"),
    "stub_spread": ("Stub spread", (0, 1, 0.01), "How stubs differ in length"),
    "warp": ("Warp", (0, 1, 0.01), "Of the whole, in spacings"),
    "roughness": ("Roughness", (0, 0.3, 0.005), "Of every crack"),
    "hurst": ("Hurst exponent", (0, 1, 0.01), "Smooth or jagged roughness"),
    "grain": ("Grain", (0.02, 1, 0.01), "Finest roughness, in spacings"),
    "rounding": ("Rounding", (0, 1, 0.01), "Curves instead of corners"),
    "thickness": ("Thickness", (0, 0.5, 0.005), "In spacings of plates"),
    "hierarchy": ("Hierarchy", (0, 2, 0.01), "How much wider long cracks are"),
    "shrink": ("Shrink", (0, 1, 0.01), "Width from a generation to the next"),
    "taper": ("Taper", (0, 1, 0.01), "The part over which a tip runs out"),
    "abutting": ("Abutting", (0, 1, 0.01), "Width where a crack meets another"),
    "unevenness": ("Unevenness", (0, 1, 0.01), "Of width, from crack to crack and along them"),
    "fade": ("Fade", (0, 8, 0.1), "Thinner away from the middle"),
    "variant": ("Variant", (0, 20, 1), "Another pattern of the same seed"),
}
_WORDS = {"generator": GENERATORS, "sampler": SAMPLERS, "tree": TREES}
_FIRST = ("opening", "rounds", "roughness", "thickness", "hierarchy", "taper")
_OWN = ("n", "sampler", "relax", "falloff", "patchiness", "patch")
_ONLY = {
    **dict.fromkeys(("tree", "opening", "relax", "sampler", "turn", "hairpin"), "generator:maze"),
    **dict.fromkeys(("jitter", "bend"), "generator:splitting"),
    **dict.fromkeys(("speed", "arcs"), "generator:impact"),
}

#: What the page starts with.
START = "painting-flemish"


def recipe_fields() -> list[str]:
    """Fields of a recipe that a knob can turn: numbers, switches and known words."""
    kinds = {field.name: type(field.default) for field in fields(Recipe)}
    return [name for name, kind in kinds.items() if kind in (int, float, bool) or name in _WORDS]


def _recipe_knob(name: str) -> Knob:
    """The knob of one field; a field that nothing is known about gets a range around its values."""
    values = [getattr(recipe, name) for recipe in recipes().values()]
    default = getattr(recipes()[START], name)
    label, (low, high, step), help = _FIELDS.get(name, (name.replace("_", " ").capitalize(), (0, 0, 0), ""))
    group = "" if name in ("generator", *_FIRST) else "Plates" if name in _OWN else "More steps"
    more: dict[str, Any] = {"needs": _ONLY.get(name, ""), "group": group, "help": help}
    if name in _WORDS:
        return Knob(name, label, "choice", default, choices=_WORDS[name], **more)
    if isinstance(default, bool):
        return switch(name, label, default, **more)
    low, high = min(low, *values), max(high or max(1, 2 * default), *values)
    if isinstance(default, int):
        return count(name, label, default, int(low), int(high), **more)
    return number(name, label, default, low, high, step or 0.01, **more)


@cache
def recipes() -> dict[str, Recipe]:
    """The recipes to start from: the thesis' own, and the presets."""
    return {"thesis": Recipe(), **{name: preset(name) for name in presets()}}


def _crack_knobs() -> tuple[Knob, ...]:
    names = tuple(recipes())
    steps = {name: _recipe_knob(name) for name in recipe_fields()}
    first = [steps.pop(name) for name in ("generator", *_FIRST)]
    plates = choice("plates", "Plates", ("of the points", OWN_PLATES), needs="generator:maze")
    tile = switch("tile", "Tiles seamlessly", group="Plates", help="Needs plates of the recipe")
    return (
        Knob("recipe", "Recipe", "choice", START, choices=names),
        first[0],
        plates,
        *first[1:],
        SEED,
        choice("material", "Material", ("of the recipe", *names[1:], "ink")),
        *(knob for knob in steps.values() if knob.group == "Plates"),
        tile,
        *(knob for knob in steps.values() if knob.group != "Plates"),
    )


CRACK = _crack_knobs()

PANELS: dict[str, tuple[Knob, ...]] = {"skeleton": SKELETON, "compare": COMPARE, "maze": MAZE, "crack": CRACK}


def defaults() -> Values:
    """Every knob as nobody has turned it."""
    return {panel: {knob.name: knob.default for knob in knobs} for panel, knobs in PANELS.items()}


def read(raw: Any) -> Values:
    """What a page sent, checked; what it left out is at its default.

    Raises
    ------
    TypeError, ValueError
        If a panel or knob is unknown, or a value is not what it takes.
    """
    values = defaults()
    for panel, given in _mapping(raw, "settings").items():
        arguments.choice(panel, "settings", PANELS)
        knobs = {knob.name: knob for knob in PANELS[panel]}
        for name, value in _mapping(given, panel).items():
            arguments.choice(name, panel, knobs)
            values[panel][name] = knobs[name].read(value, panel)
    return values


def _mapping(value: Any, name: str) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise TypeError(f"{name} is {type(value).__name__}; an object is wanted")
    return value


def listed(knobs: tuple[Knob, ...]) -> list[dict[str, Any]]:
    """Knobs as the page reads them."""
    return [asdict(knob) for knob in knobs]


def described() -> dict[str, list[dict[str, Any]]]:
    """The table as the page reads it."""
    return {panel: listed(knobs) for panel, knobs in PANELS.items()}
