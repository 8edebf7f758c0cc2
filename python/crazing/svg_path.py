"""Path data of SVG, read as its grammar has it: sub-path after sub-path."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

from crazing.extras import require

#: A number as SVG writes it: nothing need part it from one before it that cannot go on.
NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")

_FLAG = re.compile("[01]")
_GAP = re.compile(r"[\s,]*")
#: What each command takes: numbers, and flags of one digit.
_TAKES = {
    "M": "nn",
    "L": "nn",
    "H": "n",
    "V": "n",
    "C": "nnnnnn",
    "S": "nnnn",
    "Q": "nnnn",
    "T": "nn",
    "A": "nnnffnn",
    "Z": "",
}
_LETTERS = frozenset("".join(_TAKES) + "".join(_TAKES).lower())
#: The curves whose last control point a smooth one goes on from.
_SMOOTH = {"S": "CS", "T": "QT"}


def subpaths(text: str) -> Iterator[tuple[list[Any], bool]]:
    """The segments of each sub-path, as those of svgpathtools, and whether a Z closes it.

    The line that closes it is not among them. Sub-paths without a segment are left out, and arcs that end where they
    start, which are none.

    Examples
    --------
    >>> from crazing.svg_path import subpaths
    >>> [(len(segments), closed) for segments, closed in subpaths("m0 0 1-1.5.5.5z l3 4")]
    [(2, True), (1, False)]
    """
    start = here = handle = 0j
    before = ""
    segments: list[Any] = []
    for command, values in _commands(text):
        kind = command.upper()
        if kind in "MZ" and segments:
            yield segments, kind == "Z"
            segments = []
        origin = here if command.islower() else 0j
        if kind == "Z":
            end = start
        elif kind == "H":
            end = complex(origin.real + values[0], here.imag)
        elif kind == "V":
            end = complex(here.real, origin.imag + values[0])
        else:
            end = origin + complex(*values[-2:])
        if kind == "M":
            start = end
        elif kind in "CSQT":
            points = [origin + complex(x, y) for x, y in zip(values[:-2:2], values[1:-2:2], strict=True)]
            if kind in _SMOOTH:
                points.insert(0, 2 * here - handle if before and before in _SMOOTH[kind] else here)
            segments.append(_curve(here, points, end))
            handle = points[-1]
        elif kind != "Z" and (kind != "A" or here != end):
            segments.append(_straight_or_round(here, values, end))
        here, before = end, kind
    if segments:
        yield segments, False


def _curve(start: complex, handles: list[complex], end: complex) -> Any:
    library = require("svgpathtools", "svg")
    return (library.QuadraticBezier if len(handles) == 1 else library.CubicBezier)(start, *handles, end)


def _straight_or_round(start: complex, values: list[float], end: complex) -> Any:
    """A line, or an arc, of which one without a radius is a line."""
    library = require("svgpathtools", "svg")
    if len(values) < len(_TAKES["A"]) or not (values[0] and values[1]):
        return library.Line(start, end)
    radius = complex(abs(values[0]), abs(values[1]))
    return library.Arc(start, radius, values[2], bool(values[3]), bool(values[4]), end)


def _commands(text: str) -> Iterator[tuple[str, list[float]]]:
    """Every command with its numbers, those that are repeated without their letter too."""
    at = _next(text, 0)
    command = ""
    while at < len(text):
        letter = text[at]
        if letter in _LETTERS and (command or letter in "Mm"):
            command, at = letter, _next(text, at + 1)
        elif command in ("", "Z", "z"):
            raise _misplaced(text, at, "a command" if command else "M")
        values = []
        for kind in _TAKES[command.upper()]:
            token = (_FLAG if kind == "f" else NUMBER).match(text, at)
            if token is None:
                raise _misplaced(text, at, "0 or 1" if kind == "f" else "a number")
            values.append(float(token[0]))
            at = _next(text, token.end())
        yield command, values
        command = {"M": "L", "m": "l"}.get(command, command)


def _next(text: str, at: int) -> int:
    gap = _GAP.match(text, at)
    return at if gap is None else gap.end()


def _misplaced(text: str, at: int, wanted: str) -> ValueError:
    what = repr(text[at : at + 10]) if at < len(text) else "its end"
    return ValueError(f"path data has {what} at character {at}, where {wanted} is wanted")
