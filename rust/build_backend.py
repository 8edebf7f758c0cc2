"""The build backend: maturin's, after one look for the Rust compiler.

Without the look, maturin tries to download a compiler and fails, on a machine without network, in a long trace
that does not say what to install.
"""

from __future__ import annotations

import shutil
import sys

from maturin import *  # noqa: F403
from maturin import get_requires_for_build_sdist  # noqa: F401

_MISSING = (
    "crazing is compiled from Rust and no Rust compiler was found: install stable Rust 1.88 or newer "
    "(https://rustup.rs, or your system's rustc and cargo packages) and run the same command again."
)


def _require_rust() -> None:
    if shutil.which("cargo") is None or shutil.which("rustc") is None:
        sys.exit(_MISSING)


def get_requires_for_build_wheel(config_settings: dict[str, str] | None = None) -> list[str]:
    """Refuse before anything is downloaded; nothing beyond maturin is needed."""
    _require_rust()
    return []


def get_requires_for_build_editable(config_settings: dict[str, str] | None = None) -> list[str]:
    """Refuse before anything is downloaded; nothing beyond maturin is needed."""
    _require_rust()
    return []
