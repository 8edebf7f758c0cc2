"""`crazing dataset`: pictures of cracks with exact labels."""

from __future__ import annotations

import dataclasses
import json
import secrets
from pathlib import Path
from typing import Any

import click

import crazing
from crazing.cli.output import Seed
from crazing.cli.progress import rows
from crazing.cli.texture import pixels
from crazing.dataset import LABELS
from crazing.dataset_folder import key_of


def _folder(ctx: click.Context, parameter: click.Parameter, value: str) -> str:
    path = Path(value)
    if not value:
        raise click.BadParameter("'' names no folder.")
    if path.exists() and not path.is_dir():
        raise click.BadParameter(f"{value!r} is a file; a folder is wanted.")
    if not path.parent.is_dir():
        raise click.BadParameter(f"{value!r} lies in no folder.")
    return value


@click.command("dataset")
@click.option("-n", "n", type=click.IntRange(1, 10_000_000), default=100, show_default=True, help="Pictures.")
@click.option(
    "--preset",
    "presets",
    multiple=True,
    metavar="A,B",
    help="Kinds of crack; may be given several times. Default all.",
)
@click.option(
    "--size",
    callback=pixels,
    default="512",
    metavar="PIXELS",
    show_default=True,
    help="512, or 640x480: width x height.",
)
@click.option(
    "--labels",
    default="mask",
    show_default=True,
    metavar="A,B",
    help=f"Some of {', '.join(LABELS)}.",
)
@click.option("--zoom", type=float, default=2.0, show_default=True, help="How much the number of plates varies.")
@click.option(
    "--thinnest",
    type=float,
    default=1.0,
    show_default=True,
    metavar="PX",
    help="The mask shows thinner cracks as wide as this; 0 shows them as they are, with gaps.",
)
@click.option(
    "--seed",
    type=Seed(),
    metavar="N",
    help="Seed; by default that of the data set in FOLDER, or a fresh one.",
)
@click.option("--threads", type=click.IntRange(1, 1024), metavar="N", help="Pictures at a time; all cores by default.")
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
@click.option("-o", "--output", required=True, metavar="FOLDER", callback=_folder, help="Where to.")
def command(
    *, n: int, presets: tuple[str, ...], labels: str, seed: int | None, threads: int | None, **given: Any
) -> None:
    """Makes pictures of cracks with exact labels, split into train, val and test.

    Every picture has its own pattern, scale and light. The same seed gives the same data set, and a larger one begins
    with the pictures of a smaller one: when a run is stopped, or more are wanted, the same command goes on.

    Example: crazing dataset -n 1000 --preset asphalt-crack --preset concrete-spall --seed 7 -o cracks/
    """
    as_json, output, (width, height) = given.pop("as_json"), given.pop("output"), given.pop("size")
    names = tuple(word.strip() for word in labels.split(","))
    kinds = tuple(word.strip() for value in presets for word in value.split(","))
    given = {**given, "presets": kinds or None, "size": (height, width), "labels": names}
    seed, key = (seed, None) if seed is not None else (secrets.randbits(32), key_of(output))
    data = crazing.dataset(n, rng=seed, **given)
    if key is not None:
        seed, data = None, dataclasses.replace(data, key=key)
    with rows("pictures") as progress:
        made = data.write(output, threads=threads, progress=progress)
    counts = dict.fromkeys(("train", "val", "test"), 0)
    for i in range(n):
        counts[data.drawn(i)["split"]] += 1
    report = {"output": output, "pictures": n, "made": made, **counts, "labels": list(names), "seed": seed}
    split = ", ".join(f"{count} {name}" for name, count in counts.items())
    known = "the seed it had" if seed is None else f"seed {seed}"
    words = f"{output}: {n} pictures ({split}), {made} of them new, {known}"
    click.echo(json.dumps(report) if as_json else words)
