"""Pictures as arrays: reading files, and colour to brightness."""

from __future__ import annotations

import contextlib
import os
import threading
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.arguments import regular
from crazing.errors import CrazingError
from crazing.extras import require

#: Most pixels of a file that is read: 16384 x 16384, the largest picture of our own.
PIXEL_LIMIT = 1 << 28

# A file of any other kind is refused before a decoder sees it.
_FORMATS = ("PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP")

# Pillow's modes of one number a pixel; all others become colour.
_KEPT = frozenset({"1", "L", "F", "I", "I;16", "I;16L", "I;16B", "I;16N"})

# Rec. ITU-R BT.709, item 3.2.
_LUMINANCE = (0.2126, 0.7152, 0.0722)


def read_image(path: str | os.PathLike[str] | BinaryIO) -> NDArray[Any]:
    """The first picture of a PNG, JPEG, TIFF, BMP, GIF or WebP file.

    Needs Pillow, the extra `image`. The orientation noted by a camera is applied.

    Parameters
    ----------
    path : str, path-like or binary file
        The file, or one open for reading; its content decides the format, not its name.

    Returns
    -------
    ndarray
        Row 0 is the top. Grey pictures and label images (H, W) with the values of the file: bool for 1 bit, uint8,
        uint16 or int32, float32. Colour (H, W, 3), with transparency (H, W, 4), uint8; palettes are looked up.

    Raises
    ------
    OSError
        If the file cannot be opened, e.g. FileNotFoundError.
    CrazingError
        If the file is no such picture, is damaged or has more than 2**28 pixels (found in its header, before any
        pixel is decoded).
    ImportError
        If Pillow is not installed.

    Examples
    --------
    >>> import os, tempfile
    >>> from PIL import Image
    >>> from crazing.images import read_image
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = os.path.join(folder, "grey.png")
    ...     Image.new("L", (3, 2), 7).save(path)
    ...     read_image(path)
    array([[7, 7, 7],
           [7, 7, 7]], dtype=uint8)
    """
    library = require("PIL.Image", "image")
    name = os.fspath(path) if isinstance(path, (str, os.PathLike)) else _called(path)
    with _opened(path) as stream, _our_limit:
        try:
            with library.open(stream, formats=_FORMATS) as picture:
                _check_size(picture.size, name)
                return _pixels(picture)
        except (CrazingError, MemoryError):
            raise
        except library.UnidentifiedImageError:
            raise CrazingError(f"{name} {_unreadable(stream)}") from None
        except Exception as error:  # Decoders of damaged files raise whatever their parsing runs into.
            if isinstance(error, OSError) and error.errno is not None:
                raise
            raise CrazingError(f"{name} cannot be read as a picture: {error}") from error


class _Limit:
    """Puts Pillow's limit on pixels at ours while pictures are read, and back when the last is done.

    Pillow's own is a third of ours, it is one number for the whole process, and some decoders look at it late.
    """

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._readers = 0
        self._before: int | None = None

    def __enter__(self) -> None:
        library: Any = require("PIL.Image", "image")
        with self._lock:
            if self._readers == 0:
                self._before, library.MAX_IMAGE_PIXELS = library.MAX_IMAGE_PIXELS, PIXEL_LIMIT
            self._readers += 1

    def __exit__(self, *_: object) -> None:
        library: Any = require("PIL.Image", "image")
        with self._lock:
            self._readers -= 1
            if self._readers == 0:
                library.MAX_IMAGE_PIXELS = self._before


_our_limit = _Limit()


def _called(file: BinaryIO) -> str:
    name = getattr(file, "name", None)
    return name if isinstance(name, str) else "the picture"


