"""How a command ends badly: one clear line on standard error, and a code that says why."""

from __future__ import annotations

import sys
from typing import Any

import click

#: Exit codes: what was asked cannot be done; stopped by Ctrl-C (128 + SIGINT, as shells have it).
BAD_INPUT, INTERRUPTED = 2, 130

# What bad input raises. Anything else is a bug and keeps its trace.
_EXPECTED = (click.ClickException, ValueError, TypeError, OSError, ImportError, MemoryError)


class Program(click.Group):
    """A group of commands whose failures are one line each."""

    def main(self, *args: Any, **extra: Any) -> Any:
        """Runs the command line and exits."""
        extra["standalone_mode"] = False
        sys.exit(self._code(*args, **extra))

    def _code(self, *args: Any, **extra: Any) -> int:
        try:
            outcome = super().main(*args, **extra)
        except click.Abort:
            return INTERRUPTED
        except _EXPECTED as error:
            click.echo(f"Error: {_one_line(_words(error))}", err=True)
            return BAD_INPUT
        # Help and version leave a code, commands leave nothing.
        return outcome if isinstance(outcome, int) else 0


def _words(error: BaseException) -> str:
    if isinstance(error, click.UsageError) and error.ctx is not None:
        return f"{error.format_message()} See {error.ctx.command_path} --help."
    if isinstance(error, click.ClickException):
        return error.format_message()
    if isinstance(error, OSError) and error.strerror:
        return f"{error.filename}: {error.strerror}" if error.filename is not None else error.strerror
    return str(error) or ("out of memory" if isinstance(error, MemoryError) else type(error).__name__)


def _one_line(text: str) -> str:
    return " ".join(line.strip() for line in text.splitlines())
