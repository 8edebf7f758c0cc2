"""The crack of the page: a recipe with its knobs turned, and the texture made of it."""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, radians, sin
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.crack import Crack
from crazing.diagram import Diagram, as_diagram, bounds_of
from crazing.edit.knobs import OWN_PLATES, Knob, number, recipe_fields, recipes
from crazing.material import Material, preset_material
from crazing.recipe import Recipe

#: The lamp over the preview.
LAMP: tuple[Knob, ...] = (
    number("side", "Light from", 135.0, 0.0, 360.0, 1.0, help="Degrees, 90 is above", group="Light"),
    number("high", "Height of the light", 40.0, 8.0, 90.0, 1.0, group="Light"),
)

#: Maps that light needs, and colour.
LIT_MAPS = ("color", "height", "normal", "ao", "roughness")

#: Where the lamp is: right, up and out.
Light: TypeAlias = tuple[float, float, float]

#: Material of flat ink, drawn by `crazing.render`.
INK = "ink"


def recipe_of(values: dict[str, Any]) -> Recipe:
    """The recipe as the knobs have it."""
    return recipes()[values["recipe"]].replace(**_changes(values))


def _changes(values: dict[str, Any]) -> dict[str, Any]:
    """What the knobs change in the recipe they start from."""
    start = recipes()[values["recipe"]]
    return {name: values[name] for name in recipe_fields() if values[name] != getattr(start, name)}


def has_own_plates(values: dict[str, Any]) -> bool:
    """Whether the plates are the recipe's, so that no points are needed."""
    return bool(values["plates"] == OWN_PLATES or values["generator"] != "maze")


def crack_of(points: ArrayLike | Diagram, values: dict[str, Any]) -> Crack:
    """The crack as the knobs have it."""
    recipe = recipe_of(values)
    if has_own_plates(values):
        return recipe.crack(period=(1.0, 1.0) if values["tile"] else None, rng=values["seed"])
    return recipe.crack(points, bounds=_box(points), rng=values["seed"])


def light(raw: Any) -> Light:
    """Where the lamp is, as the page has it: side and height in degrees; what it left out is at its default."""
    if not isinstance(raw, Mapping) and raw is not None:
        raise TypeError(f"lamp is {type(raw).__name__}; an object is wanted")
    given = {} if raw is None else raw
    side, high = (radians(knob.read(given.get(knob.name, knob.default), "lamp")) for knob in LAMP)
    return round(cos(side) * cos(high), 4), round(sin(side) * cos(high), 4), round(sin(high), 4)


def _box(points: ArrayLike | Diagram) -> tuple[float, float, float, float]:
    """The box about points, grown by a tenth: some room for those that are set next."""
    return bounds_of(as_diagram(points), None)


def material_of(values: dict[str, Any]) -> Material:
    """The material of the texture; the default where a recipe has none."""
    name = values["recipe"] if values["material"] == "of the recipe" else values["material"]
    return Material() if name == "thesis" else preset_material(name)


def picture_shape(box: tuple[float, float, float, float], size: int) -> tuple[int, int]:
    """(height, width) of a picture of a box, the longer side `size` pixels."""
    sides = box[3] - box[1], box[2] - box[0]
    height, width = (max(1, round(size * side / max(sides))) for side in sides)
    return height, width


def lines(values: dict[str, Any], points: NDArray[np.float64], lamp: Light) -> list[str]:
    """Python that makes the same crack and its pictures, flat and lit."""
    start = "cz.Recipe()" if values["recipe"] == "thesis" else f"cz.preset({values['recipe']!r})"
    changes = ", ".join(f"{name}={value!r}" for name, value in _changes(values).items())
    if has_own_plates(values):
        given, shape = "period=(1.0, 1.0), " if values["tile"] else "", (1024, 1024)
    else:
        given, shape = f"points, bounds={_box(points)}, ", picture_shape(_box(points), 1024)
    made = [f"recipe = {start}" + (f".replace({changes})" if changes else "")]
    made.append(f"crack = recipe.crack({given}rng={values['seed']})")
    if values["material"] == INK:
        return [*made, f'cz.save_png("crack.png", cz.render(crack, {shape}))']
    name = values["recipe"] if values["material"] == "of the recipe" else values["material"]
    material = "" if name == "thesis" else f", material={name!r}"
    return [
        *made,
        f"texture = cz.texture(crack, {shape}, maps={LIT_MAPS}{material}, seed={values['seed']})",
        'cz.save_png("crack.png", texture["color"])',
        f'cz.save_png("lit.png", texture.lit(light={lamp}))',
    ]


def is_rough(points: NDArray[np.float64], values: dict[str, Any], scale: float) -> bool:
    """Whether a crack about one spacing long wanders by a pixel or more, at `scale` pixels a unit."""
    if has_own_plates(values):
        spacing = values["n"] ** -0.5
    elif len(points):
        with np.errstate(over="ignore"):
            spacing = float(np.sqrt(np.prod(np.ptp(points, axis=0)) / len(points)))
    else:
        spacing = 0.0
    return bool(values["roughness"] * spacing * scale >= 1)
