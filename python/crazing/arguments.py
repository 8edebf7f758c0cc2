"""The only place that judges the shape, type and range of arguments: what was found, what is wanted."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterable, Iterator, Mapping, Sequence, Sized
from itertools import islice
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing.errors import CrazingError

# Rows are numbered with 32-bit integers.
_INDEX_LIMIT = 2**31 - 1
# What of GeoJSON leads to positions.
_GEOJSON = ("features", "geometry", "geometries", "coordinates")


_Kind = TypeVar("_Kind")


def found(value: Any) -> str:
    """`value` as a message shows it: in a few words."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def _real(value: Any, prefix: str) -> float:
    """`value` as a float; `prefix` begins the message of the refusal."""
    # Of a row of one number, NumPy and pandas make a float with a warning, or none.
    if isinstance(value, (str, bytes, complex)) or getattr(value, "ndim", None):
        raise TypeError(f"{prefix} {found(value)}; a real number is wanted")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{prefix} {found(value)}; a real number is wanted") from None
    except OverflowError:
        raise ValueError(f"{prefix} an integer too large for a float") from None


def points_array(points: Any, name: str = "points") -> NDArray[np.float64]:
    """`points` as a C-contiguous (n, 2) float64 array in native byte order; an empty list gives (0, 2).

    Of what has a `__geo_interface__`, of a list or an array of such, and of GeoJSON, all positions without their
    heights, in their order; of a diagram, its sites.
    """
    sites = getattr(points, "sites", None)
    points = sites if isinstance(sites, np.ndarray) else points
    if hasattr(type(points), "__array__") and not isinstance(points, np.ndarray) and not _is_shape(points):
        # A column of geometries is an array in its own right.
        points = regular(points, name)
    if _is_shape(points) or _is_shape(_first(points)):
        points = list(positions(points, name))
    array = real_array(points, name)
    if array.size == 0 and array.ndim <= 2:
        return np.empty((0, 2))
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name} has shape {array.shape}; (n, 2) is wanted")
    return array


def _is_shape(value: Any) -> bool:
    """Whether this is GeoJSON, or has one."""
    if isinstance(value, Mapping):
        return any(word in value for word in _GEOJSON)
    return isinstance(getattr(value, "__geo_interface__", None), Mapping)


def _first(value: Any) -> Any:
    """The first of objects that may come one after the other; None if there is none."""
    is_row = isinstance(value, (list, tuple)) or (
        isinstance(value, np.ndarray) and value.dtype == object and value.ndim
    )
    return value[0] if is_row and len(value) else None


def positions(root: Any, name: str) -> Iterator[tuple[float, float]]:
    """Every position of a GeoJSON object, in its order, without recursion: nesting is the file's choice."""
    left = [root]
    while left:
        node = left.pop()
        node = getattr(node, "__geo_interface__", node)
        if isinstance(node, Mapping):
            inner = [node.get(word) for word in _GEOJSON]
            left.extend(reversed([part for part in inner if part is not None]))
        elif isinstance(node, (list, tuple)) and len(node) >= 2 and all(map(_is_number, node)):
            yield number(node[0], "a coordinate"), number(node[1], "a coordinate")
        elif isinstance(node, (list, tuple, np.ndarray)):
            left.extend(reversed(node))
        else:
            raise ValueError(f"{name} holds {found(node)} where positions are wanted")


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.integer, np.floating)) and not isinstance(value, bool)


def real_array(values: ArrayLike, name: str) -> NDArray[np.float64]:
    """`values` as a C-contiguous, aligned float64 array; complex numbers, text and objects are refused."""
    array = regular(values, name)
    if array.ndim and len(array) > _INDEX_LIMIT:
        raise ValueError(f"{name} has {len(array)} rows; at most {_INDEX_LIMIT} are supported")
    if array.dtype.kind == "O":
        # One by one: NumPy's own cast reads None as nan and text as what it says.
        array = np.array([_real(value, f"{name} holds") for value in array.flat]).reshape(array.shape)
    if array.dtype.kind not in "biuf":
        raise TypeError(f"{name} has dtype {array.dtype}; real numbers are wanted")
    # A long double beyond float64 becomes infinite, which the core then names with its row.
    with np.errstate(over="ignore"):
        return np.require(array, np.float64, ["C", "A"])


