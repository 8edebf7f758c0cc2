"""A picture made again, from what its file says."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from crazing import arguments, provenance
from crazing.errors import CrazingError
from crazing.material import Material
from crazing.pictures.output import is_file
from crazing.pictures.reading import record_of
from crazing.pictures.samples import ENDINGS, FORMATS, PICTURES
from crazing.streaming import write_texture
from crazing.versions import algorithm_version


def rerun(
    source: str | os.PathLike[str],
    path: str | os.PathLike[str],
    *,
    threads: int | None = None,
    progress: Callable[[int, int], object] | None = None,
) -> Path:
    """Make a picture again from the record in its file: the same pixels.

    Parameters
    ----------
    source : str or path-like
        A map that :meth:`Texture.save` or :func:`write_texture` wrote: PNG, TIFF, EXR or Zarr. Its pixels are not
        looked at.
    path : str or path-like
        Where to: a file whose ending is that of the format, whatever `source` is called by now.
    threads : int, optional
        None takes all cores.
    progress : callable, optional
        Called with the rows that are done and all rows.

    Returns
    -------
    Path
        The new file.

    Raises
    ------
    ValueError
        If `path` has another ending.
    CrazingError
        If the file holds no record or a damaged one, was made by another version of the algorithms, or its pattern
        was not kept.
    OSError
        If a file cannot be read or written.

    Examples
    --------
    >>> import crazing as cz
    >>> first, = cz.write_texture(cz.crack(n=50, rng=1), "first.png", 64, maps="mask")
    >>> again = cz.rerun(first, "again.png")
    >>> again.read_bytes() == first.read_bytes()
    True
    """
    record = record_of(arguments.file_path(source, "source"))
    check_version(record, source)
    given = _given(record, source)
    if not is_file(path):
        wanted = FORMATS[given["format"]].ending
        raise ValueError(f"{os.fspath(path)} does not end in {wanted}, as files of the format {given['format']!r} do")
    (made,) = write_texture(provenance.crack_of(record["source"]), path, threads=threads, progress=progress, **given)
    return made


def again(source: str | os.PathLike[str], record: Mapping[str, Any]) -> Path:
    """A name beside `source` for the picture made again; it has the ending of the format, also if `source` has not."""
    # A plain picture is a PNG, and its record names no format.
    file, form = Path(source), FORMATS.get(str(record.get("format", "png")), FORMATS["png"])
    does_fit = is_file(file) and FORMATS[ENDINGS[file.suffix.lower()]].kind == form.kind
    return file.with_name(f"{file.stem}.again{file.suffix if does_fit else form.ending}")


def check_version(record: Mapping[str, Any], source: str | os.PathLike[str]) -> None:
    """Refuse a record of other algorithms: they would make another picture."""
    if record["algorithm_version"] != algorithm_version:
        raise CrazingError(
            f"{os.fspath(source)} was made by version {record['algorithm_version']} of the algorithms, "
            f"these are version {algorithm_version}: it would come out different"
        )


def _given(record: Mapping[str, Any], source: str | os.PathLike[str]) -> dict[str, Any]:
    """The arguments of a record."""
    try:
        texture, origin = record["texture"], record["source"]
        picture, form = record["picture"], record["format"]
        if picture not in PICTURES or form not in FORMATS or not isinstance(origin, dict):
            raise ValueError(f"it names the picture {picture!r} in the format {form!r}")
        return {
            "size": tuple(texture["size"]),
            "maps": picture,
            "material": Material.from_table(texture["material"]),
            "bounds": texture["bounds"],
            "seed": texture["seed"],
            "metres": texture["metres"],
            "format": form,
            "origin": origin,
        }
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise CrazingError(f"the record in {os.fspath(source)} is damaged: {error}") from None
