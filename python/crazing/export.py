"""Drawings as files: SVG for the eye and the plotter, GeoJSON for maps, DXF for machines."""

from __future__ import annotations

import io
import json
import os
from collections.abc import Callable, Iterator
from itertools import pairwise
from pathlib import PurePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments, files
from crazing.extras import require

if TYPE_CHECKING:
    from crazing.graph import PlanarGraph

# Control characters, lone surrogates and two more that XML 1.0 has no way to write (section 2.2).
_NOT_XML = {code: "\ufffd" for code in (*range(32), *range(0xD800, 0xE000), 0xFFFE, 0xFFFF) if code not in (9, 10, 13)}

#: Half the side of the largest drawing: the box around it and its margin must be floats too.
_FARTHEST = 1e300
#: Times its size: a drawing that lies farther from the origin is moved there in SVG, since browsers and other programs
#: calculate with the 24 bits of single precision.
_AWAY = 64


def save(graph: PlanarGraph, path: str | os.PathLike[str]) -> None:
    """Writes `graph` in the format that the ending of `path` names; see `PlanarGraph.save`."""
    ending = PurePath(arguments.file_path(path)).suffix.lower()
    if ending not in _WRITERS:
        raise ValueError(f"path is {os.fspath(path)!r}; an ending of {', '.join(_WRITERS)} is wanted")
    content = _WRITERS[ending](graph)
    with files.atomic_write(path) as file:
        file.write(content)


def svg(graph: PlanarGraph, *, title: str | None = None, stroke: str = "black", width: float | None = None) -> str:
    """The polylines as an SVG picture; see `PlanarGraph.to_svg`."""
    for name, text in (("title", "" if title is None else title), ("stroke", stroke)):
        if not isinstance(text, str):
            raise TypeError(f"{name} is {arguments.found(text)}; a string is wanted")
    left, low, right, high = _extent(graph)
    across = max(right - left, high - low) or 1.0
    width = across / 500 if width is None else arguments.number(width, "width", low=0.0)
    # The margin keeps line ends inside, and a box without height, which would show nothing, from being one.
    margin = max(width, across / 1000)
    box = (left - margin, -high - margin, right - left + 2 * margin, high - low + 2 * margin)
    style = f'fill="none" stroke={_attribute(stroke)} stroke-width="{width!r}"'
    start = svg_start((left, low, right, high))
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{" ".join(map(repr, box))}">',
            *([] if title is None else [f"<title>{_content(title)}</title>"]),
            f"<metadata>{_maker()}</metadata>",
            f'<path {style} stroke-linecap="round" stroke-linejoin="round"{svg_moved(start)}',
            f'd="{_path(graph, start)}"/>',
            "</svg>",
        ]
    )


def geojson(graph: PlanarGraph) -> str:
    """One GeoJSON feature; its coordinates are those of the data, which need not be degrees."""
    _extent(graph)
    properties = json.dumps({"maker": _maker(), "edges": len(graph.edges), "length": graph.length}, allow_nan=False)
    # Not by the encoder, which answers nothing until it is done, Ctrl-C neither.
    lines = ", ".join(f"[{line}]" for line in _texts(graph, lambda x, y: f"[{x!r}, {y!r}]", ", "))
    geometry = f'{{"type": "MultiLineString", "coordinates": [{lines}]}}'
    return f'{{"type": "Feature", "properties": {properties}, "geometry": {geometry}}}'


def dxf(graph: PlanarGraph) -> str:
    """One LWPOLYLINE a line in the model space of a DXF R2010 drawing, closed for rings."""
    ezdxf = require("ezdxf", "cad")
    left, low, right, high = _extent(graph)
    drawing = ezdxf.new("R2010", units=0)
    space = drawing.modelspace()
    for line in _lines(graph):
        # A ring of fewer than three distinct points encloses nothing: it is drawn there and back.
        ring = len(line) > 3 and bool((line[0] == line[-1]).all())
        space.add_lwpolyline(line[:-1].tolist() if ring else line.tolist(), close=ring)
    # Programs open the file with the drawing in view.
    drawing.set_modelspace_vport(height=(high - low) or 1.0, center=((left + right) / 2, (low + high) / 2))
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


_WRITERS = {
    ".svg": lambda graph: svg(graph).encode(),
    ".geojson": lambda graph: geojson(graph).encode(),
    # DXF is UTF-8 from R2007 on.
    ".dxf": lambda graph: dxf(graph).encode(),
}


def _maker() -> str:
    return f"crazing {_core.__version__}"


# These bring urllib and http with them, so that they are imported where they are used.
def _attribute(text: str) -> str:
    from xml.sax.saxutils import quoteattr

    return quoteattr(text.translate(_NOT_XML))


def _content(text: str) -> str:
    from xml.sax.saxutils import escape

    return escape(text.translate(_NOT_XML))


def _lines(graph: PlanarGraph) -> list[NDArray[np.float64]]:
    coords, offsets = graph.polylines()
    return np.split(coords, offsets[1:-1]) if len(offsets) > 1 else []


def _extent(graph: PlanarGraph) -> tuple[float, float, float, float]:
    """Box around the edges: (xmin, ymin, xmax, ymax); of no edges, an empty box at the origin."""
    if not len(graph.edges):
        return 0.0, 0.0, 0.0, 0.0
    used = np.unique(graph.edges)
    points = graph.vertices[used]
    bad = ~np.isfinite(points).all(axis=1)
    if bad.any():
        row = int(used[np.argmax(bad)])
        x, y = graph.vertices[row].tolist()
        raise ValueError(f"vertices[{row}] is ({x}, {y}); every coordinate of a drawing to be saved must be finite")
    left, low = points.min(axis=0).tolist()
    right, high = points.max(axis=0).tolist()
    if max(right / 2 - left / 2, high / 2 - low / 2) > _FARTHEST:
        raise ValueError(f"the drawing reaches from ({left}, {low}) to ({right}, {high}), too far to be saved")
    return left, low, right, high


def svg_start(box: tuple[float, float, float, float]) -> tuple[float, float]:
    """Where the coordinates of an SVG start from: the upper left corner of a box, in directions in which that is far.

    Numbers of one sign, one at most twice the other, have a difference without rounding: no bit is lost.
    """
    left, low, right, high = box
    away = _AWAY * max(right - left, high - low)
    return left if max(-left, right) > away > 0 else 0.0, -high if max(-low, high) > away > 0 else 0.0


def svg_moved(start: tuple[float, float]) -> str:
    """The attribute of what has such coordinates."""
    return f' transform="translate({start[0]!r} {start[1] + 0.0!r})"' if any(start) else ""


def _path(graph: PlanarGraph, start: tuple[float, float]) -> str:
    """The `d` attribute. `repr` writes the shortest number that reads back to the same bits."""
    # Adding zero turns -0.0 into 0.0.
    left, top = start
    return "".join(f"M{line}" for line in _texts(graph, lambda x, y: f"{x - left + 0.0!r} {0.0 - y - top!r}", "L"))


def _texts(graph: PlanarGraph, point: Callable[[float, float], str], between: str) -> Iterator[str]:
    """Every line as text, point after point."""
    coords, offsets = graph.polylines()
    points = [point(x, y) for x, y in files.rows_of(coords)]
    return (between.join(points[start:end]) for start, end in pairwise(offsets.tolist()))