def count(value: Any, name: str, *, low: int = 0, high: int = _INDEX_LIMIT) -> int:
    """`value` as an int in [low, high]; bools and fractions are refused."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}; an integer is wanted")
    try:
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {found(value)}; an integer is wanted") from None
    if not low <= number <= high:
        raise ValueError(f"{name} is {number}; it must be from {low} to {high}")
    return number


def number(value: Any, name: str, *, low: float = -np.inf, high: float = np.inf) -> float:
    """`value` as a finite float in [low, high]."""
    if isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{name} is {value!r}; a real number is wanted")
    result = _real(value, f"{name} is")
    if not np.isfinite(result) or not low <= result <= high:
        raise ValueError(f"{name} is {result}; a finite number{_range(low, high)} is wanted")
    return result


def _range(low: float, high: float) -> str:
    if np.isinf(high):
        return "" if np.isinf(low) else f" of at least {low:g}"
    return f" from {low} to {high}"


def choice(value: Any, name: str, allowed: Iterable[str]) -> str:
    """`value`, if it is one of the allowed words."""
    words = list(allowed)
    # An array would be compared entry by entry.
    if not isinstance(value, str) or value not in words:
        listed = ", ".join(map(repr, words))
        raise ValueError(f"{name} is {found(value)}{meant(value, words)}; one of {listed} is wanted")
    return str(value)


def meant(value: Any, allowed: Iterable[str]) -> str:
    """What a misspelt word may have been, as a question in brackets; nothing where no word is near."""
    import difflib

    words = list(allowed)
    if not isinstance(value, str) or not value:
        return ""
    known = {word.lower(): word for word in words}
    near = [known[word] for word in difflib.get_close_matches(value.lower(), known, n=2, cutoff=0.7)]
    # A part of a name, as in a family of names.
    near += [word for word in words if len(value) > 2 and value.lower() in word.lower() and word not in near]
    return f" (did you mean {' or '.join(map(repr, near[:3]))}?)" if near else ""


def of_kind(value: Any, name: str, kind: type[_Kind]) -> _Kind:
    """`value`, if it is of that class."""
    if not isinstance(value, kind):
        raise TypeError(f"{name} is {found(value)}; a {kind.__name__} is wanted")
    return value


def file_path(value: Any, name: str = "path") -> str | os.PathLike[str]:
    """`value`, if it names a file."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{name} is {found(value)}; the name of a file is wanted")
    return value


def regular(values: Any, name: str) -> NDArray[Any]:
    """`values` as an array, whatever of."""
    if isinstance(values, np.ma.MaskedArray) and np.ma.is_masked(values):
        # What lies under a mask is not meant to be seen, and NumPy would hand it on without a word.
        raise ValueError(f"{name} has masked entries; drop or fill them")
    try:
        return np.asarray(values)
    except ValueError:
        raise ValueError(f"{name} is ragged; rows of one length are wanted") from None


def cast(value: Any, name: str, dtype: Any) -> NDArray[Any]:
    """`value` as a C-contiguous array of a type that holds all its entries; anything else is refused."""
    wanted = np.dtype(dtype)
    array = regular(value, name)
    if isinstance(value, np.ndarray) and array.dtype == wanted:
        return np.ascontiguousarray(array)
    if array.size == 0:
        return np.empty(array.shape, wanted)
    if array.dtype.kind not in {"b": "b", "i": "iu"}.get(wanted.kind, "iuf"):
        raise TypeError(f"{name} is {found(value)}; an array of {wanted} is wanted")
    if wanted.kind == "i" and not np.iinfo(wanted).min <= int(array.min()) <= int(array.max()) <= np.iinfo(wanted).max:
        raise ValueError(f"{name} is {found(value)}; entries that {wanted} holds are wanted")
    return np.ascontiguousarray(array, dtype=wanted)


