"""What the tests share: where the sources are, and the closing lines of the Rust tests."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

# No test may open a window.
os.environ.setdefault("MPLBACKEND", "Agg")

ROOT = Path(__file__).parents[1]
RUST_LINES = pytest.StashKey[list[str]]()


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout; a test that reads sources is skipped where only the installed package is."""
    if not (ROOT / "rust" / "crazing" / "src" / "lib.rs").exists():
        pytest.skip("the sources are not here")
    return ROOT


@pytest.fixture(scope="session")
def rust_lines(pytestconfig: pytest.Config) -> list[str]:
    """Lines to be printed under the Python tests' own report."""
    return pytestconfig.stash.setdefault(RUST_LINES, [])


@pytest.fixture
def rng() -> np.random.Generator:
    """Random inputs that are the same in every run."""
    return np.random.default_rng(20260722)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Shows the Rust tests' closing lines, so that both languages' counts stand in one output."""
    lines = config.stash.get(RUST_LINES, [])
    if lines:
        terminalreporter.section("cargo test")
        for line in lines:
            terminalreporter.write_line(line)


@pytest.fixture
def blob(tmp_path: Path) -> Path:
    """A picture of two discs that overlap."""
    image = pytest.importorskip("PIL.Image")
    y, x = np.mgrid[:80, :100]
    inside = (x - 35) ** 2 + (y - 40) ** 2 < 25**2
    inside |= (x - 65) ** 2 + (y - 40) ** 2 < 20**2
    image.fromarray(inside).save(tmp_path / "blob.png")
    return tmp_path / "blob.png"
