"""The command line: one file a command, loaded when it is called."""

from __future__ import annotations

import importlib
from typing import Any

import click

from crazing import _core
from crazing.arguments import meant
from crazing.cli.failures import Program

#: A command `name` is `crazing.cli.name.command`.
COMMANDS = (
    "compare",
    "dataset",
    "edit",
    "fit",
    "maze",
    "measure",
    "presets",
    "rerun",
    "skeleton",
    "texture",
)


class Commands(Program):
    """Knows its commands by name and imports the one that is called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names of the commands, as `--help` shows them."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command of that name, if there is one."""
        if cmd_name not in COMMANDS:
            return None
        command: Any = importlib.import_module(f"crazing.cli.{cmd_name}").command
        return command if isinstance(command, click.Command) else None

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is called; what a misspelt one may have meant is asked."""
        if args[0] not in COMMANDS and not args[0].startswith("-"):
            ctx.fail(f"No such command {args[0]!r}{meant(args[0], COMMANDS)}.")
        return super().resolve_command(ctx, args)


@click.group(cls=Commands, no_args_is_help=False, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(_core.__version__, message="crazing %(version)s")
def main() -> None:
    """Voronoi curves, skeletons, mazes and crack textures."""
