"""`crazing edit`: the editor in the browser, served on this machine to nobody else."""

from __future__ import annotations

import webbrowser
from typing import Any

import click

from crazing.cli.source import content_of
from crazing.edit import exchange
from crazing.edit.session import Session
from crazing.extras import require


@click.command("edit")
@click.argument("file", type=click.Path(exists=True, dir_okay=False), required=False)
@click.option("--port", type=click.IntRange(0, 65535), default=0, metavar="N", help="Port; by default a free one.")
@click.option("--no-browser", is_flag=True, help="Only print the address, which works once.")
def command(*, file: str | None, port: int, no_browser: bool) -> None:
    """Opens the editor in the browser, with the points of FILE if one is given.

    FILE is CSV, NPY, GeoJSON, or an SVG that the editor saved. The page is served on 127.0.0.1 only; the program ends
    when the page has been closed for a while, or with Ctrl-C.
    """
    for package in ("starlette", "uvicorn", "websockets"):
        require(package, "edit")
    from crazing.edit.server import Server

    session = Session(None if file is None else exchange.load(content_of(file)))
    server = Server(session, port=port)
    click.echo(f"The editor is at {server.address}")
    click.echo("The address works once. Ctrl-C ends.")
    if not no_browser:
        _open(server.address)
    server.run()


def _open(address: str) -> Any:
    """Asks the desktop for a browser; where there is none, the printed address is what is left."""
    try:
        return webbrowser.open(address)
    except webbrowser.Error:
        return False
