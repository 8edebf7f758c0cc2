"""A drawing as a file: PNG, SVG with a group a layer, DXF with a layer a layer, a zip of a texture."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from crazing import files
from crazing.crack import Crack
from crazing.edit.cracks import picture_shape
from crazing.edit.layers import Drawing, Layer
from crazing.extras import require
from crazing.graph import PlanarGraph
from crazing.render import Style, render

#: Ink of every layer on white paper; the page has its own, for light and dark.
INKS = {
    "points": "#1c1917",
    "delaunay": "#a8a29e",
    "voronoi": "#7c9cc4",
    "crust": "#1c1917",
    "axis": "#c2410c",
    "curve": "#15803d",
    "poles": "#7e22ce",
    "shared": "#57534e",
    "only-first": "#c2410c",
    "only-second": "#1d4ed8",
    "walls": "#1c1917",
    "solution": "#dc2626",
    "ends": "#dc2626",
    "crack": "#1c1917",
    "nested-0": "#9a3412",
    "nested-1": "#b45309",
    "nested-2": "#4d7c0f",
    "nested-3": "#0f766e",
    "nested-4": "#1d4ed8",
}

#: Layers of a comparison that lie under others there; a file shows the overlay.
HIDDEN = frozenset({"crust-first", "crust-second", "axis-first", "axis-second"})


Box: TypeAlias = tuple[float, float, float, float]


def shown(drawing: Drawing, points: NDArray[np.float64]) -> list[Layer]:
    """The layers that a file shows, bottom first, the points on top."""
    lines = [layer for layer in drawing.layers if layer.name not in HIDDEN]
    return [*lines, Layer("points", marks=points)] if len(points) else lines


def frame(drawing: Drawing, points: NDArray[np.float64]) -> Box:
    """What a file of lines shows: the bounds of a crack, else the box of the points grown by a tenth."""
    if isinstance(drawing.subject, Crack):
        return drawing.subject.bounds
    low, high = points.min(axis=0), points.max(axis=0)
    margin = 0.1 * (float((high - low).max()) or 1.0)
    return float(low[0] - margin), float(low[1] - margin), float(high[0] + margin), float(high[1] + margin)


def png(layers: list[Layer], box: Box, size: int) -> bytes:
    """The layers over one another on white, the longer side `size` pixels."""
    height, width = picture_shape(box, size)
    picture = np.full((height, width, 3), 255, dtype=np.uint8)
    line = max(box[2] - box[0], box[3] - box[1]) / size * max(1.0, size / 600)
    for layer in layers:
        # A mark is an edge without length: its round ends are a disc.
        graph, thick = (layer.graph, line) if layer.graph is not None else (_dots(layer.marks), 4 * line)
        style = Style(ink=INKS[layer.name], ground=None, width=thick)
        picture = _blended(picture, render(graph, (height, width), bounds=box, style=style))
    return png_of(picture)


def _dots(marks: NDArray[np.float64] | None) -> PlanarGraph:
    rows = np.arange(0 if marks is None else len(marks), dtype=np.int32)
    return PlanarGraph(np.empty((0, 2)) if marks is None else marks, np.column_stack([rows, rows]))


def _blended(under: NDArray[np.uint8], over: NDArray[np.uint8]) -> NDArray[np.uint8]:
    alpha = over[..., 3:].astype(np.uint32)
    mixed = (over[..., :3] * alpha + under * (255 - alpha) + 127) // 255
    return mixed.astype(np.uint8)


def png_of(picture: NDArray[np.uint8]) -> bytes:
    """A picture as the bytes of a PNG."""
    file = io.BytesIO()
    files.save_png(file, picture)
    return file.getvalue()


def svg(layers: list[Layer], box: Box) -> bytes:
    """One group a layer. Coordinates are those of the points, y turned, to the last bit."""
    left, low, right, high = box
    across = max(right - left, high - low)
    view = f"{left!r} {-high!r} {right - left!r} {high - low!r}"
    style = f'fill="none" stroke-width="{across / 500!r}" stroke-linecap="round" stroke-linejoin="round"'
    text = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{view}">']
    for layer in layers:
        head, ink = f'<g id="{layer.name}"', INKS[layer.name]
        if layer.graph is not None:
            text += [f'{head} {style} stroke="{ink}">', f'<path d="{"".join(_paths(layer.graph))}"/>', "</g>"]
        elif layer.marks is not None:
            circles = (f'<circle cx="{x!r}" cy="{-y!r}" r="{across / 250!r}"/>' for x, y in layer.marks.tolist())
            text += [f'{head} fill="{ink}">', *circles, "</g>"]
    return "\n".join([*text, "</svg>\n"]).encode()


def _lines(graph: PlanarGraph) -> Iterator[NDArray[np.float64]]:
    coords, offsets = graph.polylines()
    return (coords[start:end] for start, end in pairwise(offsets.tolist()))


def _paths(graph: PlanarGraph) -> Iterator[str]:
    for line in _lines(graph):
        # Adding zero turns -0.0 into 0.0.
        yield "M" + "L".join(f"{x!r} {y!r}" for x, y in (line * (1.0, -1.0) + 0.0).tolist())


def dxf(layers: list[Layer], box: Box) -> bytes:
    """Every layer as polylines or points of a DXF layer of its name."""
    ezdxf = require("ezdxf", "cad")
    left, low, right, high = box
    drawing = ezdxf.new("R2010", units=0)
    space = drawing.modelspace()
    for layer in layers:
        name = {"layer": layer.name.upper()}
        color = ezdxf.colors.rgb2int(tuple(bytes.fromhex(INKS[layer.name][1:])))
        drawing.layers.add(name["layer"], true_color=color)
        for line in [] if layer.graph is None else _lines(layer.graph):
            ring = len(line) > 3 and bool((line[0] == line[-1]).all())
            space.add_lwpolyline((line[:-1] if ring else line).tolist(), close=ring, dxfattribs=name)
        for x, y in [] if layer.marks is None else layer.marks.tolist():
            space.add_point((x, y), dxfattribs=name)
    drawing.set_modelspace_vport(height=high - low, center=((left + right) / 2, (low + high) / 2))
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode()


def zipped(content: dict[str, bytes]) -> bytes:
    """Files by name in a zip that is the same bytes for the same content."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_STORED) as archive:
        for name in sorted(content):
            # Without a date: the earliest that a zip can hold.
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), content[name])
    return file.getvalue()


def folder_content(folder: Path) -> dict[str, bytes]:
    """What a folder holds, by path within it."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}
