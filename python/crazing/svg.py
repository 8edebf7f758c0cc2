"""Paths and basic shapes of an SVG picture, each where its transforms put it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray

from crazing.extras import require

#: Three by three, of points as columns (x, y, 1).
Matrix: TypeAlias = NDArray[np.float64]

_HREFS = ("href", "{http://www.w3.org/1999/xlink}href")
#: What holds other elements; a symbol is drawn by its copies alone.
_GROUPS = ("svg", "g", "a", "switch", "symbol")
#: Elements that are drawn: a file can ask for more than fit into any memory, by copies of copies.
_MOST = 100_000


def shapes(text: str | bytes) -> Iterator[tuple[Any, Matrix]]:
    """Every path that a picture draws, as one of svgpathtools, and the matrix that takes it to the picture's units.

    In the order of the file. Groups, copies (`use`) and inner pictures are followed; definitions and what is not
    displayed are left out.
    """
    svgpathtools = require("svgpathtools", "svg")
    root = ElementTree.fromstring(text)
    named = {element.get("id"): element for element in root.iter() if element.get("id")}
    # Depth first; nesting is the file's choice, so not by recursion.
    left = [(root, np.eye(3), True)]
    seen = 0
    while left:
        element, outer, is_root = left.pop()
        seen += 1
        if seen > _MOST:
            raise ValueError(f"it draws more than {_MOST} elements")
        kind = _kind(element)
        if _is_hidden(element):
            continue
        own = svgpathtools.parser.parse_transform(element.get("transform", ""), strict=True)
        matrix = outer @ own @ (np.eye(3) if is_root else _placed(element, kind))
        if kind in svgpathtools.document.CONVERSIONS:
            path = svgpathtools.parse_path(svgpathtools.document.CONVERSIONS[kind](element))
            if len(path):
                yield path, matrix
        elif kind == "use":
            left.append((_target(element, named), matrix, False))
        elif kind in _GROUPS:
            left.extend((child, matrix, False) for child in reversed(element) if _kind(child) != "symbol")


def _kind(element: ElementTree.Element) -> str:
    """The name without its namespace. The tag of a comment is a function, whose name is none of interest."""
    return str(element.tag).rpartition("}")[2]


def _is_hidden(element: ElementTree.Element) -> bool:
    style = element.get("style", "").replace(" ", "")
    return element.get("display") == "none" or "display:none" in style


def _target(element: ElementTree.Element, named: dict[str | None, ElementTree.Element]) -> ElementTree.Element:
    wanted = next(filter(None, map(element.get, _HREFS)), "")
    if wanted[:1] != "#" or wanted[1:] not in named:
        raise ValueError(f"a copy is of {wanted!r}, which is not in the file")
    return named[wanted[1:]]


def _placed(element: ElementTree.Element, kind: str) -> Matrix:
    """Where a copy or an inner picture is put: moved by x and y, and a view box fitted into its width and height."""
    if kind not in ("use", "svg"):
        return np.eye(3)
    size = [float(element.get(name, 0)) for name in ("x", "y", "width", "height")]
    matrix = np.array([[1, 0, size[0]], [0, 1, size[1]], [0, 0, 1]])
    box = element.get("viewBox")
    if kind == "use" or box is None or not (size[2] > 0 and size[3] > 0):
        return matrix
    x, y, width, height = (float(number) for number in box.replace(",", " ").split())
    # As large as fits, in the middle: what an SVG does when it says nothing else.
    scale = min(size[2] / width, size[3] / height)
    shift = [(size[2] - scale * width) / 2 - scale * x, (size[3] - scale * height) / 2 - scale * y]
    return np.asarray(matrix @ [[scale, 0, shift[0]], [0, scale, shift[1]], [0, 0, 1]])
