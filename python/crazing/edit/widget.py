"""The editor in a notebook: an anywidget, with traits that are live in both directions."""

from __future__ import annotations

from typing import Any

import anywidget
import numpy as np
import traitlets
from numpy.typing import NDArray

from crazing.edit import exchange, front, knobs
from crazing.edit.layers import MODES
from crazing.edit.session import Session


class PointsTrait(traitlets.TraitType[Any, Any]):
    """A read-only (n, 2) float64 array; on the wire its bytes."""

    info_text = "an (n, 2) array of finite numbers"

    def validate(self, obj: Any, value: Any) -> NDArray[np.float64]:
        """`value` as an array of its own."""
        array = exchange.checked(value).copy()
        array.flags.writeable = False
        return array


def _bytes(points: NDArray[np.float64], widget: Any) -> memoryview:
    return memoryview(points.astype("<f8").tobytes())


def _points(raw: Any, widget: Any) -> NDArray[np.float64]:
    return np.frombuffer(bytes(raw), dtype="<f8").reshape(-1, 2)


class Editor(anywidget.AnyWidget):
    """The editor as a widget. Made by :func:`crazing.edit`.

    Parameters
    ----------
    points : (n, 2) array_like, optional
        What it starts with.

    Examples
    --------
    >>> from crazing.edit.widget import Editor
    >>> editor = Editor([(0, 0), (1, 0), (0, 1)])
    >>> seen = []
    >>> editor.observe(lambda change: seen.append(len(change.new)), "points")
    >>> editor.points = editor.points[:2]
    >>> seen
    [2]
    """

    _esm = front.module()
    _css = front.style()

    points = PointsTrait().tag(sync=True, to_json=_bytes, from_json=_points)
    settings = traitlets.Dict().tag(sync=True)

    def __init__(self, points: Any = None) -> None:
        self._session = Session(points)
        super().__init__(points=self._session.points, settings=self._kept())
        self.on_msg(self._answer)

    def _kept(self) -> dict[str, Any]:
        return {"mode": self._session.mode, **self._session.values}

    @traitlets.validate("settings")
    def _read(self, proposal: Any) -> dict[str, Any]:
        given = dict(proposal.value)
        mode = given.pop("mode", self._session.mode)
        if mode not in MODES:
            raise traitlets.TraitError(f"mode is {mode!r}; one of {', '.join(map(repr, MODES))} is wanted")
        return {"mode": mode, **knobs.read(given)}

    @traitlets.observe("points", "settings")
    def _keep(self, change: Any) -> None:
        if change.name == "points":
            self._session.points = change.new
        else:
            values = dict(change.new)
            self._session.mode = values.pop("mode")
            self._session.values = values

    def _answer(self, widget: Any, content: Any, buffers: Any) -> None:
        reply = self._session.answer(content, [bytes(part) for part in buffers])
        self.send(reply.content, reply.buffers)
