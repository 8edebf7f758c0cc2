"""`crazing texture`: a crack texture from a seed."""

from __future__ import annotations

import json
import re
import secrets
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing import _core, arguments
from crazing.cli.maps import Order
from crazing.cli.output import STANDARD, Seed, checked, opened, say
from crazing.cli.progress import steps
from crazing.texture import MAX_SIDE

#: Part of scattered points that the picture shows; by eye, at 100 to 3000 points of either distribution.
FRAMED = 0.9


#: Options that ask for maps instead of the plain picture.
MAPPED = ("preset", "recipe", "material", "seamless", "maps", "format", "layout", "name", "metres", "frames")


def pixels(ctx: click.Context, parameter: click.Parameter, value: str) -> tuple[int, int]:
    """(width, height) in pixels, written as image tools do: `4096`, or `4096x2048`, width first."""
    match = re.fullmatch(r"([1-9][0-9]{0,8})(?:x([1-9][0-9]{0,8}))?", value)
    if match is None:
        raise click.BadParameter(f"{value!r} is no size; 4096 or 4096x2048 (width x height) is wanted.")
    height, width = arguments.size_pair((int(match[2] or match[1]), int(match[1])), limit=MAX_SIDE)
    return width, height


@click.command("texture")
@click.option("--seed", type=Seed(), metavar="N", help="Seed, 0 or more; by default a fresh one, kept in the file.")
@click.option(
    "--size",
    callback=pixels,
    default="1024",
    metavar="PIXELS",
    show_default=True,
    help="4096, or 4096x2048: width x height.",
)
@click.option(
    "--sites",
    type=click.IntRange(min=3),
    default=300,
    metavar="N",
    help="Number of plates between the cracks, at least 3; by default 300, or as in the preset or recipe.",
)
@click.option(
    "--distribution",
    type=click.Choice(["uniform", "normal", "laplace"]),
    default="uniform",
    help="How the plates are spread: evenly, or many small ones in the middle, as around an impact; by default "
    "uniform, or as in the preset or recipe.",
)
@click.option(
    "--width",
    type=float,
    metavar="W",
    help="Width of the longest crack, as a part of the picture's height; by default it follows the plates.",
)
@click.option(
    "--opening",
    type=float,
    metavar="X",
    help="1 closes no plate by cracks all round, 0 every plate; by default 1, or as in the preset or recipe.",
)
@click.option("--preset", metavar="NAME", help="Kind of crack, with its material; crazing presets lists them.")
@click.option("--recipe", type=click.Path(exists=True, dir_okay=False), metavar="TOML", help="The same from a file.")
@click.option("--material", metavar="NAME", help="Profile and colours of another preset.")
@click.option("--seamless", is_flag=True, help="Opposite sides fit together.")
@click.option(
    "--maps",
    metavar="A,B",
    help="Maps to make: color, normal (or normal_gl, normal_dx), height, ao, roughness, orm, mask, wear, distance, "
    "direction, cell, strand, generation; or all.",
)
@click.option("--format", metavar="NAME", help="png, png8, png16, tiff16, tiff32, exr16, exr32 or zarr.")
@click.option("--layout", metavar="NAME", help="Names of files in a folder: plain, ambientcg, polyhaven or unreal.")
@click.option("--name", metavar="NAME", help="Name of the material; by default that of the preset or recipe.")
@click.option("--metres", type=float, metavar="M", help="True height of the picture; by default 1.")
@click.option("--frames", type=click.IntRange(1, 100_000), metavar="N", help="The cracks as they grow, in N pictures.")
@click.option("--threads", type=click.IntRange(1, 1024), metavar="N", help="Threads that draw; all cores by default.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@click.option(
    "-o", "--output", required=True, metavar="PATH", help="A PNG, or a file or folder for maps; - is standard output."
)
@click.pass_context
def command(ctx: click.Context, /, *, as_json: bool, output: str, **given: Any) -> None:
    """Draws a crack texture: a plain picture, or the maps of a material.

    Example: crazing texture --seed 7 --size 4096 -o crack.png

    Example: crazing texture --preset glaze --size 8192 --seamless --maps all -o glaze/

    The first draws ink on paper. Any of --preset, --recipe, --material, --seamless, --maps, --format, --layout,
    --name, --metres and --frames makes maps: one, by default the colour, where PATH ends in .png, .tif, .exr or
    .zarr, else several in a folder. Maps may have any size; when a run with --seed is stopped, the same command goes
    on with it.

    The same seed and options give the same pixels, on every machine and with any number of threads. They are kept in
    every file, and crazing rerun makes it again.
    """
    if given["seed"] is None:
        given["seed"] = secrets.randbits(32)
    # A number may be 0, which is equal to False.
    if any(given[name] is not None and given[name] is not False for name in MAPPED):
        report = _order(ctx, output, given).make()
        files = report["files"]
        words = f"{files[0]}{f' and {len(files) - 1} more' if len(files) > 1 else ''}: {_sizes(report)}"
    else:
        _plain(ctx, output)
        report = _picture(output, given)
        words = f"{output}: {_sizes(report)}"
    say(json.dumps(report) if as_json else words, output)


