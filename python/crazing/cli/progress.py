"""A bar on standard error while a command works, where a person looks on."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Callable, Iterator


def is_watched() -> bool:
    """Whether standard error is a terminal; it may be closed, and is then None."""
    return sys.stderr is not None and sys.stderr.isatty()


@contextlib.contextmanager
def rows(what: str = "rows") -> Iterator[Callable[[int, int], None]]:
    """Gives a function that takes the number done and of all; silent unless standard error is a terminal."""
    if not is_watched():
        yield lambda done, total: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn, TimeRemainingColumn

    columns = (
        TextColumn(f"{{task.completed}} of {{task.total}} {what}"),
        BarColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    )
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("")
        yield lambda done, total: progress.update(task, completed=done, total=total)


@contextlib.contextmanager
def steps(total: int) -> Iterator[Callable[[str], None]]:
    """Gives a function that names the next of `total` steps; silent unless standard error is a terminal."""
    if not is_watched():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description:>12}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        # The first step begins at none done.
        task = progress.add_task("", total=total, completed=-1)

        def begin(name: str) -> None:
            progress.update(task, description=name, advance=1)

        yield begin
