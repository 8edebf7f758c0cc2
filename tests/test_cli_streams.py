"""Commands whose standard streams are closed, as programs that start others in the background leave them."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest


@pytest.mark.skipif(os.name == "nt", reason="shells of POSIX")
@pytest.mark.parametrize("closed", ["2>&-", "2>&- >&-", ">&-"])
def test_closed_streams_keep_no_picture_from_being_made(closed: str, tmp_path: Path) -> None:
    command = f'exec "$0" -m crazing texture --size 16 -o a.png {closed}'
    done = subprocess.run(["sh", "-c", command, sys.executable], cwd=tmp_path, capture_output=True)
    assert (done.returncode, done.stderr) == (0, b"")
    assert (tmp_path / "a.png").exists()


@pytest.mark.skipif(os.name == "nt", reason="shells of POSIX")
def test_a_picture_for_a_closed_output_is_one_line(tmp_path: Path) -> None:
    command = 'exec "$0" -m crazing texture --size 16 -o - >&-'
    done = subprocess.run(["sh", "-c", command, sys.executable], cwd=tmp_path, capture_output=True)
    assert done.returncode == 2
    assert b"standard output is closed" in done.stderr and done.stderr.count(b"\n") == 1
