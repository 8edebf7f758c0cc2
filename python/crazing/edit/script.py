"""The few lines of Python that make what the page shows, without the page."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.edit import cracks, samples

#: Coordinates a line of a literal array.
_ROW = 3


def script(
    points: NDArray[np.float64],
    mode: str,
    values: dict[str, Any],
    source: dict[str, Any] | None = None,
    light: cracks.Light | None = None,
) -> str:
    """Python that gives the same arrays as the page shows.

    Parameters
    ----------
    points : (n, 2) float64
        What is on the page.
    mode : {"skeleton", "compare", "maze", "crack"}
        The panel.
    values : dict
        The values of its knobs, checked.
    source : dict, optional
        Sampler, n and seed that gave the points; used if they give them indeed.
    light : (right, up, out)
        Where the lamp over a crack is; where the page has it first, by default.

    Returns
    -------
    str
        A script. Every layer is a variable of its name, with `-` for `_`.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.edit import knobs
    >>> from crazing.edit.script import script
    >>> print(script(np.array([[0.0, 0.5]]), "crack", knobs.defaults()["crack"]))
    import crazing as cz
    <BLANKLINE>
    points = [
        (0.0, 0.5),
    ]
    ...
    """
    body = cracks.lines(values, points, light or cracks.light(None)) if mode == "crack" else _MODES[mode](values)
    names = ["import crazing as cz"]
    if values.get("cells") == "in the curve":
        names = [
            "from itertools import pairwise\n",
            "import numpy as np\n",
            *names,
            "from crazing.region import as_region",
        ]
    placed = [] if mode == "crack" and cracks.has_own_plates(values) else _points(points, source)
    return "\n".join([*names, "", *placed, *body, ""])


def _points(points: NDArray[np.float64], source: dict[str, Any] | None) -> list[str]:
    if source is not None:
        text = samples.source_text(**source)
        if text is not None and np.array_equal(samples.points_of(**source), points):
            return [f"points = {text}"]
    pairs = [f"({x!r}, {y!r})" for x, y in points.tolist()]
    rows = [", ".join(pairs[i : i + _ROW]) for i in range(0, len(pairs), _ROW)]
    return ["points = [", *(f"    {row}," for row in rows), "]"]


def _skeleton(values: dict[str, Any]) -> list[str]:
    lines = ["d = cz.diagram(points)"]
    if values["delaunay"]:
        lines.append("delaunay = d.delaunay")
    if values["voronoi"]:
        lines.append("voronoi = d.voronoi()")
    method = values["axis_method"]
    if values["nested"]:
        shown = method if values["axis"] else "edge-filter"
        lines.append(
            f"nested = [s.axis for s in cz.nested(points, iterations={values['iterations']}, method={shown!r})]"
        )
    if values["axis"]:
        prunes = values["prune"] and method in ("edge-filter", "one-step")
        pruned = f".prune({values['residual']!r})" if prunes else ""
        lines.append(f"axis = cz.medial_axis(d, method={method!r}){pruned}.axis")
    if values["crust"]:
        lines.append(f"crust = cz.crust(d, method={values['crust_method']!r})")
    if values["curve"]:
        lines.append("curve = cz.curve(d)")
    if values["poles"]:
        lines += ["rows = cz.poles(d)", "poles = d.vertices[sorted({int(row) for row in rows.flat if row >= 0})]"]
    return lines


def _compare(values: dict[str, Any]) -> list[str]:
    return [
        f"comparison = cz.compare(points, {values['first']!r}, {values['second']!r})",
        "print(comparison)",
        "crust_first, crust_second = comparison.first.crust, comparison.second.crust",
        "axis_first, axis_second = comparison.first.axis, comparison.second.axis",
        "shared, only_first, only_second = comparison.shared, comparison.only_first, comparison.only_second",
    ]


def _maze(values: dict[str, Any]) -> list[str]:
    options = f"tree={values['tree']!r}, opening={values['opening']!r}, rng={values['seed']}"
    if values["cells"] == "in the curve":
        lines = [
            "coords, offsets = cz.curve(points).polylines()",
            "lines = [coords[start:end] for start, end in pairwise(offsets.tolist())]",
            "rings = [line for line in lines if len(line) > 3 and (line[0] == line[-1]).all()]",
            "low, high = (end([end(ring, axis=0) for ring in rings], axis=0).tolist() for end in (np.min, np.max))",
            f"cells = cz.sample.uniform({values['fill']}, bounds=(*low, *high), rng={values['seed']})",
            f"maze = cz.maze(cells[as_region(rings).contains(cells)], within=rings, {options})",
        ]
    else:
        lines = [f"maze = cz.maze(points, cells={values['cells']!r}, {options})"]
    lines.append("walls = maze.walls")
    if values["solution"]:
        lines.append("solution = maze.path(maze.solve(*maze.ends)) if maze.ends else None")
    return lines


_MODES = {"skeleton": _skeleton, "compare": _compare, "maze": _maze}
