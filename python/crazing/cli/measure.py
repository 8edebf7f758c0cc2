"""`crazing measure`: the statistics of a crack mask."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any

import click
import numpy as np
from numpy.typing import NDArray

import crazing
from crazing.cli.output import ending_in, seed_without_use
from crazing.cli.progress import steps
from crazing.files import atomic_write
from crazing.images import read_image
from crazing.measure import as_mask
from crazing.targets import Targets

#: From so many pieces on, and with so few junctions a piece, lines are taken to have fallen apart.
_MANY, _JOINED = 20, 0.25
#: From this part of every side on, a picture is taken to have a frame.
_FRAMED = 0.95


def mask_options(function: click.decorators.FC) -> click.decorators.FC:
    """Adds what says which pixels are crack."""
    words = "Brightness above which there is crack, from 0 black to 1 white."
    function = click.option("--dark", is_flag=True, help="Cracks are dark on bright ground.")(function)
    return click.option(
        "--level", type=click.FloatRange(0, 1), default=0.5, show_default=True, metavar="Z", help=words
    )(function)


def doubt(mask: NDArray[np.bool_], name: str, *, level: float, dark: bool) -> str | None:
    """What makes it unlikely that the right pixels are taken for crack, if anything does."""
    share = float(mask.mean())
    if share == 0.0:
        side = "at or below" if dark else "above"
        return f"{name} has no pixel {side} level {level:g}: no crack. See --level and --dark."
    if share == 1.0:
        return f"100% of {name} is taken for crack. See --level and --dark."
    if share > 0.5:
        other = "without --dark, what is bright" if dark else "with --dark, what is dark"
        return f"{share:.0%} of {name} is taken for crack; {other} would be."
    return None


def note_frame(mask: NDArray[np.bool_], name: str) -> None:
    """Says that a picture has a frame: it closes plates that go on outside, and is as long as several cracks."""
    if all(side.mean() > _FRAMED for side in (mask[0], mask[-1], mask[:, 0], mask[:, -1])):
        click.echo(f"Note: {name} is crack all along its sides: its frame counts as cracks. Cut it off.", err=True)


@click.command("measure")
@click.argument("mask", type=click.Path(exists=True, dir_okay=False))
@mask_options
@click.option("--spur", type=float, default=14.0, show_default=True, metavar="PX", help="Cut off shorter free ends.")
@click.option("--merge", type=float, default=6.0, show_default=True, metavar="PX", help="Unite nearer junctions.")
@click.option("--border", type=float, default=20.0, show_default=True, metavar="PX", help="Leave out nodes this near.")
@click.option("--reach", type=float, default=15.0, show_default=True, metavar="PX", help="Where directions are taken.")
@click.option(
    "--preset",
    metavar="NAME",
    help="Also say how far the mask is from the targets of a preset: in deviations, or what is out of its ranges.",
)
@click.option("--json", "as_json", is_flag=True, help="Print one line of JSON.")
@seed_without_use
@click.option(
    "-o",
    "--output",
    metavar="FILE",
    callback=ending_in(".json", ".csv"),
    help="Also write the statistics to a .json, or to a .csv of names and values.",
)
def command(
    *,
    mask: str,
    level: float,
    dark: bool,
    spur: float,
    merge: float,
    border: float,
    reach: float,
    preset: str | None,
    as_json: bool,
    output: str | None,
) -> None:
    """Measures the crack pattern in MASK, a picture bright where there is crack.

    Prints name, published symbol and value of every statistic: nodes, angles, loops, cells, lines and widths.

    Example: crazing measure mask.png --json
    """
    targets = None if preset is None else crazing.targets(preset)
    with steps(2) as begin:
        begin("reading")
        picture = as_mask(read_image(mask), level=level, dark=dark)
        if words := doubt(picture, mask, level=level, dark=dark):
            click.echo(f"Note: {words}", err=True)
        else:
            note_frame(picture, mask)
        begin("measuring")
        found = crazing.measure(picture, spur=spur, merge=merge, border=border, reach=reach)
    if found.components >= _MANY and found.junctions < _JOINED * found.components:
        words = f"{found.components:.0f} pieces and {found.junctions:.0f} junctions: lines may have fallen apart"
        click.echo(f"Note: {mask} has {words}. See --level.", err=True)
    values = {name: None if math.isnan(value) else value for name, value in found.to_dict().items()}
    report: dict[str, Any] = {"mask": mask, **values}
    if targets is not None:
        report |= {"deviations": found.deviations(targets.measured), "within": targets.within(found)}
    line = json.dumps(report)
    if output is not None:
        _write(output, line, values)
    if as_json:
        click.echo(line)
        return
    click.echo(str(found))
    if targets is not None:
        _compare(found, targets, preset)


def _compare(found: crazing.CrackStatistics, targets: Targets, preset: str | None) -> None:
    """Prints how far a pattern is from the targets of a preset, measured or of ranges."""
    for name, value in found.deviations(targets.measured).items():
        click.echo(f"{name} is {value:+.1f} deviations from {preset}")
    if targets.measured:
        click.echo(f"score {found.score(targets.measured):.2f} against {preset}")
    within = {name: met for name, met in targets.within(found).items() if name in targets.range}
    for name in (name for name, met in within.items() if not met):
        low, high = targets.range[name]
        click.echo(f"{name} is not from {low:g} to {high:g} as for {preset}")
    if within:
        click.echo(f"{sum(within.values())} of {len(within)} in the ranges of {preset}")


def _write(output: str, line: str, values: Mapping[str, float | None]) -> None:
    rows = [f"{name},{'' if value is None else value}" for name, value in values.items()]
    with atomic_write(output) as file:
        file.write((f"{line}\n" if output.lower().endswith(".json") else "\n".join([*rows, ""])).encode())
