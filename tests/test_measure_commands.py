"""`crazing measure` and `crazing fit`, run as a user runs them."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

import crazing as cz
from crazing.cli.fit import command
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


def test_ranges_of_a_preset_are_compared_with_too(folder: Path) -> None:
    """Of a preset without measured masks, as most are, nothing at all was said."""
    within = cz.targets("glaze").within(cz.measure(stamp(cz.crack(n=60, opening=0.6, rng=1), 300)))
    shown = run(folder, "measure", "mask.png", "--preset", "glaze").stdout
    assert f"{sum(within.values())} of {len(within)} in the ranges of glaze" in shown
    assert all((f"{name} is not from " in shown) != met for name, met in within.items())
    told = json.loads(run(folder, "measure", "mask.png", "--preset", "glaze", "--json").stdout)
    assert told["within"] == within and told["deviations"] == {} and not all(within.values())


def test_a_fit_asks_first_whether_its_file_can_be_written(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("os.access", lambda *_: False)
    monkeypatch.chdir(folder)
    done = CliRunner().invoke(command, ["mask.png", "-o", "mine.toml"])
    assert done.exit_code == 2 and "the folder of 'mine.toml' cannot be written to" in done.output


def test_a_fit_to_a_file_of_any_name_is_written(folder: Path) -> None:
    name = os.fsdecode(b"caf\xe9.png")
    (folder / "mask.png").rename(folder / name)
    assert run(folder, "fit", name, "--budget", "0", "-o", "mine.toml").returncode == 0
    assert cz.Recipe.load(folder / "mine.toml").title == "Fit to caf?.png"


def test_a_frame_is_told(folder: Path) -> None:
    """It closes what goes on outside: of a mask with an opening of .66 a fit said .30."""
    framed = np.pad(stamp(cz.crack(n=60, opening=0.6, rng=1), 300), 3, constant_values=True)
    cz.save_png(folder / "framed.png", framed)
    for words in (("measure",), ("fit", "--budget", "0", "-o", "mine.toml")):
        assert "Note: framed.png is crack all along its sides" in run(folder, *words, "framed.png").stderr
        assert run(folder, *words, "mask.png").stderr == ""


def test_measure_writes_what_it_prints(folder: Path) -> None:
    shown = run(folder, "measure", "mask.png", "--json", "-o", "found.json")
    assert (folder / "found.json").read_text() == shown.stdout
    run(folder, "measure", "mask.png", "-o", "found.csv")
    rows = dict(line.split(",") for line in (folder / "found.csv").read_text().splitlines())
    found = json.loads(shown.stdout)
    assert {name: float(value) if value else None for name, value in rows.items()} == {
        name: value for name, value in found.items() if name != "mask"
    }


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
        (("measure", "mask.png", "-o", "found.txt"), ".json, .csv"),
        (("fit", "mask.png", "-o", "mine.png"), ".toml"),
        (("fit", "mask.png", "--level", "2", "-o", "mine.toml"), "--level"),
        (("measure", "mask.png", "--preset", "italian"), "did you mean 'painting-italian'?"),
    ],
)
def test_bad_input_is_one_line_and_two(folder: Path, arguments: tuple[str, ...], words: str) -> None:
    shown = run(folder, *arguments)
    assert shown.returncode == 2
    assert shown.stderr.count("\n") == 1 and words in shown.stderr
    assert not (folder / "mine.toml").exists()


ODD = {
    "inverted": (lambda mask: ~mask, "inverted.png is taken for crack; with --dark, what is dark would be."),
    "black": (lambda mask: np.zeros_like(mask), "black.png has no pixel above level 0.5: no crack. See --level"),
    "white": (lambda mask: np.ones_like(mask), "100% of white.png is taken for crack."),
    "pixel": (lambda mask: np.eye(1, dtype=bool), "100% of pixel.png is taken for crack."),
    "dot": (lambda mask: np.arange(mask.size).reshape(mask.shape) == 45_000, "no line with an end or a junction"),
    "strip": (lambda mask: mask[:40], "nodes within 20 pixels of its sides are not measured"),
    "faint": (lambda mask: (mask * 100).astype(np.uint8), "faint.png has no pixel above level 0.5"),
}


@pytest.mark.parametrize("kind", ODD)
def test_fit_says_once_what_is_wrong_with_a_mask(folder: Path, kind: str) -> None:
    made, words = ODD[kind]
    cz.save_png(folder / f"{kind}.png", made(stamp(cz.crack(n=60, opening=0.6, rng=1), 300)))
    shown = run(folder, "fit", f"{kind}.png", "--budget", "0", "-o", "mine.toml")
    assert (shown.returncode, shown.stdout) == (2, "")
    assert shown.stderr.startswith("Error: ") and shown.stderr.count("\n") == 1 and words in shown.stderr


@pytest.mark.parametrize("kind", ["grey", "colour", "deep", "alpha"])
def test_fit_takes_any_kind_of_picture_of_a_mask(folder: Path, kind: str) -> None:
    mask = stamp(cz.crack(n=60, opening=0.6, rng=1), 300)
    bright = (mask * 255).astype(np.uint8)
    made = {"grey": bright, "colour": np.dstack([bright] * 3), "deep": (mask * 65535).astype(np.uint16)}
    made["alpha"] = np.dstack([bright] * 3 + [np.full_like(bright, 255)])
    cz.save_png(folder / f"{kind}.png", made[kind])
    for name in (kind, "mask"):
        shown = run(folder, "fit", f"{name}.png", "--budget", "0", "--seed", "1", "-o", f"{name}.toml")
        assert (shown.returncode, shown.stderr) == (0, "")
    assert cz.Recipe.load(folder / f"{kind}.toml") == cz.Recipe.load(folder / "mask.toml")


def test_masks_of_zeros_and_ones_are_masks(folder: Path) -> None:
    mask = stamp(cz.crack(n=60, opening=0.6, rng=1), 300)
    cz.save_png(folder / "ones.png", mask.astype(np.uint8))
    shown = run(folder, "measure", "ones.png")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert shown.stdout == run(folder, "measure", "mask.png").stdout
    for integers in (np.uint8, np.int32, np.uint16):
        assert cz.measure(mask.astype(integers)) == cz.measure(mask)
    with pytest.raises(TypeError, match="read_image"):
        cz.measure("mask.png")
    # Two is no mask of zeros and ones, and hardly brighter than black.
    assert cz.measure(2 * mask.astype(np.uint8)).nodes == 0


@pytest.mark.parametrize(
    ("picture", "options", "words"),
    [
        (np.zeros((60, 60), np.uint8), (), "no crack"),
        (np.full((60, 60), 255, np.uint8), (), "100% of"),
        (np.full((60, 60), 255, np.uint8), ("--dark",), "no crack"),
        (
            255 * (np.indices((400, 400)).sum(axis=0) % 20 < 2).astype(np.uint8) * (np.arange(400) % 40 < 30),
            (),
            "pieces",
        ),
    ],
)
def test_what_is_hardly_a_mask_is_remarked_on(tmp_path: Path, picture, options, words: str) -> None:
    cz.save_png(tmp_path / "odd.png", picture.astype(np.uint8))
    shown = run(tmp_path, "measure", "odd.png", "--json", *options)
    assert shown.returncode == 0 and json.loads(shown.stdout)["mask"] == "odd.png"
    assert shown.stderr.startswith("Note: ") and shown.stderr.count("\n") == 1 and words in shown.stderr


def test_fit_says_how_far_it_is_off(folder: Path) -> None:
    shown = run(folder, "fit", "mask.png", "--budget", "3", "--seed", "1", "--json", "-o", "mine.toml")
    told = json.loads(shown.stdout)
    recipe = cz.Recipe.load(folder / "mine.toml")
    assert (told["n"], told["opening"], told["seed"]) == (recipe.n, recipe.opening, 1) and 0 < told["off"] < 4


@pytest.mark.parametrize("shape", ["ring", "dot"])
def test_what_cannot_be_divided_is_null_in_json(tmp_path: Path, shape: str) -> None:
    far = np.hypot(*(np.indices((64, 64)) - 32))
    cz.save_png(tmp_path / "odd.png", (255 * (abs(far - 20) < 2 if shape == "ring" else far < 2)).astype(np.uint8))

    def refuse(token: str) -> None:
        raise AssertionError(token)

    shown = run(tmp_path, "measure", "odd.png", "--preset", "glaze", "--json", "-o", "odd.json")
    found = json.loads(shown.stdout, parse_constant=refuse)
    assert found == json.loads((tmp_path / "odd.json").read_text(), parse_constant=refuse)
    assert found["loops_per_junction"] is None and found["loops"] == (shape == "ring")
