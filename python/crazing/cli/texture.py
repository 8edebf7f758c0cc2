"""`crazing texture`: a crack texture from a seed."""

from __future__ import annotations

import json
import re
import secrets
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing import _core, arguments
from crazing.cli.output import opened, output_option, say
from crazing.cli.progress import steps

#: Part of scattered points that the picture shows; by eye, at 100 to 3000 points of either distribution.
FRAMED = 0.9


def _size(ctx: click.Context, parameter: click.Parameter, value: str) -> tuple[int, int]:
    """(width, height) in pixels, written as image tools do: `4096`, or `4096x2048`, width first."""
    match = re.fullmatch(r"([1-9][0-9]{0,8})(?:x([1-9][0-9]{0,8}))?", value)
    if match is None:
        raise click.BadParameter(f"{value!r} is no size; 4096 or 4096x2048 (width x height) is wanted.")
    height, width = arguments.size_pair((int(match[2] or match[1]), int(match[1])))
    return width, height


@click.command("texture")
@click.option(
    "--seed", type=click.IntRange(min=0), metavar="N", help="Seed, 0 or more; by default a fresh one, kept in the file."
)
@click.option(
    "--size",
    callback=_size,
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
    show_default=True,
    help="Number of plates between the cracks, at least 3.",
)
@click.option(
    "--distribution",
    type=click.Choice(["uniform", "normal", "laplace"]),
    default="uniform",
    show_default=True,
    help="How the plates are spread: evenly, or many small ones in the middle, as around an impact.",
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
    help="1, the default, closes no plate by cracks all round, 0 every plate.",
)
@click.option("--threads", type=click.IntRange(1, 1024), metavar="N", help="Threads that draw; all cores by default.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@output_option
def command(*, threads: int | None, as_json: bool, output: str, **parameters: Any) -> None:
    """Draws a crack texture.

    Example: crazing texture --seed 7 --size 4096 -o crack.png

    The same seed and options give the same picture, on every machine and with any number of threads. They are
    kept in the file, in a text chunk named "crazing".
    """
    if parameters["seed"] is None:
        parameters["seed"] = secrets.randbits(32)
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
    edges = len(crack.graph.edges)
    if as_json:
        say(json.dumps({**record, "output": output, "edges": edges}), output)
    else:
        say(
            f"{output}: {width} x {height} pixels, {edges} crack edge{'s' * (edges != 1)}, seed {parameters['seed']}",
            output,
        )


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
