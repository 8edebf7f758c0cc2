"""How the editor's tests talk to a session."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing.edit import samples
from crazing.edit.session import Message, Session

Points = NDArray[np.float64]
STAR = samples.points_of("star", 120, 0)
MODES = ("skeleton", "compare", "maze", "crack")


def raw(points: Points) -> list[bytes]:
    return [points.astype("<f8").tobytes()]


def asked(session: Session, kind: str, buffers: list[bytes] | None = None, **content: Any) -> Message:
    reply = session.answer({"kind": kind, "serial": 1, **content}, [] if buffers is None else buffers)
    assert reply.content["serial"] == 1
    json.dumps(reply.content, allow_nan=False)
    return reply


def good(session: Session, kind: str, buffers: list[bytes] | None = None, **content: Any) -> Message:
    reply = asked(session, kind, buffers, **content)
    assert reply.content["kind"] != "error", reply.content
    return reply


def points_in(reply: Message) -> Points:
    return np.frombuffer(reply.buffers[0], dtype="<f8").reshape(-1, 2)
