"""Cracks as files: SVG with true outlines, DXF by generation, GeoJSON with who abuts whom."""

from __future__ import annotations

import io
import json
import os
from collections import defaultdict
from collections.abc import Iterator
from itertools import product
from pathlib import PurePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments, export, files
from crazing.extras import require
from crazing.strokes import Strand, outlines, strands

if TYPE_CHECKING:
    from crazing.crack import Crack


#: Millimetres of a data unit, far beyond any paper: times a coordinate they are still numbers.
SMALLEST, LARGEST = 1e-12, 1e12


def copies(crack: Crack, places: list[NDArray[np.float64]]) -> Iterator[list[tuple[float, float]]]:
    """How far each of some point sets is to be moved, so that it fills one period of a torus; once in the plane."""
    for points in places:
        if crack.period is None:
            yield [(0.0, 0.0)]
            continue
        period, corner = np.array(crack.period), np.array(crack.bounds[:2])
        first, last = (np.floor((end - corner) / period) for end in (points.min(axis=0), points.max(axis=0)))
        ways = (np.arange(-high, -low + 1) for low, high in zip(first, last, strict=True))
        yield [(float(x * period[0]), float(y * period[1])) for x, y in product(*ways)]


def save(crack: Crack, path: str | os.PathLike[str], millimetres: float | None = None) -> None:
    """Writes `crack` in the format that the ending of `path` names; see `Crack.save`."""
    ending = PurePath(arguments.file_path(path)).suffix.lower()
    if ending not in _WRITERS:
        raise ValueError(f"path is {os.fspath(path)!r}; an ending of {', '.join(_WRITERS)} is wanted")
    if millimetres is not None:
        millimetres = arguments.number(millimetres, "millimetres", low=SMALLEST, high=LARGEST)
    _check(crack)
    content = _WRITERS[ending](crack, millimetres)
    with files.atomic_write(path) as file:
        file.write(content.encode())


def _check(crack: Crack) -> None:
    arguments.bounds_tuple(crack.bounds)
    for name, values, wrong, wanted in (
        ("vertices", crack.graph.vertices, ~np.isfinite(crack.graph.vertices), "every coordinate of"),
        ("width", crack.width, ~(np.isfinite(crack.width) & (crack.width >= 0)), "every width, at least 0, of"),
    ):
        if wrong.any():
            row = int(np.argmax(wrong.any(axis=1)))
            place = tuple(values[row].tolist())
            raise ValueError(f"{name}[{row}] is {place}; {wanted} a drawing to be saved must be finite")


def _by_generation(crack: Crack) -> list[tuple[int, list[Strand]]]:
    groups = defaultdict(list)
    for strand in strands(crack):
        groups[strand.generation].append(strand)
    return sorted(groups.items())


def _svg(crack: Crack, millimetres: float | None) -> str:
    xmin, ymin, xmax, ymax = crack.bounds
    groups = [(number, [(s, outlines(s)) for s in group]) for number, group in _by_generation(crack)]
    box = " ".join(map(repr, (xmin, -ymax, xmax - xmin, ymax - ymin)))
    thin = repr(max(xmax - xmin, ymax - ymin) / 1000)
    sides = (xmax - xmin, ymax - ymin)
    size = "" if millimetres is None else 'width="{!r}mm" height="{!r}mm" '.format(*(millimetres * x for x in sides))
    start = export.svg_start(crack.bounds)
    moved = export.svg_moved(start)
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"',
        f'{size}viewBox="{box}">',
        f"<metadata>crazing {_core.__version__}</metadata>",
        f'<g id="outlines" fill="black" fill-rule="nonzero" stroke="none"{moved}>',
        *(_svg_group("outlines", number, group, start, "Z") for number, group in groups),
        "</g>",
        f'<g id="centrelines" fill="none" stroke="black" stroke-width="{thin}" visibility="hidden"{moved}>',
        *(
            _svg_group("centrelines", number, [(s, [s.points]) for s, _ in group], start, "")
            for number, group in groups
        ),
        "</g>",
        *_svg_copies(crack, [shape for _, group in groups for _, shapes in group for shape in shapes]),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _svg_group(
    kind: str,
    number: int,
    paths: list[tuple[Strand, list[NDArray[np.float64]]]],
    start: tuple[float, float],
    close: str,
) -> str:
    rows = [f'<g id="{kind}-generation-{number}">']
    for index, (strand, shapes) in enumerate(paths):
        places = "".join(f"M{_svg_places(points, start)}{close}" for points in shapes)
        rows.append(f'<path id="{kind}-{number}-{index}" data-strand="{strand.number}" d="{places}"/>')
    return "\n".join([*rows, "</g>"])


def _svg_places(points: NDArray[np.float64], start: tuple[float, float]) -> str:
    # Adding zero turns -0.0 into 0.0; repr is the shortest text that reads back to the same bits.
    return "L".join(f"{x!r} {y!r}" for x, y in (points * (1.0, -1.0) - start + 0.0).tolist())


def _svg_copies(crack: Crack, shapes: list[NDArray[np.float64]]) -> Iterator[str]:
    """Copies of both groups, moved by periods, wherever that brings something into the picture."""
    moves = {move for each in copies(crack, shapes) for move in each} - {(0.0, 0.0)}
    for x, y in sorted(moves):
        for kind in ("outlines", "centrelines"):
            # Programs older than SVG 2 know no other name for it.
            yield f'<use xlink:href="#{kind}" x="{x!r}" y="{0.0 - y!r}"/>'


def _dxf(crack: Crack, millimetres: float | None) -> str:
    ezdxf = require("ezdxf", "cad")
    drawing = ezdxf.new("R2010", units=0 if millimetres is None else ezdxf.units.MM)
    unit = 1.0 if millimetres is None else millimetres
    space = drawing.modelspace()
    for number, group in _by_generation(crack):
        layer = f"generation-{number}"
        drawing.layers.add(layer, color=1 + number % 255)
        for strand in group:
            # Start and end width of each piece; the last row's are of a closing piece, which there is none of.
            after = np.append(strand.width[1:], strand.width[-1])
            rows = (unit * np.column_stack([strand.points, strand.width, after])).tolist()
            space.add_lwpolyline(rows, format="xyse", dxfattribs={"layer": layer})
    xmin, ymin, xmax, ymax = (unit * end for end in crack.bounds)
    drawing.set_modelspace_vport(height=ymax - ymin, center=((xmin + xmax) / 2, (ymin + ymax) / 2))
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def _geojson(crack: Crack, millimetres: float | None) -> str:
    if millimetres is not None:
        raise ValueError("millimetres are given; GeoJSON has no size on paper, .svg and .dxf have")
    lines = strands(crack)
    features = [
        {
            "type": "Feature",
            "properties": {
                "strand": strand.number,
                "generation": strand.generation,
                "parent": None if strand.parent < 0 else strand.parent,
                "width": float(strand.width.max()),
                "widths": strand.width.tolist(),
            },
            "geometry": {"type": "LineString", "coordinates": strand.points.tolist()},
        }
        for strand in lines
    ]
    # RFC 7946 wants all coordinates in it; lines on a torus run on beyond its bounds.
    places = np.concatenate([np.reshape(crack.bounds, (2, 2)), *(strand.points for strand in lines)])
    box = {
        "bbox": [*places.min(axis=0).tolist(), *places.max(axis=0).tolist()],
        "maker": f"crazing {_core.__version__}",
    }
    return json.dumps({"type": "FeatureCollection", **box, "features": features}, allow_nan=False)


_WRITERS = {".svg": _svg, ".dxf": _dxf, ".geojson": _geojson}