def _unreadable(stream: BinaryIO) -> str:
    """Why a file is no picture for us, and what is."""
    head = b""
    with contextlib.suppress(OSError):
        stream.seek(0)
        head = stream.read(4)
    if head in (b"II*\0", b"MM\0*"):
        # What science writes, as doubles or float colours, is a TIFF all the same.
        wanted = "one number a pixel of 1, 8 or 16 bits, int32 or float32, or colours of 8 or 16 bits, are wanted"
        return f"is a TIFF that is damaged or of a kind that is not read; {wanted}"
    return "is not a readable picture; PNG, JPEG, TIFF, BMP, GIF or WebP is wanted"


def _opened(path: str | os.PathLike[str] | BinaryIO) -> contextlib.AbstractContextManager[BinaryIO]:
    return Path(path).open("rb") if isinstance(path, (str, os.PathLike)) else contextlib.nullcontext(path)


def _check_size(size: tuple[int, int], name: str) -> None:
    width, height = size
    if width * height > PIXEL_LIMIT:
        raise CrazingError(f"{name} has {width} x {height} pixels; at most {PIXEL_LIMIT} are read")


def _pixels(picture: Any) -> NDArray[Any]:
    """The decoded pixels, upright, in native byte order."""
    require("PIL.ImageOps", "image").exif_transpose(picture, in_place=True)
    if picture.mode not in _KEPT:
        picture = picture.convert("RGBA" if picture.has_transparency_data else "RGB")
    pixels = np.array(picture)
    return pixels.astype(pixels.dtype.newbyteorder("="), copy=False)


def brightness(image: ArrayLike, name: str = "image") -> NDArray[np.float64]:
    """One number a pixel of a grey or colour image.

    Parameters
    ----------
    image : array_like
        (H, W) grey, (H, W, 3) colour or (H, W, 4) colour with straight alpha, of bool, integers or floats.

    Returns
    -------
    (H, W) float64
        Integers divided by the largest number of their dtype, so that unsigned ones lie in [0, 1]; bools 0 and 1;
        floats as they are. Colour becomes its luminance, weighted as in Rec. 709, of the values as stored; what is
        transparent is laid over white, which is 1.

    Raises
    ------
    TypeError
        If the dtype is none of these.
    ValueError
        If the shape is none of these.
    CrazingError
        If a pixel is NaN or infinite; the message names the first.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.images import brightness
    >>> brightness(np.array([[0, 51, 255]], dtype=np.uint8))
    array([[0. , 0.2, 1. ]])
    """
    if isinstance(image, (str, os.PathLike)):
        raise TypeError(f"{name} is {os.fspath(image)!r}; pixels are wanted: crazing.images.read_image reads a file")
    array = regular(image, name)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} has dtype {array.dtype}; bool, integers or floats are wanted")
    if array.ndim != 2 and not (array.ndim == 3 and array.shape[2] in (3, 4)):
        raise ValueError(f"{name} has shape {array.shape}; (H, W), (H, W, 3) or (H, W, 4) is wanted")
    if not array.size:
        raise ValueError(f"{name} has {array.shape[0]} x {array.shape[1]} pixels; one pixel or more is wanted")
    if array.dtype.kind == "f":
        _check_finite(array, name)
    if array.ndim == 2:
        return _scaled(array)
    grey = sum(weight * _scaled(array[..., i]) for i, weight in enumerate(_LUMINANCE))
    if array.shape[2] == 4:
        alpha = _scaled(array[..., 3])
        grey = alpha * grey + (1.0 - alpha)
    return np.asarray(grey, dtype=np.float64)


def _check_finite(array: NDArray[Any], name: str) -> None:
    bad = ~np.isfinite(array)
    if bad.any():
        where = tuple(int(i) for i in np.unravel_index(np.argmax(bad), array.shape))
        raise CrazingError(f"{name}{list(where)} is {array[where]}; every pixel must be finite")


def _scaled(array: NDArray[Any]) -> NDArray[np.float64]:
    values = array.astype(np.float64)
    return values / np.iinfo(array.dtype).max if array.dtype.kind in "iu" else values
