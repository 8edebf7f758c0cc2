"""The tests of the Rust workspace, so that one command covers both languages."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest


@pytest.mark.timeout(1800)  # a first run compiles every dependency
def test_cargo_test_passes(root: Path, closing_line: Callable[[str], None]) -> None:
    if shutil.which("cargo") is None:
        pytest.skip("cargo is not on PATH")
    run = subprocess.run(
        ["cargo", "test", "--workspace", "--locked", "--no-fail-fast", "--color", "never"],
        cwd=root,
        env={**os.environ, "CARGO_TERM_PROGRESS_WHEN": "never"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    lines = re.findall(r"^(?: +Running .*| +Doc-tests .*|test result: .*)$", run.stdout, flags=re.M)
    for line in lines:
        closing_line(line)
    assert run.returncode == 0, f"cargo test failed:\n{run.stdout}"
    assert any(line.startswith("test result: ok. ") for line in lines), run.stdout
