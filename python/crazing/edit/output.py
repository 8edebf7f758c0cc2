"""What can be taken away from the page, by its word."""

from __future__ import annotations

import tempfile
from collections.abc import Callable
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
from crazing.texture import texture

Points: TypeAlias = NDArray[np.float64]

#: Maps of the folder of a texture.
TEXTURE_MAPS = ("color", "height", "normal", "ao", "roughness", "mask")


def made(what: Any, points: Points, mode: str, values: dict[str, Any], size: int) -> tuple[str, bytes]:
    """A file of what the page shows.

    Parameters
    ----------
    what : {"png", "svg", "dxf", "geojson", ...}
        One of the words of :func:`described`.
    points, mode, values
        What is on the page.
    size : int
        The longer side of a picture, in pixels.

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
    word = arguments.choice(what, "what", _MAKERS)
    found = draw(points, mode, values)
    if not found.layers:
        raise CrazingError(found.note or "there is nothing to be written yet; add some points")
    return f"{mode}.{_ENDINGS.get(word, word)}", _MAKERS[word](found, points, values, size)


def described() -> list[dict[str, Any]]:
    """The words, with what the page calls them and the modes that have them."""
    return [{"what": word, "label": label, "modes": list(modes)} for word, (label, modes) in _LABELS.items()]


def _png(found: Drawing, points: Points, values: dict[str, Any], size: int) -> bytes:
    if isinstance(found.subject, Crack):
        shape = drawing.shape(found.subject.bounds, size)
        if values["material"] == cracks.INK:
            return drawing.png_of(render(found.subject, shape))
        material = cracks.material_of(values)
        return drawing.png_of(
            texture(found.subject, shape, maps="color", material=material, seed=values["seed"])["color"]
        )
    return drawing.png(drawing.shown(found, points), drawing.frame(found, points), size)


def _svg(found: Drawing, points: Points, values: dict[str, Any], size: int) -> bytes:
    return drawing.svg(drawing.shown(found, points), drawing.frame(found, points))


def _dxf(found: Drawing, points: Points, values: dict[str, Any], size: int) -> bytes:
    return drawing.dxf(drawing.shown(found, points), drawing.frame(found, points))


def _recipe(found: Drawing, points: Points, values: dict[str, Any], size: int) -> bytes:
    return cracks.recipe_of(values).to_toml().encode()


def _texture(found: Drawing, points: Points, values: dict[str, Any], size: int) -> bytes:
    if not isinstance(found.subject, Crack):
        raise CrazingError("a texture is made of a crack; there is none")
    material = Material() if values["material"] == cracks.INK else cracks.material_of(values)
    shape = drawing.shape(found.subject.bounds, size)
    made = texture(found.subject, shape, maps=TEXTURE_MAPS, material=material, seed=values["seed"])
    with tempfile.TemporaryDirectory() as folder:
        made.save(folder, name="crack")
        return drawing.zipped(drawing.folder_content(Path(folder)))


_MAKERS: dict[str, Callable[[Drawing, Points, dict[str, Any], int], bytes]] = {
    "png": _png,
    "svg": _svg,
    "dxf": _dxf,
    "texture": _texture,
    "recipe": _recipe,
}
_ENDINGS = {"recipe": "toml", "texture": "zip"}
_ALL = ("skeleton", "compare", "maze", "crack")
_LABELS: dict[str, tuple[str, tuple[str, ...]]] = {
    "png": ("PNG picture", _ALL),
    "svg": ("SVG drawing", _ALL),
    "dxf": ("DXF drawing", _ALL),
    "texture": ("Texture folder", ("crack",)),
    "recipe": ("Recipe (TOML)", ("crack",)),
}
