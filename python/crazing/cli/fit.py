"""`crazing fit`: a recipe from a crack mask."""

from __future__ import annotations

import contextlib
import json
import math
import secrets
from collections.abc import Callable, Iterator
from pathlib import Path

import click

import crazing
from crazing.cli.measure import doubt, mask_options, note_frame
from crazing.cli.output import Seed, ending_in
from crazing.cli.progress import is_watched
from crazing.images import read_image
from crazing.measure import as_mask


@click.command("fit")
@click.argument("mask", type=click.Path(exists=True, dir_okay=False))
@mask_options
@click.option("--budget", type=click.IntRange(0), default=320, show_default=True, help="Recipes to try.")
@click.option("--seconds", type=click.FloatRange(0), help="Most time; the result then depends on the machine.")
@click.option("--seed", type=Seed(), metavar="N", help="Seed; by default a fresh one, which is printed.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@click.option(
    "-o", "--output", required=True, metavar="FILE", callback=ending_in(".toml"), help="Where to write it, a .toml."
)
def command(
    *,
    mask: str,
    level: float,
    dark: bool,
    budget: int,
    seconds: float | None,
    seed: int | None,
    as_json: bool,
    output: str,
) -> None:
    """Finds a recipe whose patterns measure like the crack pattern in MASK.

    Prints how far the best recipe that was tried is off: the mean over the statistics, in deviations of the mask's
    crops.

    Example: crazing fit photo_mask.png -o mine.toml; crazing texture --recipe mine.toml -o mine.png
    """
    seed = secrets.randbits(32) if seed is None else seed
    picture = as_mask(read_image(mask), level=level, dark=dark)
    if words := doubt(picture, mask, level=level, dark=dark):
        raise click.ClickException(words)
    note_frame(picture, mask)
    reached = math.nan
    with _bar(budget) as show:

        def progress(tried: int, best: float) -> None:
            nonlocal reached
            reached = best
            show(tried, best)

        recipe = crazing.fit(picture, budget=budget, seconds=seconds, rng=seed, progress=progress)
    recipe.replace(title=f"Fit to {Path(mask).name}", citation=f"crazing fit, seed {seed}, budget {budget}").save(
        output
    )
    off = "" if math.isnan(reached) else f", off by {reached:.2f}"
    line = f"{output}: {recipe.n} plates, opening {recipe.opening:.2f}{off}, seed {seed}"
    report = {"output": output, "n": recipe.n, "opening": recipe.opening, "off": None if not off else reached}
    click.echo(json.dumps({**report, "seed": seed}) if as_json else line)


@contextlib.contextmanager
def _bar(total: int) -> Iterator[Callable[[int, float], None]]:
    """Shows how many recipes were tried and how near the best is; nothing unless standard error is a terminal."""
    if not is_watched():
        yield lambda tried, best: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description:>12}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("fitting", total=total)
        yield lambda tried, best: progress.update(task, completed=tried, description=f"off by {best:.2f}")
