"""Rock traces of a GeoJSON file, as fractopo reads them, measured by `crazing.measure`: I, Y and X nodes.

Give the traces (lines) and, with `--area`, the polygons they were mapped in: traces are cut there, and what is cut has
an end on the outline, which is no I node (E of fractopo). Ends and crossings nearer than `--snap` become one. Without a
file traces of ours are taken, whose nodes are known.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

import numpy as np
import shapely
import shapely.geometry

import crazing as cz

#: Data units; that of fractopo.
SNAP = 0.001


def geometries(path: Path) -> list[Any]:
    """What is drawn by a file, as single parts."""
    table = json.loads(path.read_text(encoding="utf-8"))
    shapes = [shapely.geometry.shape(feature["geometry"]) for feature in table["features"] if feature["geometry"]]
    return list(shapely.get_parts(shapes)) if shapes else []


def snapped(traces: list[Any], snap: float) -> list[Any]:
    """Traces whose ends lie on the others they come near to: there the others have a corner too."""
    coords = [shapely.get_coordinates(trace) for trace in traces]
    tree = shapely.STRtree(traces)
    corners: dict[int, list[tuple[float, float, float]]] = {}
    for row, line in enumerate(coords):
        for end in (0, -1):
            tip = shapely.Point(line[end])
            near = [other for other in tree.query(tip, predicate="dwithin", distance=snap) if other != row]
            if not near:
                continue
            other = min(near, key=lambda each: (traces[each].distance(tip), each))
            along = traces[other].project(tip)
            place = traces[other].interpolate(along)
            line[end] = place.x, place.y
            corners.setdefault(int(other), []).append((along, place.x, place.y))
    for row, more in corners.items():
        line = coords[row]
        runs = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
        places = np.array(more)
        order = np.argsort(np.concatenate([runs, places[:, 0]]), kind="stable")
        coords[row] = np.concatenate([line, places[:, 1:]])[order]
    return [shapely.LineString(line) for line in coords]


def graph(traces: list[Any], area: Any, snap: float = SNAP) -> tuple[cz.PlanarGraph, int]:
    """Traces as a drawing, cut to an area, and the number of ends on its outline."""
    whole = shapely.union_all(snapped(traces, snap))
    if area is not None:
        whole = shapely.intersection(whole, area)
    parts = [part for part in shapely.get_parts(whole) if part.geom_type == "LineString" and part.length > 0]
    pairs = [np.stack([line[:-1], line[1:]], axis=1) for line in map(shapely.get_coordinates, parts)]
    ends = np.concatenate(pairs).reshape(-1, 2) if pairs else np.zeros((0, 2))
    # Places nearer than the tolerance are one: where traces meet they differ by roundings.
    places, rows = np.unique(np.rint(ends / snap).astype(np.int64), axis=0, return_inverse=True)
    edges = np.unique(np.sort(rows.reshape(-1, 2), axis=1), axis=0)
    found = cz.PlanarGraph(places * snap, edges[edges[:, 0] != edges[:, 1]])
    if area is None:
        return found, 0
    tips = shapely.points(found.vertices[found.degrees == 1])
    return found, int((shapely.distance(tips, area.boundary) <= 2 * snap).sum())


def counts(found: cz.PlanarGraph, cut: int) -> dict[str, int]:
    """Nodes by kind, from what `measure` says."""
    measured = cz.measure(found)
    kinds = {"I": measured.i_nodes, "Y": measured.y_nodes, "X": measured.x_nodes}
    nodes = {kind: round(share * measured.nodes) if measured.nodes else 0 for kind, share in kinds.items()}
    return {**nodes, "I": nodes["I"] - cut, "E": cut}


def own_traces() -> tuple[list[Any], Any]:
    """Two crossing lines, a third that ends just short of one of them, a fourth that leaves the area."""
    lines = [((0, 0), (10, 0)), ((3, -4), (3, 4)), ((7, 5), (7, SNAP / 2)), ((8, 2), (14, 2))]
    return [shapely.LineString(line) for line in lines], shapely.box(-1, -5, 12, 6)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("traces", nargs="?", type=Path)
    parser.add_argument("--area", type=Path)
    parser.add_argument("--snap", type=float, default=SNAP)
    parser.add_argument("--small", action="store_true", help="accepted as by all scripts; traces of ours are small")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the counts into this folder")
    arguments = parser.parse_args()
    lines, area = own_traces()
    if arguments.traces is not None:
        lines, area = geometries(arguments.traces), None
    if arguments.area is not None:
        area = shapely.union_all(geometries(arguments.area))
    found, cut = graph(lines, area, arguments.snap)
    nodes = counts(found, cut)
    text = "\n".join([" ".join(f"{kind} {count}" for kind, count in nodes.items()), str(cz.measure(found))])
    print(text)
    if arguments.folder is not None:
        arguments.folder.mkdir(parents=True, exist_ok=True)
        (arguments.folder / "traces.txt").write_text(text + "\n")


if __name__ == "__main__":
    main()
