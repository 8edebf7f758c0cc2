"""Polygons with holes, from whatever describes some: one reader for all that take them."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.arguments import found, points_array

#: A ring of corners, (k, 2); the first may be repeated at the end.
Ring = NDArray[np.float64]

#: Where the members of a collection stand, in GeoJSON.
_COLLECTIONS = {"FeatureCollection": "features", "GeometryCollection": "geometries"}

#: What a string that names a file ends in.
_ENDINGS = (".geojson", ".json")

WANTED = "Polygon, MultiPolygon, or a Feature or collection of them"


def polygons(shape: Any, name: str) -> list[list[Ring]]:
    """The polygons that `shape` describes, each a shell and its holes.

    An object with `__geo_interface__` (of shapely, of GeoPandas) or a GeoJSON mapping, or a list of such; a ring; a
    shell and a list of its holes; or a list of rings, which become a polygon each: what is inside follows from the
    number of rings around it; or the name of a GeoJSON file. Heights, features without a geometry, and points and lines
    beside the polygons of a GeometryCollection are left out.

    Examples
    --------
    >>> from crazing.polygons import polygons
    >>> [[len(ring) for ring in polygon] for polygon in polygons({"type": "MultiPolygon", "coordinates": []}, "shape")]
    []
    >>> len(polygons([(0, 0), (4, 0), (4, 4)], "shape")[0][0])
    3
    """
    if isinstance(shape, os.PathLike) or (isinstance(shape, str) and shape.lower().endswith(_ENDINGS)):
        shape = geojson(shape)
    if isinstance(shape, np.ndarray) and shape.dtype.kind == "O" and not shape.ndim:
        shape = shape.item()  # As NumPy wraps a single object.
    if _is_geometry(shape):
        return list(_of_geometry(shape, name))
    is_row = isinstance(shape, Sequence) and not isinstance(shape, (str, bytes, memoryview))
    if not is_row and not np.ndim(shape if hasattr(shape, "__array__") else 0):
        raise TypeError(f"{name} is {found(shape)}; a polygon, a ring or a list of them is wanted")
    if not is_row:
        shape = np.asarray(shape)
    if not (is_row or shape.dtype.kind == "O") or not len(shape):
        return [[points_array(shape, name)]]
    if _is_geometry(shape[0]):
        return [polygon for row, part in enumerate(shape) for polygon in _of_member(part, f"{name}[{row}]")]
    if len(shape) == 2 and _is_row_of_rings(shape[1]):
        return [[points_array(shape[0], "shell"), *(points_array(h, f"holes[{i}]") for i, h in enumerate(shape[1]))]]
    if _depth(shape[0]) == 2:
        return [[points_array(ring, f"{name}[{row}]")] for row, ring in enumerate(shape)]
    return [[points_array(shape, name)]]


def geojson(path: str | os.PathLike[str]) -> Any:
    """What a GeoJSON file holds; of a collection with one feature, that."""
    return parsed(Path(path).read_text(encoding="utf-8-sig"), path)


def parsed(text: str, path: str | os.PathLike[str]) -> Any:
    """What the text of a GeoJSON file holds; `path` names it in messages."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise ValueError(f"{os.fspath(path)!r} is no GeoJSON: {error}") from None
    if isinstance(found, dict) and found.get("type") == "FeatureCollection" and len(found.get("features", ())) == 1:
        return found["features"][0]
    return found


def _is_geometry(value: Any) -> bool:
    # By the class where that tells: asking a shape of shapely itself makes a Python object of every coordinate.
    named = "__geo_interface__"
    return isinstance(value, Mapping) or hasattr(type(value), named) or hasattr(value, named)


def _depth(value: Any) -> int:
    """How many brackets deep a number stands, by the first ones."""
    deep = 0
    while isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (str, bytes)) and deep < 4:
        if isinstance(value, np.ndarray):
            return deep + value.ndim
        deep, value = deep + 1, value[0] if len(value) else None
    return deep


def _is_row_of_rings(value: Any) -> bool:
    """Whether this is a list of holes; one of no hole is empty."""
    return isinstance(value, (Sequence, np.ndarray)) and (len(value) == 0 or _depth(value) == 3)


def _of_member(part: Any, name: str) -> Iterator[list[Ring]]:
    if not _is_geometry(part):
        raise TypeError(f"{name} is {found(part)}; a polygon as those before it is wanted")
    return _of_geometry(part, name)


def _of_geometry(shape: Any, name: str) -> Iterator[list[Ring]]:
    """Polygon after polygon, without recursion: nesting is the file's choice."""
    left = [shape]
    while left:
        last = left.pop()
        if _is_of_shapely(last):
            yield from _of_shapely(last)
            continue
        node = getattr(last, "__geo_interface__", last)
        if node is None:  # A feature without a geometry.
            continue
        kind = node.get("type") if isinstance(node, Mapping) else None
        if kind == "Feature":
            left.append(node.get("geometry"))
        elif isinstance(kind, str) and kind in _COLLECTIONS:
            members = _members(node, _COLLECTIONS[kind], name)
            # Where a polygon is mended, lines and points without an area come along.
            left.extend(part for part in reversed(members) if kind == "FeatureCollection" or not _is_flat(part))
        elif kind == "MultiPolygon":
            for row, rings in enumerate(_members(node, "coordinates", name)):
                if not isinstance(rings, (Sequence, np.ndarray)) or isinstance(rings, str):
                    raise ValueError(f"polygon {row} of {name} is {found(rings)}; a list of rings is wanted")
                if len(rings):
                    yield [*_rings(rings, name)]
        elif kind in ("Polygon", "LinearRing"):
            rings = _members(node, "coordinates", name)
            if len(rings):
                yield [*_rings([rings] if kind == "LinearRing" else rings, name)]
        else:
            raise ValueError(f"{name} is a geometry of type {found(kind)}; {WANTED} is wanted")


def _is_flat(shape: Any) -> bool:
    node = getattr(shape, "__geo_interface__", shape)
    return isinstance(node, Mapping) and str(node.get("type")).removeprefix("Multi") in ("Point", "LineString")


def _is_of_shapely(shape: Any) -> bool:
    kind = getattr(shape, "geom_type", None)
    return isinstance(kind, str) and kind in ("Polygon", "MultiPolygon") and hasattr(shape, "is_empty")


def _of_shapely(shape: Any) -> Iterator[list[Ring]]:
    """As its mapping says, without a Python object for every coordinate: a tenth of the time."""
    for part in getattr(shape, "geoms", [shape]):
        if not part.is_empty:
            yield [np.array(ring.coords)[:, :2] for ring in (part.exterior, *part.interiors)]


def _members(node: Mapping[str, Any], word: str, name: str) -> list[Any]:
    members = node.get(word)
    if not isinstance(members, (Sequence, np.ndarray)) or isinstance(members, (str, bytes)):
        raise ValueError(f"{name} is a {node['type']} whose {word} are {found(members)}; a list is wanted")
    return list(members)


def _rings(rings: Any, name: str) -> Iterator[Ring]:
    for row, ring in enumerate(rings):
        try:
            # A third coordinate is a height.
            places = [point[:2] for point in ring]
        except (TypeError, IndexError, KeyError):
            raise ValueError(f"ring {row} of {name} is {found(ring)}; a list of positions is wanted") from None
        yield points_array(places, f"ring {row} of {name}")
