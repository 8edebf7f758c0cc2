"""Textures under a light, to look at."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import arguments

if TYPE_CHECKING:
    from crazing.texture import Texture

#: Light that comes from everywhere, as a part of white under the lamp.
_SKY = 0.32

#: How much of the light a smooth surface that is no metal mirrors straight back.
_MIRROR = 0.04

#: Brightest exposure; all that is not black is white long before.
_BRIGHTEST = 1e6

#: Lowest sine of the lamp's height: the light on a level surface is a division by it.
_LOWEST = 1e-6

#: Most pixels that a shadow is followed over.
_REACH = 48


def shade(texture: Texture, *, light: ArrayLike = (-0.55, 0.65, 0.8), exposure: float = 1.0) -> NDArray[np.uint8]:
    """Show a texture in the light of a far lamp and a grey sky.

    Parameters
    ----------
    texture : Texture
        With the maps color, normal, ao and height; roughness is used where it is there.
    light : (right, up, out)
        Where the lamp is.
    exposure : float
        Brightens (above 1) or darkens.

    Returns
    -------
    (H, W, 3) uint8
        sRGB. A texture that tiles gives a picture that does.

    Raises
    ------
    TypeError, ValueError
        If a map is missing, or the lamp is not above the surface.

    Notes
    -----
    Lambert's diffuse and Blinn and Phong's specular reflection, shadows along the height map, occlusion of the sky.
    For judging textures, not for rendering scenes.

    Examples
    --------
    >>> import crazing as cz
    >>> t = cz.texture(cz.crack(n=30, rng=1), 64)
    >>> cz.shade(t).shape
    (64, 64, 3)
    """
    if not isinstance(texture, Mapping):
        raise TypeError(f"texture is {arguments.found(texture)}; what texture() made is wanted")
    missing = [name for name in ("color", "normal", "ao", "height") if name not in texture]
    if missing:
        raise ValueError(f"the texture lacks {', '.join(missing)}; ask for these maps")
    exposure = arguments.number(exposure, "exposure", low=0.0, high=_BRIGHTEST)
    lamp = arguments.real_array(light, "light")
    if lamp.shape != (3,) or not np.isfinite(lamp).all() or not lamp[2] > 0:
        raise ValueError(f"light is {light!r}; three finite numbers, the last above 0, are wanted")
    with np.errstate(over="ignore"):
        away = float(np.linalg.norm(lamp))
    if not (0.0 < away < np.inf and lamp[2] >= away * _LOWEST):
        raise ValueError(f"light is {light!r}; a lamp surely above the horizon, from 1e-150 to 1e150 off, is wanted")
    sun = (lamp / away).astype(np.float32)
    albedo = _linear()[texture["color"]]
    normal = texture["normal"]
    facing = np.maximum(normal @ sun, 0.0) * _sunlit(texture, sun)
    half = sun + np.array([0.0, 0.0, 1.0], dtype=np.float32)
    half /= np.linalg.norm(half)
    rough = texture["roughness"] if "roughness" in texture else np.float32(0.6)
    gloss = 2.0 / np.maximum(rough, 0.12) ** 4 - 2.0
    # The part of the light that Blinn's microfacets mirror: on a rough surface hardly any, or black cracks turn grey.
    mirror = _MIRROR * (gloss + 2.0) / 8.0 * np.maximum(normal @ half, 0.0) ** gloss
    # The lamp lights a level surface fully, wherever it is.
    lit = albedo * (_SKY * texture["ao"] + (1.0 - _SKY) / sun[2] * facing)[..., None]
    return _srgb((lit + (mirror * facing)[..., None]) * exposure)


def _sunlit(texture: Texture, lamp: NDArray[np.float32]) -> NDArray[np.float32]:
    """How much of the lamp is seen from every pixel, 0 to 1: nothing on the way to it may stand higher."""
    height = texture["height"] * np.float32(texture.relief * texture.scale)
    across = float(np.hypot(lamp[0], lamp[1]))
    blocked = np.zeros_like(height)
    if across == 0.0:
        return np.ones_like(height)
    rise = float(lamp[2]) / across
    reach = min(_REACH, int(np.ptp(height) / rise) + 1)
    for step in range(1, reach + 1):
        right, up = round(step * float(lamp[0]) / across), round(step * float(lamp[1]) / across)
        # The pixel towards the lamp comes to lie here; the border of what does not tile looks at itself.
        if texture.tiles:
            there = np.roll(height, (up, -right), axis=(0, 1))
        else:
            rows = np.clip(np.arange(height.shape[0]) - up, 0, height.shape[0] - 1)
            columns = np.clip(np.arange(height.shape[1]) + right, 0, height.shape[1] - 1)
            there = height[rows[:, None], columns]
        np.maximum(blocked, there - height - np.float32(rise * np.hypot(right, up)), out=blocked)
    # A soft edge, two pixels wide.
    return np.asarray(1.0 - np.minimum(blocked * 0.5, 1.0), dtype=np.float32)


def _linear() -> NDArray[np.float32]:
    value = np.arange(256) / 255.0
    light = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    return light.astype(np.float32)


def _srgb(light: NDArray[np.float32]) -> NDArray[np.uint8]:
    steps = np.arange(4097) / 4096
    table = np.where(steps <= 0.0031308, steps * 12.92, 1.055 * steps ** (1 / 2.4) - 0.055)
    return np.round(table * 255).astype(np.uint8)[(np.clip(light, 0.0, 1.0) * 4096 + 0.5).astype(np.intp)]
