"""Where a command takes its samples from: a picture, a drawing or points."""

from __future__ import annotations

import io
from pathlib import Path
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing import outline
from crazing.edit import exchange
from crazing.images import read_image
from crazing.polygons import parsed
from crazing.region import Region, as_region

#: Most bytes of a file that is read.
MOST = 1 << 30
#: Samples of the outline of a polygon if nothing else is said.
POLYGON = 1000


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
    content = content_of(source)
    if exchange.is_picture(content):
        levels = level if len(level) > 1 else level[0]
        return crazing.sample.from_image(_pixels(content, source), level=levels, n=n, spacing=spacing), 1.0
    if exchange.is_foreign_svg(content):
        return outline.spread(outline.svg_lines(content), n, spacing), None
    if exchange.is_polygon(content):
        # Corners alone say little of a shape.
        n = POLYGON if n is None and spacing is None else n
        return crazing.sample.from_polygon(_geojson(content, source), n=n, spacing=spacing), None
    if n is not None or spacing is not None:
        raise click.UsageError(f"{source} holds points, which are taken as they are, without --points and --spacing.")
    points = exchange.load(content)
    if not len(points):
        raise click.ClickException(f"{source} holds no points.")
    return points, None


def content_of(source: str) -> bytes:
    """What a file holds, if it is no more than can be wanted: some files have no end."""
    with Path(source).open("rb") as file:
        content = file.read(MOST + 1)
    if len(content) > MOST:
        raise click.ClickException(f"{source} holds more than {MOST} bytes.")
    return content


def region_of(source: str) -> Region:
    """The shape in a picture, a drawing or GeoJSON."""
    content = content_of(source)
    if exchange.is_foreign_svg(content):
        lines = outline.svg_lines(content)
        return as_region([line for line, closed in zip(lines.lines, lines.closed, strict=True) if closed], source)
    if exchange.is_geojson(content):
        return as_region(_geojson(content, source), source)
    return as_region(_pixels(content, source), source)


# What was read is not read again: a pipe gives it once.
def _pixels(content: bytes, source: str) -> NDArray[Any]:
    file = io.BytesIO(content)
    file.name = source
    return read_image(file)


def _geojson(content: bytes, source: str) -> Any:
    return parsed(content.decode("utf-8-sig"), source)
