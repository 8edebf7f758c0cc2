"""The record of how a picture was made, out of its file; and its samples."""

from __future__ import annotations

import json
import os
import struct
import zlib
from pathlib import Path
from typing import Any, BinaryIO

from crazing.errors import CrazingError
from crazing.extras import require
from crazing.pictures.about import KEY

_SIGNATURE = b"\x89PNG\r\n\x1a\n"

#: Bytes of a text that is read: far more than any record has.
LIMIT = 1 << 24


def record_of(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The record in a PNG, TIFF, EXR or Zarr.

    Raises
    ------
    CrazingError
        If the file is of no such kind, is damaged or holds no record.
    OSError
        If it cannot be read.
    ImportError
        When its format needs a package that is not installed.
    """
    source = Path(path)
    name = os.fspath(path)
    try:
        text = _text(source)
    except (ImportError, OSError, CrazingError, MemoryError) as error:
        if isinstance(error, OSError) and error.errno is None:
            raise CrazingError(f"{name} cannot be read: {error}") from None
        raise
    except Exception as error:  # Parsers of damaged files raise whatever they run into.
        raise CrazingError(f"{name} cannot be read: {error}") from error
    try:
        record = json.loads(text) if isinstance(text, str) else text
    except ValueError:
        record = None
    if not isinstance(record, dict) or "algorithm_version" not in record:
        raise CrazingError(f"{name} does not say how it was made")
    return record


def _text(source: Path) -> Any:
    if source.is_dir():
        if not (source / "zarr.json").exists():
            raise CrazingError(f"{source} is a folder; one of the pictures in it is wanted")
        library: Any = require("zarr", "texture")
        return library.open_array(store=str(source), mode="r").attrs.get(KEY)
    with source.open("rb") as file:
        head = file.read(8)
        if head == _SIGNATURE:
            return _png_text(file)
    if head[:4] in (b"II*\0", b"II+\0"):
        library = require("tifffile", "texture")
        with library.TiffFile(source) as tiff:
            return tiff.pages[0].description
    if head[:4] == b"\x76\x2f\x31\x01":
        library = require("OpenEXR", "texture")
        with library.File(str(source), header_only=True) as exr:
            return exr.header().get(KEY)
    raise CrazingError(f"{source} is no PNG, TIFF, EXR or Zarr")


def _png_text(file: BinaryIO) -> str | None:
    """The text of our keyword, which stands before the pixels."""
    while len(head := file.read(8)) == 8:
        size, kind = struct.unpack(">I4s", head)
        if kind in (b"IDAT", b"IEND") or size > LIMIT:
            return None
        data = file.read(size)
        checksum = file.read(4)
        if struct.pack(">I", zlib.crc32(kind + data)) != checksum:
            raise ValueError("a chunk does not have its checksum")
        keyword, _, rest = data.partition(b"\0")
        if kind == b"tEXt" and keyword == KEY.encode():
            return rest.decode("latin-1")
    return None
