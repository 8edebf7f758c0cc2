"""`crazing rerun`: a picture made again."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import click

import crazing
from crazing.cli.output import seed_without_use
from crazing.cli.progress import rows
from crazing.pictures.reading import record_of
from crazing.rerun import again, check_version


@click.command("rerun")
@click.argument("file", type=click.Path(exists=True))
@click.option("-o", "--output", metavar="FILE", help="Where to; by default beside FILE, with .again in its name.")
@click.option("--threads", type=click.IntRange(1, 1024), metavar="N", help="Threads that draw; all cores by default.")
@seed_without_use
@click.option("--json", "as_json", is_flag=True, help="Print the result as one line of JSON.")
def command(*, file: str, output: str | None, threads: int | None, as_json: bool) -> None:
    """Makes a picture again, the same pixels, from what FILE says of itself.

    FILE is a PNG, TIFF, EXR or Zarr that crazing texture, Texture.save or write_texture wrote.

    Example: crazing rerun mud/height.png -o height.png
    """
    source = Path(file)
    record = record_of(source)
    check_version(record, source)
    target = again(source, record) if output is None else Path(output)
    if "picture" in record:
        with rows() as progress:
            made = crazing.rerun(source, target, threads=threads, progress=progress)
    else:
        if target.suffix.lower() != ".png":
            raise click.UsageError(f"{target} does not end in .png, and {source} holds a PNG.")
        _draw(record, source, target, threads)
        made = target
    click.echo(json.dumps({**record, "output": str(made)}) if as_json else f"{made}: made again from {source}")


def _draw(record: dict[str, Any], source: Path, target: Path, threads: int | None) -> None:
    """A plain picture, as `crazing texture` draws it without maps."""
    from crazing.cli.texture import draw

    try:
        parameters = dict(record["parameters"])
        parameters["size"] = tuple(parameters["size"])
        image = draw(threads=threads, **parameters)
    except (KeyError, TypeError, ValueError) as error:
        raise click.UsageError(f"the record in {source} is damaged: {error}") from None
    crazing.save_png(target, image, text={"crazing": json.dumps(record)})
