"""What a file says of itself."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from crazing import _core

#: The keyword, tag or attribute of the record in every format.
KEY = "crazing"


@dataclass(frozen=True)
class About:
    """One picture: its record, and what a format says in fields of its own."""

    record: Mapping[str, Any]
    """How it was made, in the terms of JSON."""
    density: tuple[float, float]
    """Pixels a metre, across and up."""
    is_color: bool
    """Whether the samples are sRGB colours."""

    @property
    def text(self) -> str:
        """The record as one line of ASCII."""
        return json.dumps(self.record, allow_nan=False)

    @property
    def software(self) -> str:
        """Who made it."""
        return f"crazing {_core.__version__}"
