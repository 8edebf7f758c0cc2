"""From the numbers of a map to the samples of a file: pixel by pixel, so that a part is a part of the whole."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.errors import CrazingError

#: The maps of a texture that each picture is made of; a picture named nowhere is the map of that name.
SOURCES: dict[str, tuple[str, ...]] = {
    "normal_gl": ("normal",),
    "normal_dx": ("normal",),
    "orm": ("ao", "roughness"),
}
COLORS = ("color",)
COVERAGE = ("mask",)
UNIT = ("height", "ao", "roughness", "wear", "orm")
VECTORS = ("normal_gl", "normal_dx", "direction")
LABELS = ("cell", "strand", "generation")

#: All pictures there are.
PICTURES = (*COLORS, *COVERAGE, *VECTORS, *UNIT, *LABELS, "distance")

#: The largest number of 16 bits.
_HALF = 65504.0

# Maps that the eye takes for smooth at 8 bits; slopes and lengths need 16.
_SHALLOW = ("ao", "roughness", "wear", "orm")

#: Distances that whole numbers hold, as a part of the height shown, on either side of zero.
REACH = 1 / 32


@dataclass(frozen=True)
class Format:
    """How a picture is stored: the kind of file, and the bits of a number that is not a label."""

    kind: str
    ending: str
    bits: int
    word: str


#: By the name a user gives. "png" has as many bits as each map needs; zarr keeps every number as it is.
FORMATS = {
    "png": Format("png", ".png", 0, "PNG"),
    "png8": Format("png", ".png", 8, "PNG"),
    "png16": Format("png", ".png", 16, "PNG"),
    "tiff16": Format("tiff", ".tif", 16, "TIFF"),
    "tiff32": Format("tiff", ".tif", 32, "TIFF"),
    "exr16": Format("exr", ".exr", 16, "EXR"),
    "exr32": Format("exr", ".exr", 32, "EXR"),
    "zarr": Format("zarr", ".zarr", 32, "ZARR"),
}

#: The format of a single file whose ending alone is given.
ENDINGS = {".png": "png", ".tif": "tiff32", ".tiff": "tiff32", ".exr": "exr32", ".zarr": "zarr"}


def sources(pictures: tuple[str, ...]) -> tuple[str, ...]:
    """The maps of a texture that these pictures are made of."""
    return tuple(dict.fromkeys(name for picture in pictures for name in SOURCES.get(picture, (picture,))))


def layer(picture: str, maps: Mapping[str, NDArray[Any]]) -> NDArray[Any]:
    """The numbers of a picture, from the maps of a texture."""
    if picture == "orm":
        # Occlusion, roughness, metal: there is none.
        return np.stack([maps["ao"], maps["roughness"], np.zeros_like(maps["ao"])], axis=-1)
    array = maps[SOURCES.get(picture, (picture,))[0]]
    if picture == "normal_dx":
        array = array * np.array([1, -1, 1], dtype=array.dtype)
    if picture == "direction":
        # No format of pictures has two channels that are not grey and alpha.
        array = np.concatenate([array, np.zeros_like(array[..., :1])], axis=-1)
    return array


def samples(picture: str, numbers: NDArray[Any], form: Format, reach: float) -> NDArray[Any]:
    """(H, W) or (H, W, 3) samples as a file of that format holds them.

    Whole numbers hold 0 to 1 in their full range, -1 to 1 of vectors likewise, distances from -`reach` to `reach`,
    and labels grown by one, so that 0 is none. Floats are as they are; in EXR colours are linear and labels unsigned.

    Raises
    ------
    CrazingError
        When a label or a distance is too large for the format.
    """
    if form.kind == "zarr" or (form.kind == "tiff" and picture in LABELS):
        return numbers
    if form.kind == "exr":
        return _of_exr(picture, numbers, form)
    if picture in COLORS or picture in COVERAGE:
        return numbers
    if picture in LABELS:
        return _labels(picture, numbers, np.uint16)
    if form.bits == 32:
        return numbers
    shallow = form.bits == 8 or (form.bits == 0 and picture in _SHALLOW)
    return _levels(picture, numbers, np.dtype(np.uint8 if shallow else np.uint16), reach)


def _levels(picture: str, numbers: NDArray[Any], dtype: np.dtype[Any], reach: float) -> NDArray[Any]:
    """Numbers as levels of an unsigned type, rounded to the nearest."""
    top = np.iinfo(dtype).max
    out = np.empty(numbers.shape, dtype=dtype)
    half, low = (0.5, -1.0) if picture in VECTORS else (0.5 / reach, -reach) if picture == "distance" else (1.0, 0.0)
    _core.levels(np.ascontiguousarray(numbers, dtype=np.float32), low, half * top, out)
    return out


def _labels(picture: str, numbers: NDArray[Any], dtype: type[np.unsignedinteger[Any]]) -> NDArray[Any]:
    most, top = int(numbers.max(initial=-1)), int(np.iinfo(dtype).max)
    if most >= top:
        raise CrazingError(f"{picture} has the label {most}; a PNG holds labels below {top}: choose tiff32 or zarr")
    return (numbers + 1).astype(dtype)


def _of_exr(picture: str, numbers: NDArray[Any], form: Format) -> NDArray[Any]:
    if picture in LABELS:
        return (numbers + 1).astype(np.uint32)
    if picture in COLORS:
        numbers = _LINEAR[numbers]
    elif picture in COVERAGE:
        numbers = numbers.astype(np.float32) / 255
    if form.bits == 32:
        return numbers.astype(np.float32)
    most = float(np.abs(numbers).max(initial=0.0, where=np.isfinite(numbers)))
    if most > _HALF:
        raise CrazingError(f"{picture} reaches {most:g}; exr16 holds numbers to {_HALF:g}: choose exr32")
    return numbers.astype(np.float16)


def _linear() -> NDArray[np.float32]:
    """Light of the 256 levels of sRGB, IEC 61966-2-1."""
    level = np.arange(256) / 255
    return np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4).astype(np.float32)


_LINEAR = _linear()
