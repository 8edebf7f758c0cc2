"""`crazing compare`: two skeleton methods on the contour of a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

import crazing
from crazing.cli.output import opened, output_option, say
from crazing.cli.progress import steps
from crazing.extras import require
from crazing.images import read_image
from crazing.panels import row

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: More than a figure can show, and few enough for any machine.
MOST_POINTS = 1_000_000


@click.command("compare")
@click.argument("image", type=click.Path(exists=True, dir_okay=False))
@click.option(
    "--points",
    type=click.IntRange(3, MOST_POINTS),
    metavar="N",
    help="Samples along the contour; by default its own points, about one a pixel.",
)
@click.option(
    "--level",
    type=float,
    metavar="Z",
    multiple=True,
    default=(0.5,),
    show_default=True,
    help="Brightness where the contour runs, from 0 black to 1 white; may be given several times.",
)
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
@output_option
def command(
    *,
    image: str,
    points: int | None,
    level: tuple[float, ...],
    first: str,
    second: str,
    dpi: int,
    output: str,
) -> None:
    """Compares two skeleton methods on the contour of IMAGE.

    Writes a figure: the first skeleton, the second, and both over one another. Prints a table of their sizes.
    METHOD is initial, edge-filter or one-step. A contour that runs off the picture ends there.

    Example: crazing compare leaf.png --points 600 -o figure.png
    """
    # A missing package is better known before the work than after it.
    require("matplotlib.figure", "plot")
    with steps(4) as begin:
        begin("reading")
        samples = crazing.sample.from_image(read_image(image), level=level if len(level) > 1 else level[0], n=points)
        begin("comparing")
        comparison = crazing.compare(samples, first, second)
        begin("drawing")
        figure = _figure(comparison)
        begin("writing")
        with opened(output) as file:
            figure.savefig(file, format="png", dpi=dpi)
    say(str(comparison), output)


def _figure(comparison: crazing.Comparison) -> Figure:
    """Not one of pyplot, whose figures outlive their use."""
    panels = row(comparison, require("matplotlib.figure", "plot").Figure)
    figure: Figure = comparison.plot(panels)[0].figure
    return figure
