"""What the tests share: where the sources are, and the closing lines of the Rust tests."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest

# No test may open a window.
os.environ.setdefault("MPLBACKEND", "Agg")

ROOT = Path(__file__).parents[1]
CLOSING = "closing line"


@pytest.fixture(scope="session")
def root() -> Path:
    """The checkout; a test that reads sources is skipped where only the installed package is."""
    if not (ROOT / "rust" / "crazing" / "src" / "lib.rs").exists():
        pytest.skip("the sources are not here")
    return ROOT


@pytest.fixture
def closing_line(record_property: Callable[[str, object], None]) -> Callable[[str], None]:
    """Takes a line to be printed under the Python tests' own report, from whichever worker."""
    return partial(record_property, CLOSING)


@pytest.fixture
def by_threads() -> Callable[[str], set[str]]:
    """All that a program prints on one, two and three threads, each in a process of its own."""

    def printed(program: str) -> set[str]:
        found = set()
        for threads in "123":
            environment = {**os.environ, "RAYON_NUM_THREADS": threads}
            run = subprocess.run([sys.executable, "-c", program], env=environment, capture_output=True, text=True)
            assert run.returncode == 0, run.stderr
            found.add(run.stdout)
        return found

    return printed


@pytest.fixture
def rng() -> np.random.Generator:
    """Random inputs that are the same in every run."""
    return np.random.default_rng(20260722)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Shows the Rust tests' closing lines, so that both languages' counts stand in one output."""
    ended = [report for kind in ("passed", "failed") for report in terminalreporter.stats.get(kind, [])]
    lines = [line for report in ended for name, line in report.user_properties if name == CLOSING]
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
