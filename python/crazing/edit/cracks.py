"""The crack of the page: a recipe with its knobs turned, and the texture made of it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.crack import Crack
from crazing.diagram import Diagram, as_diagram, bounds_of
from crazing.edit.knobs import OWN_PLATES, recipe_fields, recipes
from crazing.material import Material, preset_material
from crazing.recipe import Recipe
from crazing.texture import texture

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


def _box(points: ArrayLike | Diagram) -> tuple[float, float, float, float]:
    """The bounds that a crack of points has by default; some steps want them told."""
    return bounds_of(as_diagram(points), None)


def material_of(values: dict[str, Any]) -> Material:
    """The material of the texture; the default where a recipe has none."""
    name = values["recipe"] if values["material"] == "of the recipe" else values["material"]
    return Material() if name == "thesis" else preset_material(name)


def lines(values: dict[str, Any], points: NDArray[np.float64]) -> list[str]:
    """Python that makes the same crack and its picture."""
    start = "cz.Recipe()" if values["recipe"] == "thesis" else f"cz.preset({values['recipe']!r})"
    changes = ", ".join(f"{name}={value!r}" for name, value in _changes(values).items())
    if has_own_plates(values):
        given = "period=(1.0, 1.0), " if values["tile"] else ""
    else:
        given = f"points, bounds={_box(points)}, "
    made = [f"recipe = {start}" + (f".replace({changes})" if changes else "")]
    made.append(f"crack = recipe.crack({given}rng={values['seed']})")
    if values["material"] == INK:
        return [*made, 'cz.save_png("crack.png", cz.render(crack, 1024))']
    name = values["recipe"] if values["material"] == "of the recipe" else values["material"]
    material = "" if name == "thesis" else f", material={name!r}"
    return [
        *made,
        f"texture = cz.texture(crack, 1024{material}, seed={values['seed']})",
        'cz.save_png("crack.png", texture["color"])',
    ]


def lit_maps(crack: Crack, shape: tuple[int, int], values: dict[str, Any]) -> NDArray[np.uint8]:
    """(H, W, 7) uint8: colour, the slopes in x and y about 128, occlusion and roughness; what light needs."""
    names = ("color", "normal", "ao", "roughness")
    maps = texture(crack, shape, maps=names, material=material_of(values), seed=values["seed"])
    packed = np.empty((*shape, 7), dtype=np.uint8)
    packed[..., :3] = maps["color"]
    packed[..., 3:5] = maps["normal"][..., :2] * np.float32(127) + np.float32(128.5)
    packed[..., 5] = maps["ao"] * np.float32(255)
    packed[..., 6] = maps["roughness"] * np.float32(255)
    return packed
