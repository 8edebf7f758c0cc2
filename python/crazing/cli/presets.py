"""`crazing presets`: the recipes that come with the package."""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

import click

import crazing
from crazing.cli.output import seed_without_use
from crazing.files import atomic_write
from crazing.recipe import PRESETS


@click.command("presets")
@click.option("--json", "as_json", is_flag=True, help="Print them as one line of JSON.")
@seed_without_use
@click.option(
    "-o",
    "--output",
    type=click.Path(file_okay=False),
    metavar="FOLDER",
    help="Also write their files there, to be changed and given to crazing texture --recipe.",
)
def command(*, as_json: bool, output: str | None) -> None:
    """Lists the presets: name, title, and where the numbers are from.

    Example: crazing presets

    Example: crazing presets -o mine/
    """
    found = {name: crazing.preset(name) for name in crazing.presets()}
    if output is not None:
        _write(Path(output), found)
    if as_json:
        rows = {name: {"title": recipe.title, "citation": recipe.citation} for name, recipe in found.items()}
        click.echo(json.dumps(rows))
        return
    width = max(map(len, found), default=0)
    for name, recipe in found.items():
        click.echo(f"{name:{width}}  {recipe.title}")
        click.echo(f"{'':{width}}  {recipe.citation}")


def _write(folder: Path, names: Iterable[str]) -> None:
    """Refuses to replace what somebody may have changed."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = [folder / f"{name}.toml" for name in names]
    taken = [path for path in paths if path.exists()]
    if taken:
        raise click.BadParameter(f"{taken[0]} is there already.", param_hint="'-o' / '--output'")
    for path in paths:
        with atomic_write(path) as file:
            file.write((PRESETS / path.name).read_bytes())
