"""`crazing presets`: the recipes that come with the package."""

from __future__ import annotations

import json

import click

import crazing


@click.command("presets")
@click.option("--json", "as_json", is_flag=True, help="Print them as one line of JSON.")
def command(*, as_json: bool) -> None:
    """Lists the presets: name, title, and where the numbers are from.

    Example: crazing presets
    """
    found = {name: crazing.preset(name) for name in crazing.presets()}
    if as_json:
        rows = {name: {"title": recipe.title, "citation": recipe.citation} for name, recipe in found.items()}
        click.echo(json.dumps(rows))
        return
    width = max(map(len, found), default=0)
    for name, recipe in found.items():
        click.echo(f"{name:{width}}  {recipe.title}")
        click.echo(f"{'':{width}}  {recipe.citation}")
