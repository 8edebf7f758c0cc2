"""The build backend: maturin's, after one look for the Rust compiler, and with the licences of what is linked.

Without the look, maturin tries to download a compiler and fails, on a machine without network, in a long
trace that does not say what to install.
"""

from __future__ import annotations

import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import maturin
import notices
from maturin import *  # noqa: F403


def _wanted() -> str:
    """The oldest compiler that will do; read from Cargo.toml, so that it is written once."""
    manifest = Path(__file__).parent.parent / "Cargo.toml"
    return str(tomllib.loads(manifest.read_text(encoding="utf-8"))["workspace"]["package"]["rust-version"])


def _found(program: str) -> str | None:
    """The version that `program` reports; None where it is missing or, as rustup's stand-in, empty."""
    try:
        run = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    words = run.stdout.split()
    return words[1] if len(words) > 1 else None


def _numbers(version: str) -> tuple[int, ...]:
    return tuple(int(part) for part in version.split("-")[0].split("."))


def _require_rust() -> None:
    wanted = _wanted()
    remedy = f"install stable Rust {wanted} or newer (https://rustup.rs) and run the same command again."
    for program in ("cargo", "rustc"):
        version = _found(program)
        if version is None:
            sys.exit(f"crazing is compiled from Rust and no working {program} was found on PATH: {remedy}")
        if _numbers(version) < _numbers(wanted):
            sys.exit(f"crazing is compiled from Rust and {program} {version} is too old: {remedy}")


def get_requires_for_build_wheel(config_settings: Mapping[str, Any] | None = None) -> list[str]:
    """Refuse a machine without Rust; nothing beyond maturin is needed."""
    _require_rust()
    return []


get_requires_for_build_editable = get_requires_for_build_wheel
get_requires_for_build_sdist = get_requires_for_build_wheel


def build_wheel(
    wheel_directory: str, config_settings: Mapping[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    """Maturin's wheel, with the licence texts of the Rust libraries in it."""
    name = str(maturin.build_wheel(wheel_directory, config_settings, metadata_directory))
    notices.add(Path(wheel_directory) / name, notices.notices(Path(__file__).parent.parent))
    return name
