"""What the page draws: the layers of a mode, computed live from the points and the knobs."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from crazing import sample
from crazing.compare import compare
from crazing.crack import Crack
from crazing.diagram import Diagram, diagram
from crazing.edit.cracks import crack_of, has_own_plates
from crazing.errors import CrazingError, DegenerateInputError
from crazing.graph import PlanarGraph
from crazing.maze import Maze, maze
from crazing.region import as_region
from crazing.skeleton import crust, curve, medial_axis, nested, poles

Points: TypeAlias = NDArray[np.float64]
#: A name and one value or two; a row of the counts beside the drawing.
Row: TypeAlias = tuple[str, *tuple["int | float", ...]]

#: Nested curves grow threefold an iteration; more points than this are no longer live, nor is there room to see them.
MOST_NESTED = 400_000


@dataclass(frozen=True)
class Layer:
    """Lines or marks under one name: the word of its colour on the page and of its group in a file.

    Lines may have widths, one an edge, in data units.
    """

    name: str
    graph: PlanarGraph | None = None
    marks: Points | None = None
    widths: NDArray[np.float64] | None = None


@dataclass(frozen=True)
class Drawing:
    """All layers of a mode, bottom first, with what is worth counting.

    Attributes
    ----------
    layers : list of Layer
        Bottom first.
    head, rows
        A table: titles of the columns, and a name and values a row.
    note : str
        Why something that was asked for is not there; empty if all is.
    subject : Crack, PlanarGraph or None
        What would be measured.
    seconds : dict
        How long the layers took that can be left out while points move.
    """

    layers: list[Layer] = field(default_factory=list)
    head: tuple[str, ...] = ()
    rows: list[Row] = field(default_factory=list)
    note: str = ""
    subject: Crack | PlanarGraph | None = None
    seconds: dict[str, float] = field(default_factory=dict)


def draw(points: Points, mode: str, values: dict[str, Any], skip: frozenset[str] = frozenset()) -> Drawing:
    """The drawing of one mode.

    Parameters
    ----------
    points : (n, 2) float64
        Finite.
    mode : {"skeleton", "compare", "maze", "crack"}
        Which panel of knobs is drawn.
    values : dict
        The values of that panel's knobs, checked.
    skip : frozenset of str
        Layers of a skeleton to be left out; "crack" leaves out its roughness.

    Returns
    -------
    Drawing
        Too few points, or points on one line, are no error: its note says what is wanted.
    """
    if mode == "crack" and has_own_plates(values):
        return _crack(points, values, skip)
    if len(points) < 3:
        missing = 3 - len(points)
        return Drawing(note=f"Add {missing} more point{'s' * (missing > 1)}." if len(points) else "")
    try:
        return _MODES[mode](diagram(points), values, skip)
    except DegenerateInputError:
        return Drawing(note="All points lie on one line. Add one beside it.")


def _skeleton(d: Diagram, values: dict[str, Any], skip: frozenset[str]) -> Drawing:
    layers: list[Layer] = []
    rows: list[Row] = [("sites", len(d.sites)), ("edges", len(d.edges)), ("triangles", len(d.triangles))]
    seconds: dict[str, float] = {}
    for name, step in _STEPS.items():
        if values[name] and name not in skip:
            start = time.perf_counter()
            added, counted = step(d, values)
            seconds[name] = time.perf_counter() - start
            layers += added
            rows += counted
    graphs = {layer.name.partition("-")[0]: layer.graph for layer in layers}
    subject = graphs.get("axis") or graphs.get("nested") or graphs.get("curve") or graphs.get("crust")
    return Drawing(layers, rows=rows, subject=subject, note=_unpruned(values), seconds=seconds)


Made: TypeAlias = tuple[list[Layer], list[Row]]


def _draw_nested(d: Diagram, values: dict[str, Any]) -> Made:
    rounds = _nested(d, values)
    rows: list[Row] = [(f"nested {i + 1}, axis edges", len(found.edges)) for i, found in enumerate(rounds)]
    return [Layer(f"nested-{i}", found) for i, found in enumerate(rounds)], rows


def _draw_axis(d: Diagram, values: dict[str, Any]) -> Made:
    axis = axis_of(d, values)
    counts: list[Row] = [("axis edges", len(axis.edges)), ("axis pieces", axis.components), ("free ends", axis.leaves)]
    return [Layer("axis", axis)], counts


def _draw_crust(d: Diagram, values: dict[str, Any]) -> Made:
    found = crust(d, method=values["crust_method"])
    return [Layer("crust", found)], [("crust edges", len(found.edges)), ("crust pieces", found.components)]


def _draw_curve(d: Diagram, values: dict[str, Any]) -> Made:
    found = curve(d)
    return [Layer("curve", found)], [("curve pieces", found.components)]


def _draw_poles(d: Diagram, values: dict[str, Any]) -> Made:
    found = poles(d)
    marks = d.vertices[np.unique(found[found >= 0])]
    return [Layer("poles", marks=marks)], [("poles", len(marks))]


# By the knob that turns each on, bottom first.
_STEPS: dict[str, Callable[[Diagram, dict[str, Any]], Made]] = {
    "delaunay": lambda d, values: ([Layer("delaunay", d.delaunay)], []),
    "voronoi": lambda d, values: ([Layer("voronoi", d.voronoi())], []),
    "nested": _draw_nested,
    "axis": _draw_axis,
    "crust": _draw_crust,
    "curve": _draw_curve,
    "poles": _draw_poles,
}


def _unpruned(values: dict[str, Any]) -> str:
    asked = values["axis"] and values["prune"] and not _prunes(values)
    return f"An axis by {values['axis_method']} is not pruned: its edges are not all dual." if asked else ""


def _prunes(values: dict[str, Any]) -> bool:
    return bool(values["prune"]) and values["axis_method"] in ("edge-filter", "one-step")


def axis_of(d: Diagram, values: dict[str, Any]) -> PlanarGraph:
    """The medial axis as the knobs have it."""
    skeleton = medial_axis(d, method=values["axis_method"])
    return (skeleton.prune(values["residual"]) if _prunes(values) else skeleton).axis


def _nested(d: Diagram, values: dict[str, Any]) -> list[PlanarGraph]:
    last = len(d.sites) * 3 ** (values["iterations"] - 1)
    if last > MOST_NESTED:
        raise CrazingError(
            f"{values['iterations']} iterations of {len(d.sites)} points are too many; take fewer of either"
        )
    method = values["axis_method"] if values["axis"] else "edge-filter"
    return [skeleton.axis for skeleton in nested(d.sites, iterations=values["iterations"], method=method)]


def _compare(d: Diagram, values: dict[str, Any], skip: frozenset[str]) -> Drawing:
    found = compare(d, values["first"], values["second"])
    layers = [
        Layer("crust-first", found.first.crust),
        Layer("crust-second", found.second.crust),
        Layer("axis-first", found.first.axis),
        Layer("axis-second", found.second.axis),
        Layer("shared", found.shared),
        Layer("only-first", found.only_first),
        Layer("only-second", found.only_second),
    ]
    rows: list[Row] = [row for row in found.table if row[0] != "seconds"]
    return Drawing(layers, head=(values["first"], values["second"]), rows=rows, subject=found.second.axis)


def maze_of(points: Points | Diagram, values: dict[str, Any]) -> Maze:
    """The maze as the knobs have it."""
    options = {"tree": values["tree"], "opening": values["opening"], "rng": values["seed"]}
    if values["cells"] != "in the curve":
        return maze(points, cells=values["cells"], **options)
    rings = rings_of(curve(points))
    if not rings:
        raise CrazingError("the curve through the points has no closed ring for a maze to be in")
    coords = np.concatenate(rings)
    box = (*coords.min(axis=0).tolist(), *coords.max(axis=0).tolist())
    spread = sample.uniform(values["fill"], bounds=box, rng=values["seed"])
    # A cell whose site is outside would take the way out of the shape.
    return maze(spread[as_region(rings).contains(spread)], within=rings, **options)


def rings_of(graph: PlanarGraph) -> list[Points]:
    """The closed polylines."""
    coords, offsets = graph.polylines()
    lines = [coords[start:end] for start, end in pairwise(offsets.tolist())]
    return [line for line in lines if len(line) > 3 and (line[0] == line[-1]).all()]


def _maze(d: Diagram, values: dict[str, Any], skip: frozenset[str]) -> Drawing:
    found = maze_of(d, values)
    layers = [Layer("walls", found.walls)]
    counts = found.statistics
    if values["solution"] and found.ends:
        layers.append(Layer("solution", found.path(found.solve(*found.ends))))
        layers.append(Layer("ends", marks=found.centres[list(found.ends)]))
    names = ("cells", "dead_ends", "junctions", "solution")
    rows: list[Row] = [(name.replace("_", " "), getattr(counts, name)) for name in names]
    return Drawing(layers, rows=[*rows, ("winding", counts.winding)], subject=found.walls)


def _crack(d: Points | Diagram, values: dict[str, Any], skip: frozenset[str]) -> Drawing:
    start = time.perf_counter()
    # Roughness costs more than all else, and leaves the rest of the pattern as it is.
    found = crack_of(d, {**values, "roughness": 0.0} if "crack" in skip else values)
    seconds = {} if "crack" in skip else {"crack": time.perf_counter() - start}
    graph = found.graph
    rows: list[Row] = [
        ("edges", len(graph.edges)),
        ("strands", int(found.strand.max(initial=-1)) + 1),
        ("generations", int(found.generation.max(initial=-1)) + 1),
        ("pieces", graph.components),
        ("free ends", graph.leaves),
        ("length", graph.length),
    ]
    layer = Layer("crack", PlanarGraph(*_unwrapped(found)), widths=found.width.mean(axis=1))
    return Drawing([layer], rows=rows, subject=found, seconds=seconds)


def _unwrapped(found: Crack) -> tuple[Points, NDArray[np.int32]]:
    """Vertices and edges of the segments; those of a period may reach beyond it."""
    if found.period is None:
        return found.graph.vertices, found.graph.edges
    ends = found.segments.reshape(-1, 2)
    return ends, np.arange(len(ends), dtype=np.int32).reshape(-1, 2)


_MODES: dict[str, Callable[[Diagram, dict[str, Any], frozenset[str]], Drawing]] = {
    "skeleton": _skeleton,
    "compare": _compare,
    "maze": _maze,
    "crack": _crack,
}
MODES = tuple(_MODES)
