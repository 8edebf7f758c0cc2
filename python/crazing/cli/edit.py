"""`crazing edit`: the editor in the browser, served on this machine to nobody else."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from typing import Any

import click

from crazing.cli.output import Seed, ending_in
from crazing.cli.source import content_of
from crazing.edit import exchange, knobs
from crazing.edit.session import Session
from crazing.extras import require
from crazing.files import atomic_write


@click.command("edit")
@click.argument("file", type=click.Path(exists=True, dir_okay=False), required=False)
@click.option("--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="Port; by default a free one.")
@click.option("--no-browser", is_flag=True, help="Only print the address, which works once.")
@click.option("--seed", type=Seed(knobs.SEED_BITS), metavar="N", help="Seed that the panels start with.")
@click.option(
    "-o",
    "--output",
    metavar="PATH",
    callback=ending_in(*(f".{name}" for name in exchange.FORMATS)),
    help=f"Where the points go when the editor ends, if there are any: {', '.join(f'.{n}' for n in exchange.FORMATS)}.",
)
def command(*, file: str | None, port: int, no_browser: bool, seed: int | None, output: str | None) -> None:
    """Opens the editor in the browser, with the points of FILE if one is given.

    FILE is CSV, NPY, GeoJSON, or an SVG that the editor saved. The page is served on 127.0.0.1 only; the program ends
    when the page has been closed for a while, or with Ctrl-C.
    """
    for package in ("starlette", "uvicorn", "websockets"):
        require(package, "edit")
    from crazing.edit.server import Server

    session = Session(None if file is None else _points(file), seed=seed)
    server = Server(session, port=port)
    click.echo(f"The editor is at {server.address}")
    click.echo("The address works once. Ctrl-C ends.")
    if not no_browser:
        _open(server.address)
    try:
        server.run()
    finally:
        if output is not None and len(session.points):
            with atomic_write(output) as target:
                target.write(exchange.written(session.points, Path(output).suffix[1:].lower()))
            click.echo(f"{output}: {len(session.points)} points")


def _points(file: str) -> exchange.Points:
    content = content_of(file)
    kind = "picture" if exchange.is_picture(content) else "drawing" if exchange.is_foreign_svg(content) else None
    if kind is not None:
        wanted = "CSV, NPY, GeoJSON or an SVG that the editor saved is wanted; crazing skeleton takes samples of a"
        raise click.ClickException(f"{file} is a {kind}, which holds no points: {wanted} {kind}.")
    return exchange.load(content)


def _open(address: str) -> Any:
    """Asks the desktop for a browser; where there is none, the printed address is what is left."""
    try:
        return webbrowser.open(address)
    except webbrowser.Error:
        return False