def _plain(ctx: click.Context, output: str) -> None:
    """Refuses what is no PNG, with a word about what makes other files."""
    ending = Path(output).suffix.lower()
    if output != STANDARD and ending != ".png":
        wanted = "the plain picture is a PNG; --maps color, or --preset, makes maps: a folder, .tif, .exr or .zarr."
        raise click.UsageError(f"{output!r} does not end in .png: {wanted}", ctx)
    checked(ctx, ctx.command.params[-1], output)


def _sizes(report: dict[str, Any]) -> str:
    (width, height), edges = report["parameters"]["size"], report["edges"]
    seed = report["parameters"]["seed"]
    return f"{width} x {height} pixels, {edges} crack edge{'s' * (edges != 1)}, seed {seed}"


def _order(ctx: click.Context, output: str, given: dict[str, Any]) -> Order:
    """The order for maps; what the plain picture has defaults for counts only where it was given."""
    if given["preset"] is not None and given["recipe"] is not None:
        raise click.UsageError("--preset and --recipe are both given; one of them is wanted.", ctx)
    if output == STANDARD:
        raise click.UsageError("maps go to a file or folder, not to standard output.", ctx)
    fields = {"sites": "n", "distribution": "sampler", "opening": "opening"}
    set_by = click.core.ParameterSource.DEFAULT
    changes = {
        field: given[option]
        for option, field in fields.items()
        if ctx.get_parameter_source(option) is not set_by and given[option] is not None
    }
    kept = {name: value for name, value in given.items() if name not in fields}
    kept["layout"] = "plain" if kept["layout"] is None else kept["layout"]
    kept["metres"] = 1.0 if kept["metres"] is None else kept["metres"]
    return Order(output=output, changes=changes, **kept)


def _picture(output: str, given: dict[str, Any]) -> dict[str, Any]:
    """The plain picture; a report of it."""
    threads = given["threads"]
    parameters = {name: value for name, value in given.items() if name not in (*MAPPED, "threads")}
    record = {
        "algorithm_version": crazing.algorithm_version,
        "version": _core.__version__,
        "command": "texture",
        "parameters": parameters,
    }
    with steps(3) as begin:
        begin("cracking")
        crack = _crack(**parameters)
        begin("drawing")
        width, height = parameters["size"]
        picture = crazing.render(crack, (height, width), threads=threads)
        begin("writing")
        with opened(output) as file:
            crazing.save_png(file, picture, text={"crazing": json.dumps(record)})
    return {**record, "output": output, "edges": len(crack.graph.edges)}


def draw(*, threads: int | None, **parameters: Any) -> NDArray[np.uint8]:
    """The pixels of the plain picture of these parameters."""
    width, height = parameters["size"]
    return crazing.render(_crack(**parameters), (height, width), threads=threads)


def _crack(*, seed: int, size: tuple[int, int], sites: int, distribution: str, **steps_of_crack: Any) -> crazing.Crack:
    rng = np.random.default_rng(seed)
    aspect = size[0] / size[1]
    if distribution == "uniform":
        bounds = (0.0, 0.0, aspect, 1.0)
        points = crazing.sample.uniform(sites, bounds=bounds, rng=rng)
    else:
        points, bounds = _framed(getattr(crazing.sample, distribution)(sites, rng=rng), aspect)
    given = {name: value for name, value in steps_of_crack.items() if value is not None}
    return crazing.crack(points, bounds=bounds, rng=rng, **given)


def _framed(
    points: NDArray[np.float64], aspect: float
) -> tuple[NDArray[np.float64], tuple[float, float, float, float]]:
    """The points scaled so that a frame of height 1, with their source in its middle, holds most of them; the frame.

    Both coordinates are scaled alike: these distributions are known by their shape. The farthest points stay outside:
    a frame that held them all would be empty but for its middle.
    """
    frame = np.array([aspect, 1.0])
    reach = np.sort(np.abs(2 * points / frame).max(axis=1))
    scale = float(reach[int(FRAMED * (len(reach) - 1))]) or 1.0
    return points / scale + frame / 2, (0.0, 0.0, aspect, 1.0)
