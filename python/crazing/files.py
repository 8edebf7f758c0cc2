"""Files that are whole or not there, and pictures in them."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import secrets
import shutil
import stat
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import _core, arguments

_TEXT_LIMIT = 79
"""Characters of a keyword, PNG specification, section 11.3.3.1."""

_PATIENCE = 10.0
"""Seconds that a lock is waited for: what is done under one takes less."""

_AT_A_TIME = 1 << 14
"""Rows made into objects of Python without a look for signals: some milliseconds."""


@contextlib.contextmanager
def atomic_write(path: str | os.PathLike[str], *, room: Path | None = None) -> Iterator[BinaryIO]:
    """Open a binary file beside `path` that takes its place when the block ends well.

    A reader, a crash or a full disk sees the old file or the new one, never a part: the bytes are written to
    ``.tmp-*`` in the same folder, flushed to the disk, renamed, and the folder is flushed. When the block raises,
    nothing is left and `path` is as it was. A killed process leaves at most the ``.tmp-*`` file. An existing file
    keeps its permissions; a link is followed. What is there but no file, as a pipe or ``/dev/null``, stays: it is given
    the bytes when the block has ended well. `room` is another folder of the same disk for the ``.tmp-*`` file, where
    all that is beside `path` is read.

    Raises
    ------
    OSError
        When the folder is not there or cannot be written, or `path` is a folder itself.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from crazing.files import atomic_write
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = Path(folder, "note")
    ...     with atomic_write(path) as file:
    ...         _ = file.write(b"whole")
    ...     path.read_bytes()
    b'whole'
    """
    if _is_device(path):
        with tempfile.TemporaryFile() as file:
            yield file
            file.seek(0)
            with open(path, "wb") as device:
                shutil.copyfileobj(file, device)
        return
    target = Path(os.path.realpath(path))
    if target.is_dir():
        raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(path))
    # Named before it is there: an interrupt finds it at any time.
    name = (room or target.parent) / f".tmp-{secrets.token_hex(8)}"
    try:
        with _created(name, path) as file:
            os.chmod(name, _mode(target))
            yield file
            file.flush()
            os.fsync(file.fileno())
        os.replace(name, target)
    except BaseException as error:
        with contextlib.suppress(OSError):
            os.unlink(name)
        if isinstance(error, OSError) and error.errno and error.filename is None:
            # A full disk is told of by the write, which knows no name.
            error.filename = str(path)
        raise
    _flush_folder(target.parent)


@contextlib.contextmanager
def alone_in(folder: Path) -> Iterator[None]:
    """Keep other processes that ask for the same folder waiting until the block ends.

    Nobody waits where folders cannot be locked, nor for long where one is held all along, as a script may hold it.
    """
    try:
        import fcntl

        number = os.open(folder, os.O_RDONLY)
    except (ImportError, OSError):
        yield
        return
    try:
        until = time.monotonic() + _PATIENCE
        while time.monotonic() < until:
            try:
                fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                time.sleep(0.01)
            except OSError:
                break
            else:
                break
        yield
    finally:
        os.close(number)


def rows_of(table: NDArray[np.float64]) -> Iterator[list[float]]:
    """The rows as lists, made many at a time: while all are made at once, Ctrl-C has to wait."""
    for start in range(0, len(table), _AT_A_TIME):
        yield from table[start : start + _AT_A_TIME].tolist()


def _created(name: Path, path: str | os.PathLike[str]) -> BinaryIO:
    """A new file that nobody else may read."""
    try:
        return open(name, "xb", opener=lambda file, flags: os.open(file, flags, 0o600))
    except OSError as error:
        # Of the file that was asked for, not of the one beside it.
        raise OSError(error.errno, error.strerror, str(path)) from None


def _is_device(path: str | os.PathLike[str]) -> bool:
    """Whether something is there that takes bytes and is no file: a rename would put a file in its place."""
    try:
        mode = os.stat(path).st_mode
    except OSError:
        return False
    return not (stat.S_ISREG(mode) or stat.S_ISDIR(mode))


def _mode(target: Path) -> int:
    """Permissions of the file that is there, or those that a new file would get."""
    try:
        return target.stat().st_mode & 0o7777
    except OSError:
        # The mask can only be read by setting it.
        mask = os.umask(0o077)
        os.umask(mask)
        return 0o666 & ~mask


def _flush_folder(folder: Path) -> None:
    """Make a rename last; some systems cannot open a folder, and their renames need no flush."""
    with contextlib.suppress(OSError):
        number = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)


def save_png(
    path: str | os.PathLike[str] | BinaryIO,
    image: ArrayLike,
    *,
    text: Mapping[str, str] | None = None,
    srgb: bool = True,
    density: tuple[float, float] | None = None,
) -> None:
    r"""Write a picture as a PNG of 8 or 16 bits.

    Parameters
    ----------
    path
        Where to, ending in ``.png``; written beside it and renamed into place, see `atomic_write`. Or a file open for
        binary writing.
    image
        (H, W) or (H, W, C) uint8 or uint16, C = 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; straight alpha, row 0 on
        top. Booleans become 0 and 255.
    text
        Keywords and texts to store in the file. ``Software`` is added.
    srgb
        Whether the file says that its samples are sRGB colours; numbers, such as heights, are not.
    density
        Pixels a metre, across and up, to be rounded and stored.

    Raises
    ------
    TypeError, ValueError
        For an image of another dtype or shape, a text that a PNG cannot hold, or a path of another ending.
    OSError
        When the file cannot be written. An exception of a file object's ``write`` comes out as it is.

    Examples
    --------
    >>> import io
    >>> import numpy as np
    >>> from crazing.files import save_png
    >>> file = io.BytesIO()
    >>> save_png(file, np.eye(8, dtype=bool), text={"Title": "diagonal"})
    >>> file.getvalue()[:4]
    b'\x89PNG'
    """
    pixels = _pixels(image)
    pairs = png_text(text)
    if not isinstance(srgb, (bool, np.bool_)):
        raise TypeError(f"srgb is {arguments.found(srgb)}; True or False is wanted")
    about = (8 * pixels.itemsize, pairs, bool(srgb), png_density(density))
    if isinstance(path, (str, os.PathLike)):
        if Path(path).suffix.lower() != ".png" and not _is_device(path):
            raise ValueError(f"path is {os.fspath(path)!r}; an ending of .png is wanted")
        with atomic_write(path) as file:
            _core.encode_png(file, sample_bytes(pixels), *about)
    elif hasattr(path, "write"):
        _core.encode_png(path, sample_bytes(pixels), *about)
    else:
        raise TypeError(f"path is {type(path).__name__}; a path or an open binary file is wanted")


def encoded(image: NDArray[Any]) -> bytes:
    """The bytes of a PNG, as a notebook shows it."""
    file = io.BytesIO()
    save_png(file, image)
    return file.getvalue()


def _pixels(image: ArrayLike) -> NDArray[Any]:
    """`image` as an (H, W, C) array of uint8 or uint16."""
    array = arguments.regular(image, "image")
    if array.dtype == np.bool_:
        array = array.astype(np.uint8) * np.uint8(255)
    if array.dtype.newbyteorder("=") not in (np.uint8, np.uint16):
        raise TypeError(
            f"image has dtype {array.dtype}; uint8 or uint16 is wanted: for values from 0 to 1, "
            "pass np.round(image * 255).astype(np.uint8)"
        )
    shape = array.shape if array.ndim == 3 else (*array.shape, 1)
    if len(shape) != 3 or shape[2] not in (1, 2, 3, 4) or 0 in shape:
        raise ValueError(f"image has shape {array.shape}; (H, W) or (H, W, 1 to 4), not empty, is wanted")
    return array.reshape(shape)


def sample_bytes(pixels: NDArray[Any]) -> NDArray[np.uint8]:
    """(H, W, C) numbers as C-contiguous (H, W, C * itemsize) bytes, little-endian."""
    return np.ascontiguousarray(pixels, dtype=pixels.dtype.newbyteorder("<")).view(np.uint8)


def png_density(density: tuple[float, float] | None) -> tuple[int, int]:
    """Pixels a metre as whole numbers that a PNG holds; zeros where there is none to be said."""
    if density is None:
        return 0, 0
    parts = arguments.entries(density, "density", 2, "(across, up) in pixels a metre")
    across, up = (round(arguments.number(part, f"density[{i}]")) for i, part in enumerate(parts))
    return (across, up) if 0 < across < 2**31 and 0 < up < 2**31 else (0, 0)


def png_text(text: Mapping[str, str] | None) -> list[tuple[str, str]]:
    """Keywords and texts that a PNG can hold, with the one that names us."""
    if not isinstance(text, Mapping | None):
        raise TypeError(f"text is {arguments.found(text)}; a mapping of keywords to strings is wanted")
    pairs: dict[Any, Any] = {**(text or {}), "Software": f"crazing {_core.__version__}"}
    for keyword, words in pairs.items():
        if not (isinstance(keyword, str) and isinstance(words, str)):
            raise TypeError(f"text holds {keyword!r}: {words!r}; strings are wanted")
        if not _is_keyword(keyword):
            raise ValueError(f"text keyword {keyword!r} is not 1 to {_TEXT_LIMIT} printable Latin-1 characters")
        if "\0" in words:
            raise ValueError(f"text of {keyword!r} holds a NUL character")
    return list(pairs.items())


def _is_keyword(keyword: str) -> bool:
    """Whether a PNG may hold the keyword: printable Latin-1, single spaces, none at the ends."""
    is_latin = all(" " <= letter <= "~" or "\xa1" <= letter <= "\xff" for letter in keyword)
    return (
        is_latin
        and 0 < len(keyword) <= _TEXT_LIMIT
        and keyword == " ".join(keyword.split(" ")).strip()
        and "  " not in keyword
    )
