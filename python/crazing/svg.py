"""Paths and basic shapes of an SVG picture, each where its transforms put it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, TypeAlias
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from crazing.extras import require
from crazing.svg_path import NUMBER, subpaths
from crazing.svg_shapes import SHAPES, Viewport, length, path_data

#: Three by three, of points as columns (x, y, 1).
Matrix: TypeAlias = NDArray[np.float64]

_HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
#: What holds other elements; a symbol is drawn by its copies alone.
_GROUPS = ("svg", "g", "a", "switch", "symbol")
#: Elements that are drawn: a file can ask for more than fit into any memory, by copies of copies.
_MOST = 100_000
_NO_PAINT = {"none", "transparent"}
#: Of the room that a view box leaves, how much is put before it.
_PARTS = {"Min": 0.0, "Mid": 0.5, "Max": 1.0}


@dataclass(frozen=True)
class _Seen:
    """What an element hands on to those in it of how they are drawn."""

    visibility: str = "visible"
    fill: str = "black"
    stroke: str = "none"

    def of(self, element: ElementTree.Element) -> _Seen:
        """That of an element in this one."""
        said = {name: _property(element, name) for name in ("visibility", "fill", "stroke")}
        return replace(self, **{name: value for name, value in said.items() if value not in ("", "inherit")})

    def is_drawn(self, *, has_sheet: bool) -> bool:
        """Whether there is anything to see; a style sheet may give paint where the elements name none."""
        return self.visibility == "visible" and (has_sheet or {self.fill, self.stroke} - _NO_PAINT != set())


@dataclass(frozen=True)
class _Place:
    """Where an element stands: its matrix, the size of the picture that it is in, and how it is seen.

    `size` is what a copy says of the picture or the symbol that it is of, NaN where it says nothing.
    """

    matrix: Matrix
    viewport: Viewport
    seen: _Seen
    size: tuple[float, float] = (np.nan, np.nan)


def shapes(text: str | bytes) -> Iterator[tuple[list[Any], bool, Matrix]]:
    """Every sub-path that a picture draws, whether it is closed, and the matrix that takes it to the picture's units.

    In the order of the file, as `crazing.svg_path.subpaths` gives them. Groups, copies (`use`) and inner pictures are
    followed; definitions and what is not displayed are left out.
    """
    root = ElementTree.fromstring(text)
    named = {element.get("id"): element for element in root.iter() if element.get("id")}
    # Depth first; nesting is the file's choice, so not by recursion.
    left: list[tuple[ElementTree.Element, _Place | None]] = [(root, None)]
    # Which rules are for which elements is not looked at.
    has_sheet = any(_kind(element) == "style" for element in root.iter())
    number = 0
    while left:
        element, outer = left.pop()
        number += 1
        if number > _MOST:
            raise ValueError(f"it draws more than {_MOST} elements")
        kind = _kind(element)
        place = _root(element) if outer is None else _placed(element, kind, outer)
        if place is None:
            continue
        if kind in SHAPES and place.seen.is_drawn(has_sheet=has_sheet):
            for segments, closed in subpaths(path_data(kind, element.attrib, place.viewport)):
                yield segments, closed, place.matrix
        elif kind == "use":
            left.append((_target(element, named), place))
        elif kind in _GROUPS:
            inner = replace(place, size=_Place.size)
            left.extend((child, inner) for child in reversed(element) if _kind(child) != "symbol")


def _kind(element: ElementTree.Element) -> str:
    """The name without its namespace. The tag of a comment is a function, whose name is none of interest."""
    return str(element.tag).rpartition("}")[2]


def _property(element: ElementTree.Element, name: str) -> str:
    """What the element itself says of it; its style goes before its attributes."""
    for part in element.get("style", "").split(";"):
        key, _, value = part.partition(":")
        if key.strip().lower() == name:
            return value.partition("!")[0].strip().lower()
    return element.get(name, "").strip().lower()


def _target(element: ElementTree.Element, named: dict[str | None, ElementTree.Element]) -> ElementTree.Element:
    wanted = next(filter(None, map(element.get, _HREFS)), "")
    if wanted[:1] != "#" or wanted[1:] not in named:
        raise ValueError(f"a copy is of {wanted!r}, which is not in the file")
    return named[wanted[1:]]


def _transform(element: ElementTree.Element) -> Matrix:
    library = require("svgpathtools", "svg")
    # Numbers need no gap between them in a file, but in the library.
    text = NUMBER.sub(r" \g<0> ", element.get("transform", ""))
    return np.asarray(library.parser.parse_transform(text, strict=True))


def _root(element: ElementTree.Element) -> _Place | None:
    """The picture itself, whose units are those of its own view box."""
    if _property(element, "display") == "none":
        return None
    box = _view_box(element)
    size = _size(element, None) if box is None else (box[2], box[3])
    return _Place(_transform(element), size if np.isfinite(size).all() else None, _Seen().of(element))


def _placed(element: ElementTree.Element, kind: str, outer: _Place) -> _Place | None:
    """Where an element is put by its transform, a copy or an inner picture by its x and y too; None where nowhere."""
    if _property(element, "display") == "none":
        return None
    matrix = outer.matrix @ _transform(element)
    place = replace(outer, matrix=matrix, seen=outer.seen.of(element))
    if kind not in ("use", "svg", "symbol"):
        return place
    x, y = (length(element.attrib, name, place.viewport) for name in ("x", "y"))
    place = replace(place, matrix=matrix @ _affine((1.0, 1.0), (x, y)))
    if kind == "use":
        return replace(place, size=_size(element, place.viewport))
    return _fitted(element, place)


def _size(element: ElementTree.Element, viewport: Viewport) -> tuple[float, float]:
    """Width and height, each NaN where it is not told, or is a part of what is not told."""
    width, height = (
        np.nan
        if viewport is None and element.get(name, "").strip().endswith("%")
        else length(element.attrib, name, viewport, np.nan)
        for name in ("width", "height")
    )
    return width, height


def _view_box(element: ElementTree.Element) -> tuple[float, float, float, float] | None:
    """x, y, width and height; None where there are no such four."""
    numbers = [float(number) for number in NUMBER.findall(element.get("viewBox", ""))]
    return (numbers[0], numbers[1], numbers[2], numbers[3]) if len(numbers) == 4 else None


def _affine(scale: tuple[float, float], shift: tuple[float, float]) -> Matrix:
    return np.array([[scale[0], 0, shift[0]], [0, scale[1], shift[1]], [0, 0, 1]])


def _fitted(element: ElementTree.Element, place: _Place) -> _Place | None:
    """The inside of an inner picture or a symbol: its view box fitted into its width and height."""
    whole = (np.nan, np.nan) if place.viewport is None else place.viewport
    # What the copy says goes first; where nothing is said it is as large as the picture about it.
    told = zip(place.size, _size(element, place.viewport), whole, strict=True)
    width, height = (next((side for side in sides if not np.isnan(side)), np.nan) for sides in told)
    box = _view_box(element)
    if width <= 0 or height <= 0 or (box is not None and not (box[2] > 0 and box[3] > 0)):
        return None
    is_told = not np.isnan((width, height)).any()
    if box is None:
        return replace(place, viewport=(width, height) if is_told else None)
    place = replace(place, viewport=(box[2], box[3]))
    if not is_told:
        return place
    words = element.get("preserveAspectRatio", "").split()
    across, up = width / box[2], height / box[3]
    if "none" not in words:
        across = up = max(across, up) if "slice" in words else min(across, up)
    # xMinYMid and so on: where the rest of the room goes. In the middle where nothing is said.
    align = next((word for word in words if word[:1] == "x" and len(word) == 8), "xMidYMid")
    parts = (_PARTS.get(align[1:4], 0.5), _PARTS.get(align[5:], 0.5))
    shift = (
        parts[0] * (width - across * box[2]) - across * box[0],
        parts[1] * (height - up * box[3]) - up * box[1],
    )
    return replace(place, matrix=place.matrix @ _affine((across, up), shift))
