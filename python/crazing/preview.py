"""Quick pictures of crack patterns in the colours of a material."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import recipe as _recipe
from crazing import rng as _rng
from crazing.material import Material, preset_material
from crazing.render import Style, render


def preview(
    what: Any,
    size: int | tuple[int, int] = 512,
    *,
    material: Material | str | None = None,
    rng: _rng.RNG = None,
    threads: int | None = None,
) -> NDArray[np.uint8]:
    """Draw a crack pattern in two colours of a material, fast enough to follow a slider.

    Parameters
    ----------
    what : Crack, Recipe or str
        A pattern, a recipe, or the name of a preset.
    size : int or (height, width)
        Pixels; one integer means a square.
    material : Material or str, optional
        The material or the name of a preset that has one; by default the preset's own, if `what` names one.
    rng : int, numpy.random.Generator or None, optional
        Seed of the pattern that a recipe or a preset makes.
    threads : int, optional
        None takes all cores.

    Returns
    -------
    (H, W, 4) uint8
        sRGB and straight alpha, as :func:`crazing.render` draws it: cracks over the middle of the material's ramp.

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong kind, shape or range.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.preview(cz.Recipe(n=300), 128, rng=1).shape
    (128, 128, 4)
    """
    if isinstance(what, str):
        material = what if material is None else material
        what = _recipe.preset(what)
    if isinstance(material, str):
        material = preset_material(material)
    material = Material() if material is None else material
    if not isinstance(material, Material):
        raise TypeError(f"material is {type(material).__name__}; a crazing.Material or the name of a preset is wanted")
    crack = what.crack(rng=rng) if isinstance(what, _recipe.Recipe) else what
    return render(crack, size, style=Style(ink=material.crack, ground=material.middle), threads=threads)
