"""Where a command takes its samples from: a picture, a drawing or points."""

from __future__ import annotations

from pathlib import Path

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing.edit import exchange
from crazing.images import read_image


def level_option(function: click.decorators.FC) -> click.decorators.FC:
    """Adds what says where the contours of a picture run."""
    return click.option(
        "--level",
        type=float,
        metavar="Z",
        multiple=True,
        default=(0.5,),
        show_default=True,
        help="Brightness where the contour runs, from 0 black to 1 white; may be given several times.",
    )(function)


def samples(
    source: str, n: int | None, spacing: float | None, level: tuple[float, ...]
) -> tuple[NDArray[np.float64], float | None]:
    """The samples, and how high the steps are that their making left in them, if that is known."""
    if n is not None and spacing is not None:
        raise click.UsageError("--points and --spacing exclude one another.")
    content = Path(source).read_bytes()
    if exchange.is_picture(content):
        levels = level if len(level) > 1 else level[0]
        return crazing.sample.from_image(read_image(source), level=levels, n=n, spacing=spacing), 1.0
    if exchange.is_foreign_svg(content):
        return crazing.sample.from_svg(source, n=n, spacing=spacing), None
    if n is not None or spacing is not None:
        raise click.UsageError(f"{source} holds points, which are taken as they are, without --points and --spacing.")
    return exchange.load(content), None
