"""Where a command puts its picture and its words."""

from __future__ import annotations

import contextlib
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, BinaryIO

import click

from crazing.files import atomic_write

#: The picture goes to standard output.
STANDARD = "-"


def checked(ctx: click.Context, parameter: click.Parameter, value: str | None) -> str | None:
    """Refuses, before any work is done, a place that could not take the picture."""
    if value is None:
        return None
    if value == STANDARD:
        if sys.stdout is None:
            raise click.BadParameter("standard output is closed; name a file.")
        if sys.stdout.isatty():
            raise click.BadParameter("a PNG is not written to a terminal; name a file or redirect.")
        return value
    return _writable(value, (".png",))


def ending_in(*endings: str) -> Callable[[click.Context, click.Parameter, str | None], str | None]:
    """Refuses, before any work is done, a file of another ending or in no folder that can be written to."""
    return lambda ctx, parameter, value: None if value is None else _writable(value, endings)


def _writable(value: str, endings: tuple[str, ...]) -> str:
    path = Path(value)
    if path.suffix.lower() not in endings:
        raise click.BadParameter(f"{value!r} does not end in {', '.join(endings)}.")
    if path.is_dir() or not path.parent.is_dir():
        raise click.BadParameter(f"{value!r} is a folder or lies in none.")
    if not os.access(path.parent, os.W_OK):
        raise click.BadParameter(f"the folder of {value!r} cannot be written to.")
    return value


class Seed(click.types.IntParamType):
    """What `--seed` takes: in every command as much as all kinds of pictures can keep."""

    def __init__(self, bits: int = 63) -> None:
        self.bits = bits

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> int:
        """The seed, or a word about what is wanted."""
        seed = int(super().convert(value, param, ctx))
        if not 0 <= seed < 1 << self.bits:
            self.fail(f"{seed} is no seed; a whole number from 0 to 2**{self.bits} - 1 is wanted.", param, ctx)
        return seed


def seed_without_use(function: Callable[..., Any]) -> Callable[..., Any]:
    """Adds `--seed` to a command that draws nothing at random, so that scripts may give it to every command."""
    words = "Taken by every command; nothing is random in this one."
    return click.option("--seed", type=Seed(), expose_value=False, metavar="N", help=words)(function)


def output_option(function: Callable[..., Any], *, required: bool = True) -> Callable[..., Any]:
    """Adds `-o` to a command that makes a PNG."""
    words = "Where to write the picture, a PNG; - is standard output."
    return click.option("-o", "--output", required=required, metavar="FILE", callback=checked, help=words)(function)


@contextlib.contextmanager
def opened(output: str) -> Iterator[BinaryIO]:
    """A binary file for the picture: `output` itself, replaced when all is written, or standard output."""
    if output == STANDARD:
        yield sys.stdout.buffer
        sys.stdout.buffer.flush()
    else:
        with atomic_write(output) as file:
            yield file


def say(text: str, output: str | None) -> None:
    """Prints the words of a result; to standard error where the picture has standard output."""
    click.echo(text, err=output == STANDARD)
