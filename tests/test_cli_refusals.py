"""What commands take alike, and what they say of what they do not take."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import crazing as cz
from command_line import refused, run
from crazing.measure import stamp

SEEDED = {
    "texture": "--size 16 -o a.png",
    "texture --maps mask": "--size 16 -o a.png",
    "maze": "-n 9 -o a.svg",
    "fit mask.png": "--budget 0 -o a.toml",
    "measure mask.png": "-o a.json",
    "dataset -n 1": "--size 16 -o a",
}


@pytest.mark.parametrize("command", SEEDED)
def test_every_command_takes_the_same_seeds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, command: str) -> None:
    monkeypatch.chdir(tmp_path)
    cz.save_png("mask.png", stamp(cz.crack(n=40, opening=0.5, rng=1), 200))
    good, bad = (run(*command.split(), "--seed", seed, *SEEDED[command].split()) for seed in (2**63 - 1, 2**63))
    assert good.exit_code == 0, good.output
    refused(bad, "9223372036854775808 is no seed; a whole number from 0 to 2**63 - 1 is wanted.")


@pytest.mark.parametrize("kind", ["picture", "drawing"])
def test_a_picture_or_drawing_is_refused_with_what_is_wanted(tmp_path: Path, kind: str) -> None:
    path = tmp_path / "leaf.png"
    if kind == "picture":
        cz.save_png(path, np.zeros((8, 8), bool))
    else:
        path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 L1 0 L0 1 Z"/></svg>')
    refused(run("edit", "--no-browser", path), f"leaf.png is a {kind}, which holds no points")
