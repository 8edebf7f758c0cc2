"""Points as files and back: CSV, NPY, SVG and GeoJSON. Every format keeps every bit of a coordinate."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable
from typing import Any, TypeAlias
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from crazing import arguments
from crazing.edit import table
from crazing.errors import CrazingError

Points: TypeAlias = NDArray[np.float64]

#: The most points that the editor takes.
MOST_POINTS = 1_000_000

#: Endings of files of points.
FORMATS = ("csv", "npy", "svg", "geojson")

# How the pictures that are read begin: PNG, JPEG, TIFF, BMP, GIF, WebP.
_PICTURES = (b"\x89PNG", b"\xff\xd8\xff", b"II*\0", b"MM\0*", b"BM", b"GIF8", b"RIFF")

#: Marks the group of an SVG that holds points, one circle each.
_GROUP = "crazing-points"

# With a prefix, as programs write it that give every name one.
_DRAWING = re.compile(rb"<(\w+:)?svg\b")

_NPY = b"\x93NUMPY"


def checked(points: Any) -> Points:
    """`points` as a finite (n, 2) array of at most `MOST_POINTS`."""
    array = arguments.points_array(points)
    if len(array) > MOST_POINTS:
        raise CrazingError(f"there are {len(array)} points; at most {MOST_POINTS} are taken")
    bad = ~np.isfinite(array).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        raise CrazingError(f"points[{row}] is {tuple(array[row].tolist())}; every coordinate must be finite")
    return array


def written(points: Points, ending: str) -> bytes:
    r"""The points as the content of a file.

    Parameters
    ----------
    points : (n, 2) float64
        Finite.
    ending : {"csv", "npy", "svg", "geojson"}
        The format.

    Returns
    -------
    bytes

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.edit.exchange import written
    >>> written(np.array([[0.1, 2.0]]), "csv")
    b'x,y\n0.1,2.0\n'
    """
    return _WRITERS[arguments.choice(ending, "format", _WRITERS)](points)


def load(content: bytes) -> Points:
    r"""The points of a file, whose content tells its format.

    Parameters
    ----------
    content : bytes
        CSV (two columns, or those named x and y; see :func:`crazing.edit.table.points`), NPY, GeoJSON (the positions
        of any geometry), or SVG with circles written by :func:`written`.

    Returns
    -------
    (n, 2) float64

    Raises
    ------
    CrazingError
        If the content is none of these or damaged; the message says where.

    Examples
    --------
    >>> from crazing.edit.exchange import load
    >>> load(b"0.1;2\n3;4").tolist()
    [[0.1, 2.0], [3.0, 4.0]]
    """
    head = content[:256].lstrip(b"\xef\xbb\xbf \t\r\n")
    if content.startswith(_NPY):
        return checked(_from_npy(content))
    text = table.decoded(content)
    if text is None:
        raise CrazingError("this is no CSV, NPY, GeoJSON or SVG file with points")
    if head.startswith(b"<"):
        return checked(_from_svg(text))
    return checked(_from_geojson(text) if head.startswith((b"{", b"[")) else table.points(text, MOST_POINTS))


def is_foreign_svg(content: bytes) -> bool:
    """Whether this is an SVG without points of ours: a drawing, whose contour can be traced."""
    head = content.lstrip(b"\xef\xbb\xbf \t\r\n")
    return head.startswith(b"<") and _DRAWING.search(head) is not None and _GROUP.encode() not in head


def is_geojson(content: bytes) -> bool:
    """Whether this begins as GeoJSON does."""
    return content[:256].lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")


def is_polygon(content: bytes) -> bool:
    """Whether this is GeoJSON with a polygon: a shape, whose outline can be sampled."""
    return is_geojson(content) and re.search(rb'"type"\s*:\s*"(Multi)?Polygon"', content) is not None


def is_picture(content: bytes) -> bool:
    """Whether this begins as a picture of pixels does."""
    return content.startswith(_PICTURES)


def _csv(points: Points) -> bytes:
    return "".join(["x,y\n", *(f"{x!r},{y!r}\n" for x, y in points.tolist())]).encode()


def _npy(points: Points) -> bytes:
    file = io.BytesIO()
    np.save(file, points, allow_pickle=False)
    return file.getvalue()


def _geojson(points: Points) -> bytes:
    geometry = {"type": "MultiPoint", "coordinates": points.tolist()}
    return json.dumps({"type": "Feature", "properties": {}, "geometry": geometry}, allow_nan=False).encode()


def _svg(points: Points) -> bytes:
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(2), np.ones(2))
    with np.errstate(over="ignore"):
        across = float((high - low).max()) or 1.0
    if not np.isfinite(across * 2):
        raise CrazingError("the points lie too far apart to be drawn as SVG; take another format")
    edge = across / 50
    box = low[0] - edge, -high[1] - edge, high[0] - low[0] + 2 * edge, high[1] - low[1] + 2 * edge
    # y points down in SVG; turning a sign loses nothing.
    circles = (f'<circle cx="{x!r}" cy="{-y!r}" r="{across / 200!r}"/>' for x, y in points.tolist())
    view = " ".join(repr(float(part)) for part in box)
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}">\n<g id="{_GROUP}">'
    return "\n".join([head, *circles, "</g>\n</svg>\n"]).encode()


_WRITERS: dict[str, Callable[[Points], bytes]] = {"csv": _csv, "npy": _npy, "svg": _svg, "geojson": _geojson}


def _from_npy(content: bytes) -> NDArray[Any]:
    try:
        file = io.BytesIO(content)
        version = np.lib.format.read_magic(file)
        if version not in ((1, 0), (2, 0)):
            raise ValueError(f"version {version} of the format is not read")
        header = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
        shape, _, dtype = header(file)
        # Before memory is taken: the header may promise more than the file holds.
        wanted = dtype.itemsize
        for side in shape:
            wanted *= side
        if dtype.hasobject:
            raise ValueError("it holds Python objects, which are not read")
        if wanted != len(content) - file.tell():
            raise ValueError("its header does not fit its content")
        file.seek(0)
        array: NDArray[Any] = np.load(file, allow_pickle=False)
    except (ValueError, OSError, EOFError, SyntaxError, TypeError, OverflowError) as error:
        raise CrazingError(f"the NPY file cannot be read: {error}") from None
    if {"x", "y"} <= set(array.dtype.names or ()):
        return np.column_stack([array["x"], array["y"]])
    return array


def _from_svg(text: str) -> list[tuple[float, float]]:
    # Entities are never needed here, and are how a small file becomes a large one.
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise CrazingError("the SVG has a document type; one without is wanted")
    try:
        groups = [group for group in ElementTree.fromstring(text).iter() if group.get("id") == _GROUP]
    except (ElementTree.ParseError, ValueError) as error:
        raise CrazingError(f"the SVG cannot be read: {error}") from None
    circles = [circle for group in groups for circle in group if circle.tag.endswith("circle")]
    try:
        return [(float(circle.get("cx", "")), -float(circle.get("cy", ""))) for circle in circles]
    except ValueError as error:
        raise CrazingError(f"a circle of the SVG has no position: {error}") from None


def _from_geojson(text: str) -> list[tuple[float, float]]:
    try:
        root = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise CrazingError(f"the GeoJSON cannot be read: {error}") from None
    try:
        return list(arguments.positions(root, "the GeoJSON"))
    except ValueError as error:
        raise CrazingError(str(error)) from None
