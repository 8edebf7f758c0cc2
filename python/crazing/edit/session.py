"""One open editor: messages in, messages out. Knows no socket, no notebook and no path."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from crazing import _core, arguments
from crazing.crack import Crack
from crazing.edit import cracks, exchange, knobs, output, picture, previews, samples
from crazing.edit.layers import MODES, Drawing, draw
from crazing.edit.script import script
from crazing.errors import CrazingError
from crazing.measure import measure

Points: TypeAlias = NDArray[np.float64]
Buffers: TypeAlias = Sequence["bytes | memoryview"]

#: Pixels a side of a picture to be taken away.
LARGEST_PICTURE = 8192

#: Seconds beyond which a layer waits until its points are let go.
SLOW = 0.06

#: Failures that are the asker's; all else is a bug, which is told as such and does not end the session.
_EXPECTED = (ValueError, TypeError, ImportError, MemoryError, OSError)


@dataclass(frozen=True)
class Message:
    """What goes over the wire: a JSON object with the word `kind`, and binary parts."""

    content: dict[str, Any]
    buffers: list[bytes] = field(default_factory=list)


class Session:
    """The state behind one page: points, knobs, and the picture that was dropped last.

    Parameters
    ----------
    points : (n, 2) array_like, optional
        What the page starts with.
    seed : int, optional
        The seed that every panel starts with.

    Examples
    --------
    >>> from crazing.edit.session import Session
    >>> session = Session([(0, 0), (1, 0), (0, 1)])
    >>> session.answer({"kind": "hello", "serial": 1}).content["kind"]
    'state'
    >>> session.answer({"kind": "nonsense", "serial": 2}).content["message"]
    "kind is 'nonsense'; one of 'hello', ... is wanted"
    """

    def __init__(self, points: Any = None, *, seed: int | None = None) -> None:
        self.points = exchange.checked(np.empty((0, 2)) if points is None else points)
        self.mode = MODES[0]
        self.values = knobs.defaults()
        if seed is not None:
            self.values = knobs.read({panel: {"seed": seed} for panel, held in self.values.items() if "seed" in held})
        self._picture: picture.Picture | None = None
        self._slow: set[str] = set()
        self._preview: previews.Preview | None = None

    def answer(self, content: Any, buffers: Buffers = ()) -> Message:
        """The reply to a message.

        Parameters
        ----------
        content : dict
            `kind` names what is asked, `serial` is given back.
        buffers : sequence of bytes
            The binary parts: points as little-endian float64 pairs, or a file.

        Returns
        -------
        Message
            Of kind "error", with a `message`, if what was asked cannot be done. Nothing is raised.
        """
        serial = content.get("serial") if isinstance(content, Mapping) else None
        kind = ""
        try:
            if not isinstance(content, Mapping):
                raise TypeError("a message is an object")
            kind = arguments.choice(content.get("kind"), "kind", _ANSWERS)
            reply = _ANSWERS[kind](self, content, buffers)
        except _EXPECTED as error:
            words = str(error) or ("out of memory" if isinstance(error, MemoryError) else type(error).__name__)
            reply = Message({"kind": "error", "message": words, "hint": isinstance(error, ImportError)})
        except Exception as error:
            reply = Message({"kind": "error", "message": f"a bug in crazing: {type(error).__name__}: {error}"})
        # Only what JSON can hold on both sides goes back as it came.
        known = serial if isinstance(serial, int) else None
        return Message(_finite({**reply.content, "of": kind, "serial": known}), reply.buffers)

    def keep(self, content: Mapping[str, Any], buffers: Buffers) -> tuple[Points, str, dict[str, Any]]:
        """Points, mode and its values of a message; they become the state of the session."""
        points = points_of(buffers)
        mode = arguments.choice(content.get("mode"), "mode", MODES)
        values = knobs.read(content.get("values", {}))
        self.points, self.mode, self.values = points, mode, values
        return points, mode, values[mode]

    def _hello(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        state = {
            "kind": "state",
            "mode": self.mode,
            "values": self.values,
            "knobs": knobs.described(),
            "recipes": {name: {f: getattr(r, f) for f in knobs.recipe_fields()} for name, r in knobs.recipes().items()},
            "samples": knobs.listed(samples.KNOBS),
            "contour": knobs.listed(picture.KNOBS),
            "lamp": knobs.listed(cracks.LAMP),
            "outlines": list(samples.OUTLINES),
            "formats": list(exchange.FORMATS),
            "outputs": output.described(),
            "limits": {"points": exchange.MOST_POINTS, "bytes": picture.MOST_BYTES, "size": LARGEST_PICTURE},
            "version": _core.__version__,
        }
        return Message(state, [self.points.tobytes()])

    def _layers(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        start = time.perf_counter()
        points, mode, values = self.keep(content, buffers)
        wish = previews.Wish.read(content.get("preview")) if mode == "crack" else None
        skip = frozenset[str]()
        if content.get("moving") is True:
            skip = frozenset(self._slow)
            if wish is not None and not cracks.is_rough(points, values, wish.scale):
                # It costs more than all else, and nobody would see it.
                skip |= {"crack"}
        found = draw(points, mode, values, skip)
        self._time(found)
        reply, parts = _packed(found, points)
        left_out = sorted(name for name in skip if values.get(name))
        if left_out and mode == "skeleton":
            reply["note"] = f"{', '.join(left_out).capitalize()}: when you let go"
        drawn = time.perf_counter()
        self._preview = _preview_of(found, wish, values)
        if self._preview is not None:
            later = content.get("later") is True
            reply["preview"] = {**self._preview.described(), "later": later}
            if not later:
                parts.append(self._preview.without_thin().rows(0, self._preview.shape[0]))
        now = time.perf_counter()
        reply |= {"milliseconds": round(1e3 * (now - start), 2), "drawing": round(1e3 * (now - drawn), 2)}
        return Message({"kind": "layers", "mode": mode, **reply}, parts)

    def _rows(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        """A part of the preview that the last layers left for later."""
        if self._preview is None:
            raise CrazingError("there is no preview yet")
        height = self._preview.shape[0]
        top = arguments.count(content.get("top"), "top", high=height - 1)
        count = arguments.count(content.get("count"), "count", low=1, high=height - top)
        start = time.perf_counter()
        pixels = self._preview.rows(top, count)
        return Message({"kind": "rows", "drawing": round(1e3 * (time.perf_counter() - start), 2)}, [pixels])

    def _time(self, found: Drawing) -> None:
        """Remembers which layers are too slow to follow a moving point."""
        for name, seconds in found.seconds.items():
            (self._slow.add if seconds > SLOW else self._slow.discard)(name)

    def _measure(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        points, mode, values = self.keep(content, buffers)
        found = draw(points, mode, values)
        if found.subject is None:
            raise CrazingError(found.note or "there is nothing to be measured yet")
        measured = measure(found.subject).to_dict()
        return Message(
            {"kind": "measures", "rows": [[name.replace("_", " "), value] for name, value in measured.items()]}
        )

    def _sample(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        asked = {knob.name: knob.read(content.get(knob.name, knob.default), "samples") for knob in samples.KNOBS}
        points = samples.points_of(**asked)
        return Message({"kind": "points", "source": asked}, [points.tobytes()])

    def _load(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        file = _file(buffers)
        if exchange.is_foreign_svg(file):
            return Message({"kind": "drawing"})
        if exchange.is_picture(file):
            self._picture = picture.opened(file)
            height, width = self._picture.size
            return Message({"kind": "picture", "width": width, "height": height})
        return Message({"kind": "points", "source": None}, [exchange.load(file).tobytes()])

    def _contour(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        if self._picture is None:
            raise CrazingError("no picture has been dropped yet")
        asked = {knob.name: knob.read(content.get(knob.name, knob.default), "contour") for knob in picture.KNOBS}
        points = self._picture.points(**asked)
        return Message({"kind": "points", "source": None}, [points.tobytes()])

    def _save(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        ending = arguments.choice(content.get("format"), "format", exchange.FORMATS)
        points = points_of(buffers)
        return Message({"kind": "file", "name": f"points.{ending}"}, [exchange.written(points, ending)])

    def _export(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        points, mode, values = self.keep(content, buffers)
        size = arguments.count(content.get("size", 1024), "size", low=16, high=LARGEST_PICTURE)
        light = cracks.light(content.get("lamp"))
        name, made = output.made(content.get("what"), points, mode, values, size, light)
        return Message({"kind": "file", "name": name}, [made])

    def _script(self, content: Mapping[str, Any], buffers: Buffers) -> Message:
        points, mode, values = self.keep(content, buffers)
        source, light = samples.read(content.get("source")), cracks.light(content.get("lamp"))
        return Message({"kind": "script", "text": script(points, mode, values, source, light)})


_ANSWERS: dict[str, Callable[[Session, Mapping[str, Any], Buffers], Message]] = {
    "hello": Session._hello,
    "layers": Session._layers,
    "rows": Session._rows,
    "measure": Session._measure,
    "sample": Session._sample,
    "load": Session._load,
    "contour": Session._contour,
    "save": Session._save,
    "export": Session._export,
    "script": Session._script,
}


def _finite(value: Any) -> Any:
    """Numbers that JSON cannot write become null."""
    if isinstance(value, dict):
        return {name: _finite(inner) for name, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [_finite(inner) for inner in value]
    return None if isinstance(value, float) and value - value != 0 else value


def points_of(buffers: Buffers) -> Points:
    """The points of a message: its first binary part, pairs of little-endian float64."""
    raw = _file(buffers)
    if len(raw) % 16:
        raise ValueError(f"points have {len(raw)} bytes; 16 a point are wanted")
    return exchange.checked(np.frombuffer(raw, dtype="<f8").reshape(-1, 2))


def _file(buffers: Buffers) -> bytes:
    if len(buffers) != 1:
        raise ValueError(f"the message has {len(buffers)} binary parts; one is wanted")
    return bytes(buffers[0])


def _packed(found: Drawing, points: Points) -> tuple[dict[str, Any], list[bytes]]:
    """The drawing as numbers for the page: float32 about the middle of the points, so that far points stay sharp."""
    origin = points.mean(axis=0) if len(points) else np.zeros(2)
    layers: list[dict[str, Any]] = []
    parts: list[bytes] = []
    for layer in found.layers:
        kind, where = ("lines", layer.graph.segments) if layer.graph is not None else ("marks", layer.marks)
        assert where is not None
        with np.errstate(over="ignore"):
            parts.append(np.ascontiguousarray(where - origin, dtype="<f4").tobytes())
        layers.append({"name": layer.name, "kind": kind})
    for layer, about in zip(found.layers, layers, strict=True):
        if layer.widths is not None:
            about["widths"] = len(parts)
            parts.append(layer.widths.astype("<f4").tobytes())
    described = {
        "layers": layers,
        "origin": origin.tolist(),
        "head": list(found.head),
        "rows": [list(row) for row in found.rows],
        "note": found.note,
    }
    return described, parts


def _preview_of(found: Drawing, wish: previews.Wish | None, values: dict[str, Any]) -> previews.Preview | None:
    """The preview that is wished for, if any of the crack is seen."""
    if wish is None or not isinstance(found.subject, Crack):
        return None
    frame = wish.frame(found.subject)
    return None if frame is None else previews.Preview(found.subject, frame, values)