def shaped(value: Any, name: str, dtype: Any, shape: tuple[int, ...]) -> NDArray[Any]:
    """`value` as `cast` gives it, of that shape; a single number stands for all entries and takes no memory."""
    array = cast(value, name, dtype).reshape(np.shape(value))
    if array.shape not in ((), shape):
        raise ValueError(f"{name} has shape {array.shape}; {shape} is wanted")
    return np.broadcast_to(array, shape)


def filled(value: Any, name: str, dtype: Any, shape: tuple[int, ...]) -> NDArray[Any]:
    """`value`, if it is an array of just that type and shape that can be written to from its first to its last byte."""
    if not isinstance(value, np.ndarray):
        raise TypeError(f"{name} is {found(value)}; an array that is to be filled is wanted")
    if value.dtype != dtype or value.shape != shape:
        wanted = f"{np.dtype(dtype)} and {shape}"
        raise ValueError(f"{name} is of {value.dtype} and shape {value.shape}; {wanted} are wanted")
    if not (value.flags.c_contiguous and value.flags.aligned and value.flags.writeable):
        raise ValueError(f"{name} is read-only or in pieces; a writeable C-contiguous array is wanted")
    return value


def apart(arrays: Mapping[str, NDArray[Any]], others: Iterable[NDArray[Any]]) -> None:
    """Refuses contiguous arrays that share memory among them or with others."""
    taken = [("what is drawn", other) for other in others]
    for name, array in arrays.items():
        for before, other in taken:
            if np.may_share_memory(array, other):
                raise ValueError(f"{name} shares memory with {before}; arrays of their own are wanted")
        taken.append((name, array))


def entries(value: Any, name: str, wanted: int, words: str) -> tuple[Any, ...]:
    """The entries of a short sequence."""
    if not np.iterable(value):
        raise TypeError(f"{name} is {found(value)}; {words} is wanted")
    # No more are looked at: what is given may be without end.
    parts = tuple(islice(value, wanted + 1))
    if len(parts) != wanted:
        number = len(value) if isinstance(value, Sized) else len(parts)
        raise ValueError(f"{name} has {number} entries; {words} is wanted")
    return parts


def bounds_tuple(value: Any, name: str = "bounds") -> tuple[float, float, float, float]:
    """`value` as (xmin, ymin, xmax, ymax) with a positive, finite width and height."""
    parts = entries(value, name, 4, "(xmin, ymin, xmax, ymax)")
    xmin, ymin, xmax, ymax = (number(part, f"{name}[{i}]") for i, part in enumerate(parts))
    if not (xmin < xmax and ymin < ymax):
        raise ValueError(f"{name} is {(xmin, ymin, xmax, ymax)}; xmin < xmax and ymin < ymax are wanted")
    if not (np.isfinite(xmax - xmin) and np.isfinite(ymax - ymin)):
        raise ValueError(f"{name} is {(xmin, ymin, xmax, ymax)}; a width and height that are floats are wanted")
    return xmin, ymin, xmax, ymax


_Box = TypeVar("_Box", bound=tuple[float, ...])


def areal(box: _Box, name: str = "bounds", *, largest: float = 1e60, why: str = "areas are squared") -> _Box:
    """Bounds, or a period, in which the squares of areas are floats."""
    xmin, ymin, xmax, ymax = box if len(box) == 4 else (0.0, 0.0, *box)
    sides = xmax - xmin, ymax - ymin
    if not (max(*map(abs, box), *sides) <= largest and min(sides) >= 1 / largest):
        wanted = f"at most {largest:g} and sides of at least {1 / largest:g} are wanted"
        raise CrazingError(f"{name} is {box}; coordinates of {wanted}: {why}")
    return box


