"""The editor: click points, drop a picture, watch the curve, the skeleton, the maze and the crack."""

from __future__ import annotations

from typing import Any

from numpy.typing import ArrayLike

from crazing.extras import require


def edit(points: ArrayLike | None = None) -> Any:
    """Show the editor in a notebook: Jupyter, VS Code, marimo or any other host of anywidget.

    Needs anywidget, the extra `edit`. On its own, in a browser, the editor is ``crazing edit``.

    Parameters
    ----------
    points : (n, 2) array_like, optional
        What it starts with; finite, at most a million.

    Returns
    -------
    crazing.edit.widget.Editor
        A widget. Its traits are live in both directions: `points`, (n, 2) float64, and `settings`, a dict with the
        panel that is shown and the values of all knobs.

    Raises
    ------
    ImportError
        If anywidget is not installed.
    TypeError, ValueError
        If the points are no array of real numbers of that shape, or too many.
    CrazingError
        If a coordinate is NaN or infinite.

    Notes
    -----
    Source: thesis, section 2, whose program captured and saved the coordinates of mouse clicks.

    Examples
    --------
    >>> import crazing as cz
    >>> editor = cz.edit([(0, 0), (1, 0), (0, 1)])
    >>> editor.points = [*editor.points, (1, 1)]
    >>> editor.points.shape
    (4, 2)
    """
    require("anywidget", "edit")
    from crazing.edit.widget import Editor

    return Editor(points)
