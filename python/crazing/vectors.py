"""Cracks as files: SVG with true outlines, DXF by generation, GeoJSON with who abuts whom."""

from __future__ import annotations

import io
import json
import os
from collections import defaultdict, deque
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise, product
from pathlib import PurePath
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments, files
from crazing.extras import require

if TYPE_CHECKING:
    from crazing.crack import Crack


#: Cosine of the turn from which on a bend is round.
BEND = 0.5
#: Sides of a round end: half its circle is off by less than a hundredth of half the width.
CAP = 12


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
    # Once for all strands: it is an array of every edge.
    segments, found = crack.segments, []
    for number in sorted(rows):
        found.extend(_lines(crack, segments, number, rows[number]))
    return found


def _lines(crack: Crack, segments: NDArray[np.float64], number: int, rows: list[int]) -> list[Strand]:
    """The edges of one strand in turn; a growing one may be in several pieces."""
    ends: defaultdict[int, deque[tuple[int, int]]] = defaultdict(deque)
    for row in rows:
        for side, vertex in enumerate(crack.graph.edges[row].tolist()):
            ends[vertex].append((row, side))
    # From the tips; what is left are rings.
    starts = [there[0] for _, there in sorted(ends.items()) if len(there) % 2] + [(row, 0) for row in rows]
    seen: set[int] = set()
    found = []
    for row, side in starts:
        if row in seen:
            continue
        points, widths = [segments[row, side]], [crack.width[row, side]]
        while row not in seen:
            seen.add(row)
            step = segments[row, 1 - side] - segments[row, side]
            points.append(points[-1] + step if crack.period is not None else segments[row, 1 - side])
            widths.append(crack.width[row, 1 - side])
            there = ends[int(crack.graph.edges[row, 1 - side])]
            while there and there[0][0] in seen:
                there.popleft()
            row, side = there[0] if there else (row, side)
        line = Strand(
            np.array(points),
            np.array(widths),
            number,
            int(crack.generation[rows[0]]),
            int(crack.parent[rows[0]]),
        )
        found.append(line)
    return found


def outlines(strand: Strand) -> list[NDArray[np.float64]]:
    """Closed outlines, (k, 2) float64 each, that together are a strand: left side there, right side back, round ends.

    A strand is parted where it turns by more than 60 degrees, so that such bends are round; others are mitred, no
    farther out than 1.16 times half the width. All run clockwise: where they overlap, the nonzero rule fills them.
    """
    moves = np.append(True, (np.diff(strand.points, axis=0) != 0).any(axis=1))
    points, half = strand.points[moves], strand.width[moves] / 2
    step = np.diff(points, axis=0)
    along = step / np.hypot(*step.T)[:, None]
    bends = np.flatnonzero((along[1:] * along[:-1]).sum(axis=1) < BEND) + 1
    pieces = pairwise([0, *bends.tolist(), len(along)])
    return [_outline(points[a : b + 1], half[a : b + 1], along[a:b]) for a, b in pieces if b > a]


def _outline(points: NDArray[np.float64], half: NDArray[np.float64], along: NDArray[np.float64]) -> NDArray[np.float64]:
    across = along[:, ::-1] * (-1, 1)
    sum_ = np.vstack([across[:1], across]) + np.vstack([across, across[-1:]])
    # Half the sum has the length of the cosine of half the turn; the mitre is as much longer than half the width.
    off = 2 * sum_ / (sum_**2).sum(axis=1)[:, None] * half[:, None]
    ends = (_cap(points[-1], across[-1] * half[-1]), _cap(points[0], -across[0] * half[0]))
    return np.concatenate([points + off, ends[0], (points - off)[::-1], ends[1]])


def _cap(centre: NDArray[np.float64], side: NDArray[np.float64]) -> NDArray[np.float64]:
    """What lies between a point beside the end of a line and the one opposite, clockwise; nothing about a tip."""
    turn = np.linspace(0, np.pi, CAP + 1)[1:-1] if side.any() else np.empty(0)
    return np.asarray(centre + np.outer(np.cos(turn), side) + np.outer(np.sin(turn), side[::-1] * (1, -1)))


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
    groups = [(number, [(s, outlines(s)) for s in group]) for number, group in _by_generation(crack)]
    box = " ".join(map(repr, (xmin, -ymax, xmax - xmin, ymax - ymin)))
    thin = repr(max(xmax - xmin, ymax - ymin) / 1000)
    lines = [
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"',
        f'viewBox="{box}">',
        f"<metadata>crazing {_core.__version__}</metadata>",
        '<g id="outlines" fill="black" fill-rule="nonzero" stroke="none">',
        *(_svg_group("outlines", number, group, "Z") for number, group in groups),
        "</g>",
        f'<g id="centrelines" fill="none" stroke="black" stroke-width="{thin}" visibility="hidden">',
        *(_svg_group("centrelines", number, [(s, [s.points]) for s, _ in group], "") for number, group in groups),
        "</g>",
        *_svg_copies(crack, [shape for _, group in groups for _, shapes in group for shape in shapes]),
        "</svg>",
    ]
    return "\n".join(lines) + "\n"


def _svg_group(kind: str, number: int, paths: list[tuple[Strand, list[NDArray[np.float64]]]], close: str) -> str:
    rows = [f'<g id="{kind}-generation-{number}">']
    for index, (strand, shapes) in enumerate(paths):
        places = "".join(f"M{_svg_places(points)}{close}" for points in shapes)
        rows.append(f'<path id="{kind}-{number}-{index}" data-strand="{strand.number}" d="{places}"/>')
    return "\n".join([*rows, "</g>"])


def _svg_places(points: NDArray[np.float64]) -> str:
    # Adding zero turns -0.0 into 0.0; repr is the shortest text that reads back to the same bits.
    return "L".join(f"{x!r} {y!r}" for x, y in (points * (1.0, -1.0) + 0.0).tolist())


def _svg_copies(crack: Crack, shapes: list[NDArray[np.float64]]) -> Iterator[str]:
    """Copies of both groups, moved by periods, wherever that brings something into the picture."""
    moves = {move for each in copies(crack, shapes) for move in each} - {(0.0, 0.0)}
    for x, y in sorted(moves):
        for kind in ("outlines", "centrelines"):
            # Programs older than SVG 2 know no other name for it.
            yield f'<use xlink:href="#{kind}" x="{x!r}" y="{0.0 - y!r}"/>'


def _dxf(crack: Crack) -> str:
    ezdxf = require("ezdxf", "cad")
    drawing = ezdxf.new("R2010", units=0)
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
