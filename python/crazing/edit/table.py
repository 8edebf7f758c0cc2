"""Tables of points in text: two columns, by name or the first ones, in the ways that people write numbers."""

from __future__ import annotations

import codecs
import csv
import re

from crazing.errors import CrazingError

#: Names of the columns of x and y, whatever their case.
NAMES = (
    ("x", "y"),
    ("lon", "lat"),
    ("lng", "lat"),
    ("long", "lat"),
    ("longitude", "latitude"),
    ("easting", "northing"),
    # As ArcGIS and QGIS call them.
    ("point_x", "point_y"),
    ("xcoord", "ycoord"),
)

_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_QUOTED = re.compile('"[^"]*"')
#: What no text has, in any encoding of a byte a letter.
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1a\x1c-\x1f]")


def decoded(content: bytes) -> str | None:
    """The text of a file, as UTF-8, marked as UTF-16, or a byte a letter as old programs write it; None if no text."""
    is_wide = content.startswith(_UTF16)
    try:
        text = content.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError:
        # Names alone have other letters than ASCII, and only those of columns are looked at.
        return None if is_wide or _CONTROL.search(content) else content.decode("latin-1")
    # Nearly any bytes are UTF-16, but hardly any of them have digits.
    return None if "\0" in text or (is_wide and not re.search("[0-9]", text)) else text


def points(text: str, most: int) -> list[tuple[float, float]]:
    r"""The points of a table, a line each.

    Columns are parted by semicolons or tabs, where numbers may have commas, or by commas, or by blanks; what is in
    double quotes is one. A first line of names says which are x and y; without such names they are the first two.
    Empty lines and those that begin with # are left out.

    Examples
    --------
    >>> from crazing.edit.table import points
    >>> points("id,x,y\n7,0.5,2", 10)
    [(0.5, 2.0)]
    >>> points("0,5;2", 10)
    [(0.5, 2.0)]
    """
    found: list[tuple[float, float]] = []
    columns = (0, 1)
    is_first = True
    for row, line in enumerate(text.splitlines(), 1):
        parts = _parts(line)
        if not parts or parts[0].startswith("#"):
            continue
        if len(found) >= most:
            raise CrazingError(f"the file has more than {most} points")
        try:
            x, y = (_number(parts[column]) for column in columns)
        except (ValueError, IndexError):
            if not is_first or len(parts) < 2 or any(map(_is_number, parts[:2])):
                raise CrazingError(f"line {row} is {line[:40]!r}; two numbers are wanted") from None
            columns = _columns(parts)
        else:
            found.append((x, y))
        is_first = False
    return found


def _parts(line: str) -> list[str]:
    """The columns of a line, those with nothing in them too; none of a line that has nothing at all."""
    if not line.strip(",; \t"):
        return []
    bare = _QUOTED.sub("", line) if '"' in line else line
    mark = next((mark for mark in ";\t," if mark in bare), None)
    parts = line.split(mark) if bare is line else _unquoted(line.strip(), mark or " ")
    if mark == ",":
        return [part.strip() for part in parts]
    return [part.strip(" \t,").replace(",", ".") for part in parts]


def _unquoted(line: str, mark: str) -> list[str]:
    try:
        return next(csv.reader([line], delimiter=mark, skipinitialspace=True))
    except csv.Error:  # A column of more than a hundred thousand letters is none of numbers.
        return [line]


def _columns(names: list[str]) -> tuple[int, int]:
    plain = [name.strip("\"' ").lower() for name in names]
    for x, y in NAMES:
        if x in plain and y in plain:
            return plain.index(x), plain.index(y)
    return 0, 1


def _number(text: str) -> float:
    # Python takes 1_0 for 10; in a table it is a name.
    if "_" in text:
        raise ValueError(text)
    return float(text)


def _is_number(text: str) -> bool:
    try:
        _number(text)
    except ValueError:
        return False
    return True
