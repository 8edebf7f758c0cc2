"""`crazing measure` and `crazing fit`, run as a user runs them."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

import crazing as cz
from crazing.measure import stamp


def run(folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "crazing", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    cz.save_png(tmp_path / "mask.png", stamp(cz.crack(n=60, opening=0.6, rng=1), 300))
    return tmp_path


def test_measure_prints_a_table_and_json(folder: Path) -> None:
    shown = run(folder, "measure", "mask.png", "--preset", "painting-italian")
    assert shown.returncode == 0, shown.stderr
    assert "i_nodes" in shown.stdout and "fI" in shown.stdout and "score" in shown.stdout
    found = json.loads(run(folder, "measure", "mask.png", "--json").stdout)
    exact = cz.measure(stamp(cz.crack(n=60, opening=0.6, rng=1), 300))
    assert found["t_share"] == exact.t_share and found["mask"] == "mask.png"


def test_fit_writes_a_recipe_that_can_be_read(folder: Path) -> None:
    shown = run(folder, "fit", "mask.png", "--budget", "2", "--seed", "1", "-o", "mine.toml")
    assert shown.returncode == 0, shown.stderr
    assert "seed 1" in shown.stdout
    recipe = cz.Recipe.load(folder / "mine.toml")
    assert 0 < recipe.opening <= 1 and "mask.png" in recipe.title


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("measure", "none.png"), "none.png"),
        (("measure", "mask.png", "--preset", "marble"), "marble"),
        (("measure", "mask.png", "--spur", "-1"), "spur"),
        (("fit", "mask.png", "-o", "mine.png"), ".toml"),
        (("fit", "mask.png", "--level", "2", "-o", "mine.toml"), "no line"),
    ],
)
def test_bad_input_is_one_line_and_two(folder: Path, arguments: tuple[str, ...], words: str) -> None:
    shown = run(folder, *arguments)
    assert shown.returncode == 2
    assert shown.stderr.count("\n") == 1 and words in shown.stderr
    assert not (folder / "mine.toml").exists()