def period_pair(value: Any, name: str = "period") -> tuple[float, float]:
    """`value` as (width, height), both positive and finite."""
    parts = entries(value, name, 2, "(width, height)")
    width, height = (number(part, f"{name}[{i}]", low=0) for i, part in enumerate(parts))
    if not (width > 0 and height > 0):
        raise ValueError(f"{name} is {(width, height)}; a positive width and height are wanted")
    return width, height


def size_pair(value: Any, name: str = "size", *, limit: int = 1 << 16) -> tuple[int, int]:
    """`value` as (height, width) in pixels; one integer means a square."""
    parts = entries(value, name, 2, "(height, width) or one integer") if np.iterable(value) else (value, value)
    height, width = (count(part, name, low=1, high=limit) for part in parts)
    return height, width


def thread_count(value: Any, name: str = "threads") -> int:
    """`value` as a number of threads; None means all cores, given to the core as 0."""
    return 0 if value is None else count(value, name, low=1, high=1024)


def index_pairs(values: ArrayLike, name: str, *, limit: int) -> NDArray[np.int32]:
    """`values` as a C-contiguous (n, 2) int32 array of indices below `limit`; an empty list gives (0, 2)."""
    array = regular(values, name)
    if array.size == 0 and array.ndim <= 2:
        return np.empty((0, 2), dtype=np.int32)
    if array.dtype.kind not in "iu":
        raise TypeError(f"{name} has dtype {array.dtype}; integers are wanted")
    if array.ndim != 2 or array.shape[1] != 2:
        raise ValueError(f"{name} has shape {array.shape}; (n, 2) is wanted")
    if array.itemsize < 4:
        array = array.astype(np.int32)
    # As unsigned numbers negative ones are beyond any limit: one look is enough.
    if int(array.view(array.dtype.str.replace("i", "u")).max()) >= limit:
        row = int(np.argmax(((array < 0) | (array >= limit)).any(axis=1)))
        pair = tuple(array[row].tolist())
        raise ValueError(f"{name}[{row}] is {pair}; indices from 0 to less than {limit} are wanted")
    return np.ascontiguousarray(array, dtype=np.int32)


def index_chains(values: Any, name: str, *, limit: int) -> NDArray[np.int32]:
    """`values` as an (n, 2) int32 array of indices below `limit`: as it is, or neighbours in its chains."""
    try:
        array = np.asarray(values)
    except ValueError:
        array = None
    if array is not None and (
        array.size == 0 or (array.ndim == 2 and array.shape[1] == 2) or array.dtype.kind not in "iuO"
    ):
        return index_pairs(values, name, limit=limit)
    if not isinstance(values, (Sequence, np.ndarray)) or _dimensions(values[0]) != 1:
        raise ValueError(f"{name} is {found(values)}; pairs of indices, or chains of them, are wanted")
    chains = []
    for number, chain in enumerate(values):
        if _dimensions(chain) != 1:
            raise ValueError(f"{name}[{number}] is {found(chain)}; a chain of indices is wanted")
        row = np.asarray(chain)
        chains.append(index_pairs(np.column_stack([row[:-1], row[1:]]), f"{name}[{number}]", limit=limit))
    return np.concatenate(chains)


def _dimensions(value: Any) -> int:
    """Of an array-like; -1 where it is ragged."""
    try:
        return np.ndim(value)
    except ValueError:
        return -1


def cell_row(values: ArrayLike, name: str, cells: int) -> NDArray[np.int32]:
    """`values` as a (k,) int32 array of cells below `cells`."""
    array = np.asarray(values) if _dimensions(values) == 1 else None
    if array is None or (array.size and array.dtype.kind not in "iu"):
        raise TypeError(f"{name} is {found(values)}; a row of cells is wanted")
    if array.size and not (array.min() >= 0 and array.max() < cells):
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"{name} goes by cell {wrong}; 0 to {cells - 1} are wanted")
    return np.ascontiguousarray(array, dtype=np.int32)
