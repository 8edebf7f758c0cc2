"""A maze on a page, in millimetres: lines for a plotter, a cutter or a printer."""

from __future__ import annotations

import io
import math
import os
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import PurePath
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import _core, files
from crazing.arguments import file_path
from crazing.errors import CrazingError
from crazing.extras import require
from crazing.graph import PlanarGraph
from crazing.images import PIXEL_LIMIT
from crazing.mosaic import Mosaic, compound

Line = NDArray[np.float64]

#: Millimetres of an inch.
_INCH = 25.4

#: Pixels an inch of a PNG.
_DPI = 300


@dataclass(frozen=True)
class Sheet:
    """Layers of lines in millimetres, y up, on a page."""

    page: tuple[float, float]
    pen: float
    layers: dict[str, list[Line]]
    #: The place in the maze that is the middle of the page, and millimetres a unit.
    middle: Line
    scale: float
    #: Areas on the page, and the colour of each.
    fills: Mosaic | None = None
    colours: list[str] = field(default_factory=list)

    def filled(self, mosaic: Mosaic, values: NDArray[np.int32]) -> Sheet:
        """The same with areas coloured by the value of their cell, from pale to dark."""
        shown = values[mosaic.cells]
        part = shown / max(int(shown.max(initial=0)), 1)
        # Areas of one colour are one path: a file is then little larger than its corners.
        tints = np.rint(part * (_TINTS - 1)).astype(int)
        order = {tint: np.flatnonzero(tints == tint).tolist() for tint in np.unique(tints).tolist()}
        areas = [[self._placed(ring) for row in rows for ring in mosaic.areas[row]] for rows in order.values()]
        clip = None if mosaic.clip is None else [self._placed(ring) for ring in mosaic.clip]
        tones = [np.array([np.interp(tint / (_TINTS - 1), *tone) for tone in _RAMP]) for tint in order]
        colours = ["#" + "".join(f"{round(value):02x}" for value in tone) for tone in tones]
        return replace(self, fills=Mosaic(np.array(list(order), dtype=np.int32), areas, clip), colours=colours)

    def _placed(self, points: Line) -> Line:
        return np.asarray((points - self.middle) * self.scale + np.array(self.page) / 2)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the page in the format that the ending of `path` names."""
        writers = {".svg": self.svg, ".dxf": self.dxf, ".pdf": self.pdf, ".png": self.png}
        ending = PurePath(file_path(path)).suffix.lower()
        if ending not in writers:
            raise ValueError(f"path is {os.fspath(path)!r}; an ending of {', '.join(writers)} is wanted")
        content = writers[ending]()
        with files.atomic_write(path) as file:
            file.write(content)

    def svg(self) -> bytes:
        """One group a layer, as Inkscape and plotters know them."""
        width, height = self.page
        size = f'width="{width:g}mm" height="{height:g}mm" viewBox="0 0 {width:g} {height:g}"'
        names = 'xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"'
        style = f'fill="none" stroke-width="{self.pen:g}" stroke-linecap="round" stroke-linejoin="round"'
        text = [f"<svg {names} {size}>", f"<metadata>crazing {_core.__version__}</metadata>"]
        text += self._svg_fills()
        for name, lines in self.layers.items():
            layer = f'id="{name}" inkscape:label="{name}" inkscape:groupmode="layer"'
            text += [f'<g {layer} {style} stroke="{_COLOURS[name]}">', f'<path d="{self._path(lines)}"/>', "</g>"]
        return "\n".join([*text, "</svg>"]).encode()

    def _svg_fills(self) -> list[str]:
        if self.fills is None:
            return []
        text = ['<g id="distances" inkscape:label="distances" inkscape:groupmode="layer">']
        if self.fills.clip is not None:
            shape = f'<path clip-rule="evenodd" d="{self._path(self.fills.clip, "Z")}"/>'
            text = [f'<clipPath id="shape">{shape}</clipPath>', text[0].replace("<g", '<g clip-path="url(#shape)"')]
        for rings, colour in zip(self.fills.areas, self.colours, strict=True):
            # A line of the same colour, or the page would shine through between neighbours.
            style = f'fill="{colour}" stroke="{colour}" stroke-width="{_SEAM}" stroke-linejoin="round"'
            text.append(f'<path {style} d="{self._path(rings, "Z")}"/>')
        return [*text, "</g>"]

    def _path(self, lines: list[Line], end: str = "") -> str:
        turned = (line * (1, -1) + (0, self.page[1]) for line in lines)
        # A thousandth of a millimetre is finer than any machine.
        return "".join("M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in line.tolist()) + end for line in turned)

    def dxf(self) -> bytes:
        """One layer of LWPOLYLINE each, units millimetres."""
        if self.fills is not None:
            raise ValueError(
                "distances are colours, which a plan in DXF has not; an ending of .svg, .pdf or .png is wanted"
            )
        ezdxf = require("ezdxf", "cad")
        drawing = ezdxf.new("R2010", units=ezdxf.units.MM)
        space = drawing.modelspace()
        for name, lines in self.layers.items():
            drawing.layers.add(name.upper(), color=1 if name == "solution" else 7)
            for line in lines:
                ring = len(line) > 3 and bool((line[0] == line[-1]).all())
                points = (line[:-1] if ring else line).tolist()
                space.add_lwpolyline(points, close=ring, dxfattribs={"layer": name.upper()})
        text = io.StringIO()
        drawing.write(text)
        return text.getvalue().encode()

    def pdf(self) -> bytes:
        """A page of vectors."""
        # Without a date the same maze gives the same bytes.
        return self._printed(format="pdf", metadata={"CreationDate": None})

    def png(self) -> bytes:
        """A picture of 300 pixels an inch."""
        across, high = (math.ceil(side / _INCH * _DPI) for side in self.page)
        if across * high > PIXEL_LIMIT:
            raise ValueError(
                f"page is {self.page}; at most {PIXEL_LIMIT} pixels are drawn, these would be {across * high}"
            )
        return self._printed(format="png", dpi=_DPI)

    def _printed(self, **options: Any) -> bytes:
        lines = require("matplotlib.collections", "plot").LineCollection
        figure = require("matplotlib.figure", "plot").Figure(figsize=[side / _INCH for side in self.page])
        axes = figure.add_axes((0, 0, 1, 1))
        axes.set(xlim=(0, self.page[0]), ylim=(0, self.page[1]))
        axes.set_axis_off()
        if self.fills is not None:
            self._print_fills(axes)
        for name, layer in self.layers.items():
            style = {"capstyle": "round", "joinstyle": "round", "linewidths": self.pen / _INCH * 72}
            axes.add_collection(lines(layer, colors=_COLOURS[name], **style))
        content = io.BytesIO()
        figure.savefig(content, **options)
        return content.getvalue()

    def _print_fills(self, axes: Any) -> None:
        assert self.fills is not None
        collection, path = (
            require("matplotlib.collections", "plot").PathCollection,
            require("matplotlib.path", "plot").Path,
        )
        areas = [compound(path, rings) for rings in self.fills.areas]
        seam = {"edgecolors": self.colours, "linewidths": _SEAM / _INCH * 72, "joinstyle": "round"}
        drawn = collection(areas, facecolors=self.colours, **seam, zorder=0)
        axes.add_collection(drawn)
        if self.fills.clip is not None:
            drawn.set_clip_path(compound(path, self.fills.clip), axes.transData)


#: Millimetres: the line about filled areas.
_SEAM = 0.05

#: Steps from the palest colour to the darkest.
_TINTS = 64

#: Red, green and blue along the way from near to far: from straw over sea green to slate, on which black walls and a
#: red way stand out everywhere.
_RAMP = [
    ((0, 0.25, 0.5, 0.75, 1), tone)
    for tone in ((255, 205, 140, 104, 96), (246, 230, 203, 164, 118), (214, 188, 187, 192, 178))
]

_COLOURS = {"walls": "black", "solution": "red"}


def sheet(
    walls: PlanarGraph,
    solution: PlanarGraph | None,
    *,
    page: tuple[float, float],
    margin: float,
    pen: float,
    thickness: float | None,
) -> Sheet:
    """Walls, and a solution if there is one, fitted into the page within its margin."""
    room = np.array(page) - 2 * margin
    if not (room > 0).all():
        raise ValueError(f"margin is {margin}; less than half of a page of {page[0]:g} x {page[1]:g} mm is wanted")
    if not len(walls.edges):
        raise CrazingError("the maze has no walls to be drawn")
    drawn = walls.vertices[np.unique(walls.edges)]
    low, high = drawn.min(axis=0), drawn.max(axis=0)
    # A wall's thickness lies half on either side of its line.
    room = room - (thickness or 0.0)
    scale = float(np.min(room / np.maximum(high - low, 1e-300)))
    lines = list(_lines(walls, (low + high) / 2, scale, page))
    if thickness is not None:
        lines = _thick(lines, thickness)
    layers = {"walls": ordered(lines)}
    if solution is not None:
        layers["solution"] = ordered(list(_lines(solution, (low + high) / 2, scale, page)))
    return Sheet(page, pen, layers, (low + high) / 2, scale)


def _lines(graph: PlanarGraph, middle: Line, scale: float, page: tuple[float, float]) -> Iterator[Line]:
    """The polylines on the page, every edge once however often it is there."""
    points, number = np.unique(graph.vertices, axis=0, return_inverse=True)
    edges = np.sort(number.reshape(-1)[graph.edges], axis=1)
    edges = np.unique(edges[edges[:, 0] != edges[:, 1]], axis=0)
    coords, offsets = PlanarGraph(points, edges.astype(np.int32)).polylines()
    placed = (coords - middle) * scale + np.array(page) / 2
    return (placed[start:end] for start, end in pairwise(offsets.tolist()))


def _thick(lines: list[Line], thickness: float) -> list[Line]:
    """The outlines of walls of that thickness, as closed lines: what a cutter follows."""
    shapely = require("shapely", "graph")
    joined = shapely.union_all(shapely.buffer([shapely.LineString(line) for line in lines], thickness / 2))
    return [np.asarray(ring.coords) for part in shapely.get_parts(joined) for ring in (part.exterior, *part.interiors)]


def ordered(lines: list[Line]) -> list[Line]:
    """The lines in the order and direction in which a pen travels little: on to the nearest end that is left.

    Ends are sought in a grid, in rings about the pen, so the cost stays near that of one look a line.
    """
    if not lines:
        return []
    ends = np.array([point for line in lines for point in (line[0], line[-1])])
    low = ends.min(axis=0)
    across = float((ends.max(axis=0) - low).max()) or 1.0
    count = max(1, int(np.sqrt(len(lines))))
    squares = list(map(tuple, np.minimum((ends - low) / across * count, count - 1).astype(int).tolist()))
    grid: dict[tuple[int, ...], list[int]] = {}
    for end, square in enumerate(squares):
        grid.setdefault(square, []).append(end)
    # Numbers of Python's own: NumPy's are several times slower one by one.
    places: list[tuple[float, float]] = list(map(tuple, ends.tolist()))
    left = bytearray(b"\1") * len(lines)
    found = []
    at = 0
    for _ in lines:
        end = _nearest(grid, places, left, places[at], squares[at], count)
        left[end // 2] = 0
        found.append(lines[end // 2] if end % 2 == 0 else lines[end // 2][::-1])
        at = end ^ 1
    return found


def _nearest(
    grid: dict[tuple[int, ...], list[int]],
    places: list[tuple[float, float]],
    left: bytearray,
    at: tuple[float, float],
    square: tuple[int, ...],
    count: int,
) -> int:
    best, least, seen = -1, np.inf, np.inf
    for ring in range(count + 1):
        if best >= 0 and ring > seen + 1:
            break
        for key in _ring(square, ring):
            ends = grid.get(key)
            if not ends:
                continue
            # Ends of lines that were drawn are forgotten where they are met.
            grid[key] = kept = [end for end in ends if left[end // 2]]
            for end in kept:
                x, y = places[end][0] - at[0], places[end][1] - at[1]
                away = x * x + y * y
                if best < 0 or away < least:
                    best, least, seen = end, away, min(seen, ring)
    return best


def _ring(middle: tuple[int, ...], ring: int) -> Iterator[tuple[int, int]]:
    x, y = middle
    for i in range(-ring, ring + 1):
        for j in range(-ring, ring + 1) if abs(i) == ring else (-ring, ring):
            yield x + i, y + j
            if ring == 0:
                return
