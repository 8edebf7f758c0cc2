"""`crazing compare`: two skeleton methods on the contour of a picture."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

import crazing
from crazing.cli.output import opened, output_option, say
from crazing.cli.progress import steps
from crazing.extras import require
from crazing.images import read_image

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Width of the figure in inches: three panels across a page of two columns, readable at half its size.
INCHES = 13.0


@click.command("compare")
@click.argument("image", type=click.Path(exists=True, dir_okay=False))
@click.option("--points", type=click.IntRange(min=3), help="Samples along the contour; its own points by default.")
@click.option(
    "--level",
    type=float,
    multiple=True,
    default=(0.5,),
    show_default=True,
    help="Brightness where the contour runs, from 0 black to 1 white; may be given several times.",
)
@click.option("--first", default="one-step", show_default=True, metavar="METHOD", help="The one method.")
@click.option("--second", default="edge-filter", show_default=True, metavar="METHOD", help="The other method.")
@click.option("--dpi", type=click.IntRange(20, 1200), default=200, show_default=True, help="Pixels an inch; 13 across.")
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
    METHOD is initial, edge-filter or one-step.
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
    """A figure as high as the panels need; not one of pyplot, whose figures outlive their use."""
    width, height = comparison.first.diagram.sites.max(axis=0) - comparison.first.diagram.sites.min(axis=0)
    # Titles and legends take most of an inch.
    inches = 0.8 + INCHES / 3 * min(max(height / width, 0.2), 2.0)
    figure: Figure = require("matplotlib.figure", "plot").Figure(figsize=(INCHES, inches), layout="constrained")
    comparison.plot(figure.subplots(1, 3))
    return figure
