"""Cracks as files: SVG with true outlines, DXF by generation, GeoJSON with who abuts whom."""

from __future__ import annotations

import io
import json
import os
from collections import defaultdict
from dataclasses import dataclass
from pathlib import PurePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments, files
from crazing.extras import require

if TYPE_CHECKING:
    from crazing.crack import Crack


@dataclass(frozen=True, eq=False)
class Strand:
    """One crack from end to end.

    Attributes
    ----------
    points : (k, 2) float64
    width : (k,) float64
        At every point.
    number, generation, parent : int
    """

    points: NDArray[np.float64]
    width: NDArray[np.float64]
    number: int
    generation: int
    parent: int


def strands(crack: Crack) -> list[Strand]:
    """The strands in order; on a torus each in one piece, from where it starts."""
    rows = defaultdict(list)
    for row, number in enumerate(crack.strand.tolist()):
        rows[number].append(row)
    found = []
    for number in sorted(rows):
        found.extend(_lines(crack, number, rows[number]))
    return found


def _lines(crack: Crack, number: int, rows: list[int]) -> list[Strand]:
    """The edges of one strand in turn; a growing one may be in several pieces."""
    ends = defaultdict(list)
    for row in rows:
        for side, vertex in enumerate(crack.graph.edges[row].tolist()):
            ends[vertex].append((row, side))
    # From the tips; what is left are rings.
    starts = [there[0] for _, there in sorted(ends.items()) if len(there) % 2] + [(row, 0) for row in rows]
    seen: set[int] = set()
    segments, found = crack.segments, []
    for row, side in starts:
        if row in seen:
            continue
        points, widths = [segments[row, side]], [crack.width[row, side]]
        while row not in seen:
            seen.add(row)
            step = segments[row, 1 - side] - segments[row, side]
            points.append(points[-1] + step if crack.period is not None else segments[row, 1 - side])
            widths.append(crack.width[row, 1 - side])
            leaving = int(crack.graph.edges[row, 1 - side])
            row, side = next(((r, s) for r, s in ends[leaving] if r not in seen), (row, side))
        line = Strand(
            np.array(points),
            np.array(widths),
            number,
            int(crack.generation[rows[0]]),
            int(crack.parent[rows[0]]),
        )
        found.append(line)
    return found


def outline(strand: Strand) -> NDArray[np.float64]:
    """(2 k, 2) float64, the closed outline of a strand: its left side there, its right side back.

    At inner points the sides are mitred, no farther out than twice the width.
    """
    step = np.diff(strand.points, axis=0)
    length = np.hypot(*step.T)
    across = np.column_stack([-step[:, 1], step[:, 0]]) / np.where(length > 0, length, 1)[:, None]
    before, after = np.vstack([across[:1], across]), np.vstack([across, across[-1:]])
    if len(step) > 1 and np.array_equal(strand.points[0], strand.points[-1]):
        before[0], after[-1] = across[-1], across[0]
    sum_ = before + after
    # Half the sum has the length of the cosine of half the turn; the mitre is as much longer than half the width.
    square = (sum_**2).sum(axis=1) / 4
    mitre = sum_ / 2 / np.maximum(square, 0.25)[:, None]
    off = mitre * (strand.width / 2)[:, None]
    return np.concatenate([strand.points + off, (strand.points - off)[::-1]])


def save(crack: Crack, path: str | os.PathLike[str]) -> None:
    """Writes `crack` in the format that the ending of `path` names; see `Crack.save`."""
    ending = PurePath(arguments.file_path(path)).suffix.lower()
    if ending not in _WRITERS:
        raise ValueError(f"path is {os.fspath(path)!r}; an ending of {', '.join(_WRITERS)} is wanted")
    content = _WRITERS[ending](crack)
    with files.atomic_write(path) as file:
        file.write(content.encode())


def _by_generation(crack: Crack) -> list[tuple[int, list[Strand]]]:
    groups = defaultdict(list)
    for strand in strands(crack):
        groups[strand.generation].append(strand)
    return sorted(groups.items())


def _svg(crack: Crack) -> str:
    xmin, ymin, xmax, ymax = crack.bounds
    groups = _by_generation(crack)
    box = " ".join(map(repr, (xmin, -ymax, xmax - xmin, ymax - ymin)))
    thin = repr(max(xmax - xmin, ymax - ymin) / 1000)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}">',
        f"<metadata>crazing {_core.__version__}</metadata>",
        '<g id="outlines" fill="black" fill-rule="nonzero" stroke="none">',
        *(_svg_group("outlines", number, [(s, outline(s), "Z") for s in group]) for number, group in groups),
        "</g>",
        f'<g id="centrelines" fill="none" stroke="black" stroke-width="{thin}" visibility="hidden">',
        *(_svg_group("centrelines", number, [(s, s.points, "") for s in group]) for number, group in groups),
        "</g>",
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _svg_group(kind: str, number: int, paths: list[tuple[Strand, NDArray[np.float64], str]]) -> str:
    rows = [f'<g id="{kind}-generation-{number}">']
    for index, (strand, points, close) in enumerate(paths):
        # Adding zero turns -0.0 into 0.0; repr is the shortest text that reads back to the same bits.
        places = "L".join(f"{x!r} {y!r}" for x, y in (points * (1.0, -1.0) + 0.0).tolist())
        rows.append(f'<path id="{kind}-{number}-{index}" data-strand="{strand.number}" d="M{places}{close}"/>')
    return "\n".join([*rows, "</g>"])


def _dxf(crack: Crack) -> str:
    ezdxf = require("ezdxf", "cad")
    drawing = ezdxf.new("R2010")
    space = drawing.modelspace()
    for number, group in _by_generation(crack):
        layer = f"generation-{number}"
        drawing.layers.add(layer, color=1 + number % 255)
        for strand in group:
            # Start and end width of each piece; the last row's are of a closing piece, which there is none of.
            after = np.append(strand.width[1:], strand.width[-1])
            rows = np.column_stack([strand.points, strand.width, after]).tolist()
            space.add_lwpolyline(rows, format="xyse", dxfattribs={"layer": layer})
    xmin, ymin, xmax, ymax = crack.bounds
    drawing.set_modelspace_vport(height=ymax - ymin, center=((xmin + xmax) / 2, (ymin + ymax) / 2))
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def _geojson(crack: Crack) -> str:
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
        for strand in strands(crack)
    ]
    box = {"bbox": list(crack.bounds), "maker": f"crazing {_core.__version__}"}
    return json.dumps({"type": "FeatureCollection", **box, "features": features}, allow_nan=False)


_WRITERS = {".svg": _svg, ".dxf": _dxf, ".geojson": _geojson}
