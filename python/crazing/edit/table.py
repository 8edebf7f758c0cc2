"""Tables of points in text: two columns, by name or the first ones, in the ways that people write numbers."""

from __future__ import annotations

import codecs
import re

from crazing.errors import CrazingError

#: Names of the columns of x and y, whatever their case.
NAMES = (("x", "y"), ("lon", "lat"), ("lng", "lat"), ("longitude", "latitude"), ("easting", "northing"))

_UTF16 = (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)
_PARTS = re.compile(r"[^\s,;]+")


def decoded(content: bytes) -> str | None:
    """The text of a file, as UTF-8 or marked as UTF-16; None if it is neither."""
    is_wide = content.startswith(_UTF16)
    try:
        text = content.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError:
        return None
    # Nearly any bytes are UTF-16, but hardly any of them have digits.
    return None if "\0" in text or (is_wide and not re.search("[0-9]", text)) else text


def points(text: str, most: int) -> list[tuple[float, float]]:
    r"""The points of a table, a line each.

    Columns are parted by semicolons, where numbers may have commas, or by tabs, commas or blanks. A first line of names
    says which are x and y; without such names they are the first two. Empty lines and those that begin with # are
    left out.

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
            x, y = (float(parts[column]) for column in columns)
        except (ValueError, IndexError):
            if not is_first or len(parts) < 2 or _is_number(parts[0]):
                raise CrazingError(f"line {row} is {line[:40]!r}; two numbers are wanted") from None
            columns = _columns(parts)
        else:
            found.append((x, y))
        is_first = False
    return found


def _parts(line: str) -> list[str]:
    if ";" in line:
        return [part.strip().replace(",", ".") for part in line.split(";")] if line.strip("; \t") else []
    if "\t" in line and "," not in line:
        return [part.strip() for part in line.split("\t")] if line.strip() else []
    return _PARTS.findall(line)


def _columns(names: list[str]) -> tuple[int, int]:
    plain = [name.strip("\"' ").lower() for name in names]
    for x, y in NAMES:
        if x in plain and y in plain:
            return plain.index(x), plain.index(y)
    return 0, 1


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
