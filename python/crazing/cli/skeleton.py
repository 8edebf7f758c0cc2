"""`crazing skeleton`: the skeleton, crust or centreline of a picture, a drawing or points, as a file."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing.cli.output import ending_in, seed_without_use
from crazing.cli.progress import steps
from crazing.cli.source import level_option, samples
from crazing.pruning import RESIDUAL

VECTORS = (".svg", ".dxf", ".geojson")

#: What of the skeleton is written.
PARTS: dict[str, Callable[[crazing.Skeleton], crazing.PlanarGraph]] = {
    "inner": lambda skeleton: skeleton.inner,
    "main": lambda skeleton: skeleton.main,
    "axis": lambda skeleton: _near(skeleton),
    "crust": lambda skeleton: skeleton.crust,
}

#: How far from the samples the outer axis is written, in parts of their extent.
MARGIN = 0.1


@click.command("skeleton")
@click.argument("source", type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--method",
    type=click.Choice(["initial", "poles", "edge-filter", "one-step"]),
    default="one-step",
    show_default=True,
    help="How the axis is found.",
)
@click.option("--part", type=click.Choice([*PARTS]), default="inner", show_default=True, help="What is written.")
@click.option("--points", type=click.IntRange(min=3), metavar="N", help="Samples along all contours together.")
@click.option("--spacing", type=float, metavar="D", help="Distance between samples instead.")
@level_option
@click.option("--hairs", is_flag=True, help="Leave the axis as it is found; by default its hairs are pruned.")
@click.option(
    "--height",
    type=click.FloatRange(min=0),
    metavar="H",
    help="Prune what shows bumps lower than H; by default 1 for pictures, whose steps are a pixel high, and else as "
    "high as the noise found in the samples.",
)
@click.option(
    "--size", type=click.IntRange(1, 16384), default=1024, show_default=True, metavar="PX", help="Side of a .png."
)
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@seed_without_use
@click.option(
    "-o",
    "--output",
    required=True,
    metavar="FILE",
    callback=ending_in(*VECTORS, ".png"),
    help="An .svg, .dxf, .geojson or .png.",
)
def command(*, source: str, part: str, output: str, size: int, as_json: bool, **given: Any) -> None:
    """Finds the skeleton of SOURCE: a picture, an SVG drawing, a polygon, or points.

    Pictures, drawings and polygons (GeoJSON) are sampled along their contours. Points come as CSV (two columns, or
    those named x and y), NPY or GeoJSON, and are taken as they are. Coordinates are pixels, or the units of the drawing
    or the points, with y up.

    The parts: inner, the axis inside closed curves; main, its longest path, a centreline; axis, the axis on both sides
    as far as the samples reach; crust, the curve through the samples.

    Example: crazing skeleton leaf.png --part main -o midrib.svg
    """
    with steps(3) as begin:
        begin("reading")
        points, grain = samples(source, given["points"], given["spacing"], given["level"])
        height = grain if given["height"] is None else given["height"]
        begin("tracing")
        found = PARTS[part](_skeleton(points, given["method"], given["hairs"], height)).compact()
        begin("writing")
        _write(found, output, size)
    report = {
        "output": output,
        "samples": len(points),
        "method": given["method"],
        "part": part,
        "edges": len(found.edges),
        "length": found.length,
        "components": found.components,
        "leaves": found.leaves,
    }
    words = (
        f"{output}: {part} by {given['method']} of {len(points)} samples, {len(found.edges)} edges, "
        f"length {found.length:.6g}, {found.components} pieces, {found.leaves} free ends"
    )
    click.echo(json.dumps(report) if as_json else words)


def _skeleton(points: NDArray[np.float64], method: str, hairs: bool, height: float | None) -> crazing.Skeleton:
    skeleton = crazing.medial_axis(points, method=method)
    if hairs or skeleton.axis_mask is None:
        return skeleton
    return skeleton.prune() if height is None else skeleton.prune(residual=RESIDUAL, height=height)


def _near(skeleton: crazing.Skeleton) -> crazing.PlanarGraph:
    """The axis without the edges that lead far off, where the samples say nothing of it."""
    sites, axis = skeleton.diagram.sites, skeleton.axis
    low, high = sites.min(axis=0), sites.max(axis=0)
    reach = MARGIN * (high - low).max()
    inside = ((axis.vertices >= low - reach) & (axis.vertices <= high + reach)).all(axis=1)
    return crazing.PlanarGraph(axis.vertices, axis.edges[inside[axis.edges].all(axis=1)])


def _write(graph: crazing.PlanarGraph, output: str, size: int) -> None:
    if Path(output).suffix.lower() in VECTORS:
        graph.save(output)
    else:
        crazing.save_png(output, crazing.render(graph, size))
