"""Textures of any size, from the pattern straight into files."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from numpy.typing import ArrayLike

from crazing import provenance
from crazing.material import Material
from crazing.pictures.output import Wanted, pictures_of, shown_by, words, write
from crazing.pictures.samples import sources
from crazing.texture import texture_plan


def write_texture(
    crack: Any,
    path: str | os.PathLike[str],
    size: int | tuple[int, int],
    *,
    maps: str | Iterable[str] = ("color", "normal", "height", "ao", "roughness"),
    material: Material | str | None = None,
    bounds: ArrayLike | None = None,
    seed: int = 0,
    format: str | None = None,
    layout: str = "plain",
    name: str = "texture",
    metres: float = 1.0,
    origin: Mapping[str, Any] | None = None,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> tuple[Path, ...]:
    """Draw a texture of any size straight into files, in bounded memory.

    The maps are drawn in bands of 16 to 256 rows, as many as fit 128 MiB, and a band is written while the next one
    is drawn. Memory stays below 768 MiB besides the pattern while 16 rows of all maps fit those 128 MiB: up to a width
    of 140,000 pixels for every map, a million for one. EXR alone is collected whole, and begun anew. The samples are
    those of :meth:`Texture.save`, bit for bit.

    A run that is stopped leaves the folder ``.NAME.part`` beside `path`, or ``.part`` in it where it is a folder that
    was there before, with the finished bands of every file. The same call goes on behind them, after it has held what
    is there to its checksums; another one begins anew. Files take their place when all are whole: links are followed,
    an existing file keeps its permissions.

    Parameters
    ----------
    crack : Crack
        The pattern.
    path : str or path-like
        A file for one map: its ending is ``.png``, ``.tif``, ``.exr`` or ``.zarr``. Else a folder for several, which
        also gets a MaterialX file, and glTF with PNG, when there is colour.
    size : int or (height, width)
        Pixels; one integer means a square.
    maps : str or sequence of str
        Names of maps, see :class:`Texture`, or ``"all"``. Beyond those, ``"normal_gl"`` (green is up) and
        ``"normal_dx"`` (green is down) are what ``"normal"`` becomes, as the layout has it (the first of two where
        `path` is one file), and ``"orm"`` is
        occlusion, roughness and metal in red, green and blue.
    material : Material or str, optional
        Profile and colours, or the name of a preset that has them.
    bounds : (xmin, ymin, xmax, ymax), optional
        What is shown, data units; the crack's own bounds by default.
    seed : int, optional
        Seed of grain, patches and the differences between plates.
    format : str, optional
        ``"png"``: 8 bits for colours, coverage and what looks smooth in them, 16 for the rest; ``"png8"``,
        ``"png16"``, ``"tiff16"``, ``"tiff32"`` (floats), ``"exr16"``, ``"exr32"``, ``"zarr"``. By default the ending
        of a file decides (floats for TIFF and EXR), and folders get PNG.
        Labels (cell, strand, generation) are one more in PNG and EXR, so that 0 is none; in TIFF and Zarr none is -1.
        Whole numbers hold 0 to 1, -1 to 1 of vectors, and distances in their full range; colours are linear in EXR.
    layout : {"plain", "ambientcg", "polyhaven", "unreal"}, optional
        How files in a folder are called.
    name : str, optional
        Name of the material, in the names of files.
    metres : float, optional
        Metres a data unit: the files say how many pixels a metre has.
    origin : mapping, optional
        How the crack was made, for :func:`rerun`; by default the files carry the pattern itself, if it is small.
    threads : int, optional
        None takes all cores.
    progress : callable, optional
        Called with the rows that are done and all rows.

    Returns
    -------
    tuple of Path
        The files.

    Raises
    ------
    TypeError, ValueError
        For arguments of the wrong kind, shape or range, also of several maps for one file.
    CrazingError
        When a label is too large for PNG or a distance for ``"exr16"``, or another run has begun to make the same
        files.
    ImportError
        When a format needs a package that is not installed.
    OSError
        When a file cannot be written.

    Examples
    --------
    >>> import crazing as cz
    >>> cz.write_texture(cz.crack(n=50, rng=1), "height.tif", 128, maps="height")[0].name
    'height.tif'
    """
    wanted = Wanted(words(maps), format, layout, name, metres)
    pictures = pictures_of(path, wanted)
    plan = texture_plan(
        crack, size, maps=sources(pictures), material=material, bounds=bounds, threads=threads, seed=seed
    )
    width = plan.size[1]
    shown = shown_by(plan, provenance.of_crack(crack) if origin is None else origin)
    return write(path, wanted, shown, lambda top, rows: plan.window(top, 0, rows, width), progress)
