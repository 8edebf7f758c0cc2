"""What the basic shapes of SVG draw, as path data, and its lengths as numbers."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from typing import TypeAlias

from crazing.arguments import found
from crazing.svg_path import NUMBER

#: Width and height of the picture that a percentage is of; None where the file does not tell.
Viewport: TypeAlias = tuple[float, float] | None

#: Units of a picture in one of each, CSS Values 3, section 6.2.
_UNITS = {"": 1.0, "px": 1.0, "in": 96.0, "cm": 96 / 2.54, "mm": 96 / 25.4, "q": 96 / 101.6, "pt": 96 / 72, "pc": 16.0}

SHAPES = ("path", "rect", "circle", "ellipse", "line", "polyline", "polygon")


def length(attributes: Mapping[str, str], name: str, viewport: Viewport, missing: float = 0.0) -> float:
    """The length of an attribute in units of the picture; `missing` where there is none, or it is auto."""
    text = attributes.get(name, "auto").strip()
    if text == "auto":
        return missing
    number = NUMBER.match(text)
    unit = "" if number is None else text[number.end() :].lower()
    if number is None or (unit != "%" and unit not in _UNITS):
        wanted = ", ".join(filter(None, _UNITS))
        raise ValueError(f"{name} is {found(text)}; a number, alone or in {wanted} or %, is wanted")
    if unit != "%":
        return float(number[0]) * _UNITS[unit]
    if viewport is None:
        raise ValueError(f"{name} is {found(text)} of a picture whose size is not told")
    return float(number[0]) / 100 * _whole(name, *viewport)


def _whole(name: str, width: float, height: float) -> float:
    """What 100% of an attribute is."""
    if name in ("x", "width", "cx", "rx", "x1", "x2"):
        return width
    return math.hypot(width, height) / math.sqrt(2) if name == "r" else height


def path_data(kind: str, attributes: Mapping[str, str], viewport: Viewport) -> str:
    """The path data of a shape; empty where it draws nothing."""
    if kind == "path":
        data = attributes.get("d", "").strip()
        return "" if data == "none" else data
    if kind in ("polyline", "polygon"):
        return _points(attributes.get("points", ""), is_closed=kind == "polygon")

    def of(name: str, missing: float = 0.0) -> float:
        return length(attributes, name, viewport, missing)

    if kind == "line":
        return f"M{of('x1')!r} {of('y1')!r}L{of('x2')!r} {of('y2')!r}"
    if kind == "rect":
        # A radius that is not given is the other.
        radii = of("rx", of("ry")), of("ry", of("rx"))
        return _rect(of("x"), of("y"), of("width"), of("height"), *radii)
    radii = (of("r"), of("r")) if kind == "circle" else (of("rx", of("ry")), of("ry", of("rx")))
    return _ellipse(of("cx"), of("cy"), *radii)


def _points(text: str, *, is_closed: bool) -> str:
    numbers = NUMBER.findall(text)
    rest = re.sub(r"[\s,]", "", NUMBER.sub("", text))
    if rest or len(numbers) % 2:
        raise ValueError(f"points is {found(text)}; pairs of numbers are wanted")
    return f"M{' '.join(numbers)}{'Z' if is_closed else ''}" if numbers else ""


def _rect(x: float, y: float, width: float, height: float, rx: float, ry: float) -> str:
    if not (width > 0 and height > 0):
        return ""
    right, low = x + width, y + height
    if not (rx > 0 and ry > 0):
        return f"M{x!r} {y!r}L{right!r} {y!r}L{right!r} {low!r}L{x!r} {low!r}Z"
    # At most half of the side, so that an ever so large one makes a pill.
    rx, ry = min(rx, width / 2), min(ry, height / 2)
    arc = f"A{rx!r} {ry!r} 0 0 1"
    return (
        f"M{x + rx!r} {y!r}L{right - rx!r} {y!r}{arc} {right!r} {y + ry!r}L{right!r} {low - ry!r}"
        f"{arc} {right - rx!r} {low!r}L{x + rx!r} {low!r}{arc} {x!r} {low - ry!r}L{x!r} {y + ry!r}"
        f"{arc} {x + rx!r} {y!r}Z"
    )


def _ellipse(cx: float, cy: float, rx: float, ry: float) -> str:
    if not (rx > 0 and ry > 0):
        return ""
    half = f"a{rx!r} {ry!r} 0 1 0"
    return f"M{cx - rx!r} {cy!r}{half} {2 * rx!r} 0{half} {-2 * rx!r} 0Z"
