"""What can be taken away from the page, by its word."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from crazing import arguments
from crazing.crack import Crack
from crazing.edit import cracks, drawing
from crazing.edit.layers import Drawing, draw
from crazing.errors import CrazingError
from crazing.material import Material
from crazing.render import render
from crazing.texture import Texture, texture

Points: TypeAlias = NDArray[np.float64]

#: Maps of the folder of a texture.
TEXTURE_MAPS = ("color", "height", "normal", "ao", "roughness", "mask")


@dataclass(frozen=True)
class Asked:
    """What a file is made of: points, knobs, the longer side of a picture in pixels, where the lamp is."""

    points: Points
    values: dict[str, Any]
    size: int
    light: cracks.Light


def made(
    what: Any, points: Points, mode: str, values: dict[str, Any], size: int, light: cracks.Light
) -> tuple[str, bytes]:
    """A file of what the page shows.

    Parameters
    ----------
    what : {"png", "svg", "dxf", ...}
        One of the words that :func:`described` has for the mode.
    points, mode, values
        What is on the page.
    size : int
        The longer side of a picture, in pixels.
    light : (right, up, out)
        Where the lamp over a crack is.

    Returns
    -------
    name : str
        For the file.
    content : bytes

    Raises
    ------
    CrazingError
        If there is nothing to be written.
    """
    word = arguments.choice(what, "what", [each for each, (_, modes) in _LABELS.items() if mode in modes])
    found = draw(points, mode, values)
    if not found.layers:
        raise CrazingError(found.note or "there is nothing to be written yet; add some points")
    name = "lit" if word == "lit" else mode
    return f"{name}.{_ENDINGS.get(word, word)}", _MAKERS[word](found, Asked(points, values, size, light))


def described() -> list[dict[str, Any]]:
    """The words, with what the page calls them and the modes that have them."""
    return [{"what": word, "label": label, "modes": list(modes)} for word, (label, modes) in _LABELS.items()]


def _png(found: Drawing, asked: Asked) -> bytes:
    if not isinstance(found.subject, Crack):
        return drawing.png(drawing.shown(found, asked.points), drawing.frame(found, asked.points), asked.size)
    if asked.values["material"] == cracks.INK:
        return drawing.png_of(render(found.subject, cracks.picture_shape(found.subject.bounds, asked.size)))
    return drawing.png_of(_texture_of(found, asked, ("color",))["color"])


def _lit(found: Drawing, asked: Asked) -> bytes:
    return drawing.png_of(_texture_of(found, asked, cracks.LIT_MAPS).lit(light=asked.light))


def _texture_of(found: Drawing, asked: Asked, maps: tuple[str, ...]) -> Texture:
    """Maps of the crack; ink has the material of no recipe."""
    if not isinstance(found.subject, Crack):
        raise CrazingError("a texture is made of a crack; there is none")
    material = Material() if asked.values["material"] == cracks.INK else cracks.material_of(asked.values)
    shape = cracks.picture_shape(found.subject.bounds, asked.size)
    return texture(found.subject, shape, maps=maps, material=material, seed=asked.values["seed"])


def _svg(found: Drawing, asked: Asked) -> bytes:
    return drawing.svg(drawing.shown(found, asked.points), drawing.frame(found, asked.points))


def _dxf(found: Drawing, asked: Asked) -> bytes:
    return drawing.dxf(drawing.shown(found, asked.points), drawing.frame(found, asked.points))


def _recipe(found: Drawing, asked: Asked) -> bytes:
    return cracks.recipe_of(asked.values).to_toml().encode()


def _texture(found: Drawing, asked: Asked) -> bytes:
    drawn = _texture_of(found, asked, TEXTURE_MAPS)
    with tempfile.TemporaryDirectory() as folder:
        drawn.save(folder, name="crack")
        return drawing.zipped(drawing.folder_content(Path(folder)))


_MAKERS: dict[str, Callable[[Drawing, Asked], bytes]] = {
    "png": _png,
    "lit": _lit,
    "svg": _svg,
    "dxf": _dxf,
    "texture": _texture,
    "recipe": _recipe,
}
_ENDINGS = {"lit": "png", "recipe": "toml", "texture": "zip"}
_ALL = ("skeleton", "compare", "maze", "crack")
_LABELS: dict[str, tuple[str, tuple[str, ...]]] = {
    "png": ("PNG picture", _ALL),
    "lit": ("Lit picture", ("crack",)),
    "svg": ("SVG drawing", _ALL),
    "dxf": ("DXF drawing", _ALL),
    "texture": ("Texture folder", ("crack",)),
    "recipe": ("Recipe (TOML)", ("crack",)),
}
