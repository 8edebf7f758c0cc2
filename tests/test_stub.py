"""The stub tells the truth about the compiled module, and typed programs can use the public names."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

PROGRAM = """
import numpy as np
from numpy.typing import NDArray

import crazing as cz


def skeleton(points: NDArray[np.float64]) -> NDArray[np.float64]:
    d: cz.Diagram = cz.diagram(points)
    s: cz.Skeleton = cz.medial_axis(d, method="one-step")
    g: cz.PlanarGraph = s.axis
    return g.segments


def picture(seed: int) -> NDArray[np.uint8]:
    m: cz.Maze = cz.maze(cz.sample.uniform(100, rng=seed), rng=seed)
    doors: NDArray[np.bool_] = m.open
    c: cz.Crack = cz.crack(m.diagram, rng=seed)
    print(doors.sum(), c.width.max())
    return cz.render(c, 64)


def places() -> NDArray[np.float64]:
    box = np.array([0.0, 0.0, 2.0, 1.0])
    points = cz.sample.uniform(20, bounds=box, rng=np.int64(3))
    cracks = cz.steps.widen(cz.steps.split(9, bounds=list(box), rng=1), width=0.1, source=box[:2])
    cz.render(cracks, (8, 16), bounds=box)
    return cz.sample.relax(points, iterations=1, bounds=box)


def refused() -> str:
    try:
        cz.crust([[0.0, 0.0], [1.0, 1.0]])
    except cz.DegenerateInputError as error:
        return str(error)
    return ""
"""
WRONG = "import crazing as cz\n\ncz.diagram()\ncz.maze([[0.0, 0.0]], cells=3)\n"


def mypy(program: str, folder: Path) -> subprocess.CompletedProcess[str]:
    (folder / "program.py").write_text(program)
    command = [sys.executable, "-m", "mypy", "--strict", "--config-file=", "program.py"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


def test_stub_matches_the_module(tmp_path: Path) -> None:
    # PyO3 makes this list out of every name; the names themselves are held below.
    (tmp_path / "allowed").write_text(r"crazing\._core\.__all__")
    command = [sys.executable, "-m", "mypy.stubtest", "crazing._core", "--allowlist", "allowed"]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr


def test_a_typed_program_is_accepted(tmp_path: Path) -> None:
    run = mypy(PROGRAM, tmp_path)
    assert run.returncode == 0, run.stdout + run.stderr


def test_wrong_calls_are_found(tmp_path: Path) -> None:
    run = mypy(WRONG, tmp_path)
    assert run.returncode == 1, run.stdout + run.stderr
    assert "program.py:3" in run.stdout
    assert "program.py:4" in run.stdout
