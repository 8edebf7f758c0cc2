"""Which files a texture becomes, and the making of them."""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from crazing import _core, arguments, provenance
from crazing.extras import require
from crazing.files import atomic_write
from crazing.pictures import layouts, scene
from crazing.pictures.job import Job, Maps, Picture, Progress
from crazing.pictures.samples import ENDINGS, FORMATS, PICTURES, REACH, Format
from crazing.versions import algorithm_version

#: Least and most metres of a data unit; pixels a metre are then numbers of a file still.
_METRES = (1e-30, 1e30)

#: What `maps="all"` makes: every map, and the one that is packed of three.
ALL = ("normal", *(name for name in PICTURES if not name.startswith("normal")))

_LIBRARIES = {"exr": "OpenEXR", "zarr": "zarr"}


@dataclass(frozen=True)
class Shown:
    """What a texture shows, whoever draws it."""

    size: tuple[int, int]
    scale: float
    """Pixels a data unit."""
    relief: float
    """What heights from 0 to 1 are, data units."""
    tiles: bool
    """Whether the whole repeats."""
    record: Mapping[str, Any]
    """How it is made: version, texture, source."""
    digest: str
    """The hash of the pattern, of which the source may say anything."""


@dataclass(frozen=True)
class Wanted:
    """What a user wants to have of it."""

    maps: tuple[str, ...]
    format: str | None = None
    layout: str = "plain"
    name: str = "texture"
    metres: float = 1.0
    """Metres a data unit."""

    def __post_init__(self) -> None:
        if self.format is not None:
            arguments.choice(self.format, "format", FORMATS)
        layouts.named(self.layout)
        layouts.checked_name(self.name)
        low, high = _METRES
        object.__setattr__(self, "metres", arguments.number(self.metres, "metres", low=low, high=high))


#: Endings of pictures that are not written: a folder is not called by them.
_OTHERS = (
    *(".jpg", ".jpeg", ".webp", ".bmp", ".gif", ".tga", ".dds", ".hdr", ".ktx", ".avif", ".jxl", ".psd"),
    *(".svg", ".pdf", ".dxf", ".geojson", ".mtlx", ".gltf", ".glb"),
)


def is_file(path: str | os.PathLike[str]) -> bool:
    """Whether a path names one picture, by its ending; else it is a folder for several."""
    return Path(path).suffix.lower() in ENDINGS


def refuse_others(path: str | os.PathLike[str]) -> None:
    """Raises where a path names a picture of a kind that is not written, not a folder, or nothing at all."""
    if not os.fspath(arguments.file_path(path)):
        raise ValueError("path is empty; the name of a file or folder is wanted")
    ending = Path(path).suffix.lower()
    if ending in _OTHERS and not Path(path).is_dir():
        raise ValueError(f"{os.fspath(path)} ends in {ending}; {', '.join(ENDINGS)} or a folder is wanted")


def format_of(path: str | os.PathLike[str], format: str | None) -> str:
    """The name of the format of a path: the one that is asked for, or what the ending says; folders get PNG."""
    return format or ENDINGS.get(Path(path).suffix.lower(), "png")


def form_of(path: str | os.PathLike[str], format: str | None) -> Format:
    """The format of a path; the one that is asked for must have its ending."""
    ending = Path(path).suffix.lower()
    form = FORMATS[format_of(path, format)]
    if ending in ENDINGS and FORMATS[ENDINGS[ending]].kind != form.kind:
        raise ValueError(f"{os.fspath(path)} does not end in {form.ending}, as files of the format {format!r} do")
    return form


def pictures_of(path: str | os.PathLike[str], wanted: Wanted) -> tuple[str, ...]:
    """The pictures that the maps become at `path`."""
    refuse_others(path)
    form = form_of(path, wanted.format)
    for i, word in enumerate(wanted.maps):
        arguments.choice(word, f"maps[{i}]", ("normal", *PICTURES))
    if not wanted.maps:
        raise ValueError("maps is empty; name at least one")
    if not is_file(path):
        maps = wanted.maps
        if form.kind == "png" and {"color", "ao", "roughness"} <= set(maps):
            # The plane of glTF takes them in one picture.
            maps = (*maps, "orm")
        return layouts.chosen(maps, layouts.named(wanted.layout))
    layout = layouts.named(wanted.layout)
    # Of two kinds of normals one file takes the first.
    pictures = layouts.chosen(wanted.maps, dataclasses.replace(layout, normals=layout.normals[:1]))
    if len(pictures) != 1:
        raise ValueError(f"{os.fspath(path)} holds one map, {len(pictures)} are wanted; name a folder for several")
    return pictures


