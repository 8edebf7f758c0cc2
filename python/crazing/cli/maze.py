"""`crazing maze`: a maze on a page, within the shape of a picture or a rectangle."""

from __future__ import annotations

import json
import secrets
from dataclasses import asdict
from typing import Any

import click
import numpy as np

import crazing
from crazing import arguments
from crazing.cli.output import Seed, ending_in
from crazing.cli.progress import steps
from crazing.cli.source import region_of

ENDINGS = (".svg", ".dxf", ".pdf", ".png")


@click.command("maze")
@click.option(
    "-n",
    "--cells-number",
    "n",
    type=click.IntRange(min=3),
    default=1000,
    show_default=True,
    help="Cells; about so many within a shape.",
)
@click.option(
    "--within", type=click.Path(exists=True, dir_okay=False), help="Shape to fill: a picture, SVG or GeoJSON."
)
@click.option(
    "--cells",
    type=click.Choice(["voronoi", "delaunay"]),
    default="voronoi",
    show_default=True,
    help="What a cell is.",
)
@click.option(
    "--tree",
    type=click.Choice(["depth-first", "kruskal", "prim", "wilson"]),
    default="depth-first",
    show_default=True,
    help="How the ways grow.",
)
@click.option(
    "--opening",
    type=click.FloatRange(0, 1),
    default=1.0,
    show_default=True,
    help="Share of the doors really opened; below 1 some cells cannot be reached.",
)
@click.option("--solution", is_flag=True, help="Draw the solution too, as a layer of its own.")
@click.option("--distances", is_flag=True, help="Colour the cells by their distance from the start; not in .dxf.")
@click.option("--seed", type=Seed(), help="Seed; by default a fresh one, which is printed.")
@click.option("--page", type=float, nargs=2, default=(210.0, 297.0), show_default=True, help="Width, height in mm.")
@click.option("--margin", type=float, default=10.0, show_default=True, help="Kept free on all sides, mm.")
@click.option("--pen", type=float, default=0.5, show_default=True, help="Width of the lines, mm.")
@click.option("--thickness", type=float, help="Thickness of the walls in mm, drawn as outlines.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@click.option(
    "-o", "--output", required=True, metavar="FILE", callback=ending_in(*ENDINGS), help="An .svg, .dxf, .pdf or .png."
)
def command(
    *, output: str, solution: bool, distances: bool, seed: int | None, as_json: bool, **parameters: Any
) -> None:
    """Draws a maze on a page, in millimetres.

    Entrance and exit are the two places of the outline, of the page or the shape, that lie farthest apart.
    """
    if distances and output.lower().endswith(".dxf"):
        raise click.BadParameter("--distances are colours, which a .dxf has not.")
    seed = secrets.randbits(32) if seed is None else seed
    paper = {name: parameters.pop(name) for name in ("page", "margin", "pen", "thickness")}
    with steps(2) as begin:
        begin("carving")
        maze = _maze(seed=seed, page=paper["page"], **parameters)
        begin("writing")
        maze.save(output, solution=solution, distances=distances, **paper)
    found = maze.statistics
    way = f"solution {found.solution} cells, winding {found.winding:.1f}" if found.solution else "no solution"
    words = (
        f"{output}: {found.cells} cells, {found.dead_ends} dead ends, {found.junctions} junctions, {way}, seed {seed}"
    )
    click.echo(json.dumps({"output": output, "seed": seed, **asdict(found)}) if as_json else words)


def _maze(*, n: int, within: str | None, cells: str, seed: int, page: tuple[float, float], **how: Any) -> crazing.Maze:
    rng = np.random.default_rng(seed)
    # There are two triangles a point.
    count = n if cells == "voronoi" else max(3, n // 2)
    if within is None:
        width, height = arguments.period_pair(page, "page")
        points = crazing.sample.uniform(count, bounds=(0, 0, width, height), rng=rng)
        # The page is the shape: its sides are walls, and no way leads through a door that lies beyond them.
        sheet = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)]
        return crazing.maze(points, cells=cells, **how, within=sheet, rng=rng)
    region = region_of(within)
    # As many points as leave about `count` in the shape.
    probe = crazing.sample.uniform(4096, bounds=region.bounds, rng=rng)
    share = max(float(region.contains(probe).mean()), 1e-3)
    points = crazing.sample.uniform(int(count / share), bounds=region.bounds, rng=rng)
    if cells == "delaunay":
        points = points[region.contains(points)]
    return crazing.maze(points, cells=cells, **how, within=region, rng=rng)
