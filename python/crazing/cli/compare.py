"""`crazing compare`: two skeleton methods on the contour of a picture."""

from __future__ import annotations

import json
import math
from functools import partial
from typing import TYPE_CHECKING

import click

import crazing
from crazing.cli.output import opened, output_option, say, seed_without_use
from crazing.cli.progress import steps
from crazing.cli.source import level_option
from crazing.extras import require
from crazing.images import read_image
from crazing.panels import row

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: More than a figure can show, and few enough for any machine.
MOST_POINTS = 1_000_000


def _numbers(ctx: click.Context, parameter: click.Parameter, value: str | None) -> list[int] | None:
    if value is None:
        return None
    words = value.split(",")
    if not all(word.strip().isdecimal() and 3 <= int(word) <= MOST_POINTS for word in words):
        raise click.BadParameter(f"{value!r} is no list of numbers from 3 to {MOST_POINTS}, parted by commas.")
    return [int(word) for word in words]


@click.command("compare")
@click.argument("image", type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--points",
    type=click.IntRange(3, MOST_POINTS),
    metavar="N",
    help="Samples along the contour; by default its own points, about one a pixel.",
)
@click.option(
    "--sizes",
    callback=_numbers,
    metavar="N,N,...",
    help="Several numbers of samples instead: a study with a line for each.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the table as JSON, null for infinite.")
@level_option
@click.option("--first", default="one-step", show_default=True, metavar="METHOD", help="The one method.")
@click.option("--second", default="edge-filter", show_default=True, metavar="METHOD", help="The other method.")
@click.option(
    "--dpi",
    type=click.IntRange(20, 1200),
    default=200,
    metavar="N",
    show_default=True,
    help="Pixels an inch; the figure is 13 inches wide.",
)
@seed_without_use
@partial(output_option, required=False)
def command(
    *,
    image: str,
    points: int | None,
    sizes: list[int] | None,
    as_json: bool,
    level: tuple[float, ...],
    first: str,
    second: str,
    dpi: int,
    output: str | None,
) -> None:
    """Compares two skeleton methods on the contour of IMAGE.

    Prints a table of their sizes, distances and times. With -o, writes a figure: the first skeleton, the second, and
    both over one another. METHOD is initial, poles, edge-filter or one-step. A contour that runs off the picture ends
    there.

    Example: crazing compare leaf.png --sizes 192,209,383,1043 -o figure.png
    """
    if sizes is not None and points is not None:
        raise click.UsageError("--points and --sizes exclude one another.")
    if output is not None:
        # A missing package is better known before the work than after it.
        require("matplotlib.figure", "plot")
    with steps(2 if output is None else 4) as begin:
        begin("reading")
        picture, levels = read_image(image), level if len(level) > 1 else level[0]
        begin("comparing")
        found: crazing.Study | crazing.Comparison
        if sizes is None:
            found = crazing.compare(crazing.sample.from_image(picture, level=levels, n=points), first, second)
        else:
            found = crazing.compare_sizes(picture, sizes, first, second, level=levels)
        if output is not None:
            begin("drawing")
            figure = _figure(found) if isinstance(found, crazing.Comparison) else found.plot()
            begin("writing")
            with opened(output) as file:
                figure.savefig(file, format="png", dpi=dpi)
    say(_json(found) if as_json else str(found), output)


def _json(found: crazing.Study | crazing.Comparison) -> str:
    study = found if isinstance(found, crazing.Study) else crazing.Study((found,))
    # JSON has no infinity, the distance from an axis without an edge.
    rows = [{name: None if value == math.inf else value for name, value in row.items()} for row in study.table]
    return json.dumps(rows, indent=1, allow_nan=False)


def _figure(comparison: crazing.Comparison) -> Figure:
    """Not one of pyplot, whose figures outlive their use."""
    panels = row(comparison, require("matplotlib.figure", "plot").Figure)
    figure: Figure = comparison.plot(panels)[0].figure
    return figure
