"""The command line as tests call it."""

from __future__ import annotations

from click.testing import CliRunner, Result

from crazing.cli import main


def run(*words: object) -> Result:
    return CliRunner().invoke(main, [str(word) for word in words])


def refused(result: Result, *words: str) -> None:
    """One line, code 2, no trace."""
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert result.stderr.startswith("Error: ")
    assert result.stderr.count("\n") == 1
    for word in words:
        assert word in result.stderr