def write(
    path: str | os.PathLike[str],
    wanted: Wanted,
    shown: Shown,
    draw: Callable[[int, int], Maps],
    progress: Progress | None = None,
) -> tuple[Path, ...]:
    """Make the files at `path`; their paths, scenes last."""
    target, form, word = Path(path), form_of(path, wanted.format), format_of(path, wanted.format)
    _check(target)
    if form.kind in _LIBRARIES:
        require(_LIBRARIES[form.kind], "texture")
    pictures = pictures_of(path, wanted)
    reach = REACH * shown.size[0] / shown.scale
    real, name = Path(os.path.realpath(target)), _namer(target, form, wanted, shown)
    made = tuple(
        Picture(
            picture, target / name(picture), real / name(picture), form, _record(picture, word, wanted, shown, reach)
        )
        for picture in pictures
    )
    density = shown.scale / wanted.metres
    if max(shown.size) / density > _METRES[1]:
        raise ValueError(
            f"the whole is {max(shown.size) / density:g} metres wide or high; at most {_METRES[1]:g} are wanted"
        )
    part = _part(real, is_file(target))
    try:
        Job(made, shown.size, draw, (density, density), reach, part, shown.digest).run(progress)
    except OSError as error:
        if error.errno is not None and (error.filename is None or part in (Path(error.filename) / "_").parents):
            # Of what was asked for, not of the folder of parts.
            raise OSError(error.errno, error.strerror, str(target)) from error
        raise
    paths = tuple(picture.target for picture in made)
    return paths if is_file(path) else paths + _scenes(target, made, wanted, shown, density)


def _part(real: Path, is_one: bool) -> Path:
    """The folder of unfinished files, from where a rename takes them to their places."""
    beside = real.parent / f".{real.name}.part"
    # A folder may lie on another disk than its neighbours, or among what is not the user's. Unlike a path, `os` takes
    # a name that is too long for one that is not there.
    return real / ".part" if not is_one and real.is_dir() and not os.path.isdir(beside) else beside  # noqa: PTH112


def _check(target: Path) -> None:
    if is_file(target):
        is_store = target.suffix.lower() == ".zarr" and (target / "zarr.json").exists()
        if target.is_dir() and not is_store:
            raise IsADirectoryError(21, "is a folder", str(target))
    elif target.exists() and not target.is_dir():
        raise NotADirectoryError(20, "is a file; a folder, or the ending of a picture, is wanted", str(target))
    if not target.parent.is_dir():
        raise FileNotFoundError(2, "lies in no folder", str(target))


def _namer(target: Path, form: Format, wanted: Wanted, shown: Shown) -> Callable[[str], str]:
    """What the file of a picture is called in the folder; nothing where the target is the file itself."""
    layout, pixels = layouts.named(wanted.layout), max(shown.size)
    if is_file(target):
        return lambda picture: ""
    return lambda picture: layout.file(wanted.name, picture, pixels, form.word, form.ending)


def _record(picture: str, form: str, wanted: Wanted, shown: Shown, reach: float) -> dict[str, Any]:
    texture = {**shown.record["texture"], "metres": wanted.metres, "texel_size": wanted.metres / shown.scale}
    if picture == "distance":
        texture["reach"] = reach
    return {**shown.record, "texture": texture, "picture": picture, "format": form}


def _scenes(folder: Path, made: tuple[Picture, ...], wanted: Wanted, shown: Shown, density: float) -> tuple[Path, ...]:
    """MaterialX beside pictures of colour, and glTF where they are PNG."""
    files = {picture.name: picture.target.name for picture in made}
    form = made[0].form
    if "color" not in files or form.kind == "zarr":
        return ()
    height, width = shown.size
    record = _record("scene", made[0].record["format"], wanted, shown, 0.0)
    sides, relief = (width / density, height / density), shown.relief * wanted.metres
    about = scene.Scene(wanted.name, files, sides, relief, shown.tiles, form, record)
    texts = {folder / f"{wanted.name}.mtlx": scene.materialx(about)}
    if form.kind == "png":
        texts[folder / f"{wanted.name}.gltf"] = scene.gltf(about)
    for path, text in texts.items():
        with atomic_write(path) as file:
            file.write(text.encode("utf-8"))
    return tuple(texts)


def words(maps: str | Iterable[str]) -> tuple[str, ...]:
    """Names of maps as a tuple."""
    if isinstance(maps, str):
        return ALL if maps == "all" else (maps,)
    if not np.iterable(maps):
        raise TypeError(f"maps is {arguments.found(maps)}; names of maps are wanted")
    return tuple(maps)


def tiles(size: tuple[int, int], scale: float, period: tuple[float, float] | None) -> bool:
    """Whether a picture shows whole periods, which are whole numbers of pixels."""
    return period is not None and all(
        pixels % max(1, round(length * scale)) == 0 for pixels, length in zip(size[::-1], period, strict=True)
    )


def shown_by(drawing: Any, origin: Mapping[str, Any]) -> Shown:
    """What a texture or the plan of one shows, with the record that makes it again."""
    texture = {
        "size": list(drawing.size),
        "bounds": list(drawing.bounds),
        "seed": drawing.seed,
        "material": dataclasses.asdict(drawing.material),
        "relief": drawing.relief,
    }
    if not isinstance(origin, Mapping):
        raise TypeError(f"origin is {arguments.found(origin)}; a mapping is wanted")
    try:
        json.dumps(dict(origin), allow_nan=False)
    except (TypeError, ValueError) as error:
        raise type(error)(f"origin cannot be written as JSON: {error}") from None
    record = {
        "algorithm_version": algorithm_version,
        "version": _core.__version__,
        "command": "texture",
        "texture": texture,
        "source": dict(origin),
    }
    digest = provenance.digest_of(drawing.crack)
    return Shown(drawing.size, drawing.scale, drawing.relief, drawing.tiles, record, digest)
