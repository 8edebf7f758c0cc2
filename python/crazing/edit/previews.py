"""Pictures of a crack for the page: what is seen, as large as it is seen, at once or a few rows at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil, floor
from typing import Any

import numpy as np
from numpy.typing import NDArray

from crazing import arguments
from crazing.crack import Crack
from crazing.edit import cracks
from crazing.render import Style, render, rgba
from crazing.texture import TexturePlan, texture_plan

#: Pixels a side of a preview.
LARGEST = 2048

#: The part of what is seen that is drawn beyond it on every side, so that a small pan shows no blank.
_MARGIN = 0.1

#: Pixels across a crack that is seen as one in a preview.
_SHOWN = 2.0

#: What light needs of a texture.
_MAPS = ("color", "normal", "ao", "roughness")

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class Wish:
    """What a page asks for: pixels a unit, the part of the data that it shows, and most pixels of the picture."""

    scale: float
    view: Box
    pixels: int = LARGEST * LARGEST

    @classmethod
    def read(cls, raw: Any) -> Wish | None:
        """A wish as a page sent it, checked; None for none."""
        if raw is None:
            return None
        if not isinstance(raw, Mapping):
            raise TypeError(f"preview is {type(raw).__name__}; an object is wanted")
        scale = arguments.number(raw.get("scale"), "preview.scale", low=1e-300, high=1e300)
        pixels = arguments.count(raw.get("pixels"), "preview.pixels", low=1)
        return cls(scale, arguments.bounds_tuple(raw.get("view"), "preview.view"), pixels)

    def frame(self, crack: Crack) -> tuple[Box, tuple[int, int]] | None:
        """The box to be drawn of a crack, on its grid of pixels, and (height, width); None if none of it is seen."""
        left, low, right, high = self.view
        beyond = _MARGIN * max(right - left, high - low)
        start = max(left - beyond, crack.bounds[0]), max(low - beyond, crack.bounds[1])
        end = min(right + beyond, crack.bounds[2]), min(high + beyond, crack.bounds[3])
        longest = max(end[0] - start[0], end[1] - start[1])
        if not (start[0] < end[0] and start[1] < end[1]):
            return None
        area = (end[0] - start[0]) * (end[1] - start[1])
        scale = min(self.scale, (LARGEST - 2) / longest, (self.pixels / area) ** 0.5)
        if crack.period is not None:
            # A period is a whole number of pixels.
            scale = max(1, int(scale * crack.period[0])) / crack.period[0]
        spans = []
        for axis, corner in enumerate(crack.bounds[:2]):
            first = floor((start[axis] - corner) * scale)
            count = max(1, ceil((end[axis] - corner) * scale - 1e-6) - first)
            spans.append((corner + first / scale, corner + (first + count) / scale, count))
        (left, right, width), (low, high, height) = spans
        return ((left, low, right, high), (height, width)) if left < right and low < high else None


class Preview:
    """A crack as pixels.

    Parameters
    ----------
    crack : Crack
        What is shown.
    frame
        Its part, and (height, width), see :meth:`Wish.frame`.
    values : dict
        The values of the crack's knobs.
    """

    def __init__(self, crack: Crack, frame: tuple[Box, tuple[int, int]], values: dict[str, Any]) -> None:
        self._crack, self._values = crack, values
        self.box, self.shape = frame
        self.kind = "ink" if values["material"] == cracks.INK else "maps"

    def described(self) -> dict[str, Any]:
        """What the page is told of it."""
        ink = cracks.material_of(self._values).crack if self.kind == "maps" else Style().ink
        height, width = self.shape
        size = {"bounds": list(self.box), "whole": list(self._crack.bounds), "height": height, "width": width}
        return {"kind": self.kind, "ink": rgba(ink, "ink")[:3], "resolved": self.resolved, **size}

    @property
    def resolved(self) -> float:
        """The width of a crack that its pixels show, data units; the page draws thinner ones as lines."""
        return _SHOWN * (self.box[2] - self.box[0]) / self.shape[1]

    def without_thin(self) -> Preview:
        """The same without what the page draws: a few pixels of it here and there would be dots."""
        thin = self._crack.width.mean(axis=1) < self.resolved
        crack = replace(self._crack, width=np.where(thin[:, None], 0.0, self._crack.width))
        return Preview(crack, (self.box, self.shape), self._values)

    def rows(self, top: int, count: int) -> bytes:
        """Pixels of some rows: RGBA of ink, or seven bytes of what the page puts light on, see `packed`."""
        if self.kind == "ink":
            return self._inked[top : top + count].tobytes()
        return packed(self._plan.window(top, 0, count, self.shape[1])).tobytes()

    @cached_property
    def _plan(self) -> TexturePlan:
        material, seed = cracks.material_of(self._values), self._values["seed"]
        return texture_plan(self._crack, self.shape, maps=_MAPS, material=material, bounds=self.box, seed=seed)

    @cached_property
    def _inked(self) -> NDArray[np.uint8]:
        return render(self._crack, self.shape, bounds=self.box, style=Style())


def packed(maps: Mapping[str, NDArray[Any]]) -> NDArray[np.uint8]:
    """(H, W, 7) uint8: colour, the slopes in x and y about 128, occlusion and roughness; what light needs."""
    found = np.empty((*maps["ao"].shape, 7), dtype=np.uint8)
    found[..., :3] = maps["color"]
    found[..., 3:5] = maps["normal"][..., :2] * np.float32(127) + np.float32(128.5)
    found[..., 5] = maps["ao"] * np.float32(255)
    found[..., 6] = maps["roughness"] * np.float32(255)
    return found
