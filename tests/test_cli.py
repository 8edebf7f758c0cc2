"""The command line: what it writes, what it prints, and how it fails."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crazing as cz
from command_line import refused, run

Image = pytest.importorskip("PIL.Image")

COMMAND = [sys.executable, "-m", "crazing"]


def test_texture_writes_a_picture_that_knows_how_it_was_made(tmp_path: Path) -> None:
    path = tmp_path / "crack.png"
    result = run("texture", "--seed", 7, "--size", "96x64", "--sites", 50, "-o", path)
    assert result.exit_code == 0, result.output
    assert result.stdout.startswith(f"{path}: 96 x 64 pixels")
    with Image.open(path) as picture:
        assert picture.size == (96, 64)
        made = json.loads(picture.text["crazing"])
        assert len(np.unique(np.asarray(picture).reshape(-1, 4), axis=0)) > 1
    assert made["algorithm_version"] == cz.algorithm_version
    assert made["version"] == cz.__version__
    assert made["command"] == "texture"
    assert made["parameters"]["seed"] == 7
    assert made["parameters"]["size"] == [96, 64]


@pytest.mark.parametrize("distribution", ["uniform", "normal", "laplace"])
@pytest.mark.parametrize("size", ["64", "90x40", "40x90"])
def test_texture_is_the_same_again_with_any_threads(distribution: str, size: str, tmp_path: Path) -> None:
    pictures = []
    for threads in (1, 2):
        path = tmp_path / f"{threads}.png"
        words = ["--distribution", distribution, "--size", size, "--sites", 40, "--threads", threads]
        result = run("texture", "--seed", 3, *words, "-o", path)
        assert result.exit_code == 0, result.output
        with Image.open(path) as picture:
            pictures.append(np.asarray(picture))
    np.testing.assert_array_equal(*pictures)


def test_texture_without_a_seed_keeps_the_one_it_drew(tmp_path: Path) -> None:
    first, second = tmp_path / "first.png", tmp_path / "second.png"
    made = json.loads(run("texture", "--size", 48, "--json", "-o", first).stdout)
    run("texture", "--size", 48, "--seed", made["parameters"]["seed"], "-o", second)
    assert made["output"] == str(first)
    with Image.open(first) as a, Image.open(second) as b:
        np.testing.assert_array_equal(np.asarray(a), np.asarray(b))


def test_texture_goes_to_standard_output(tmp_path: Path) -> None:
    words = ["texture", "--seed", "1", "--size", "32", "-o", "-"]
    done = subprocess.run([*COMMAND, *words], capture_output=True, check=True, cwd=tmp_path)
    assert done.stdout.startswith(b"\x89PNG")
    assert b"32 x 32 pixels" in done.stderr
    assert not list(tmp_path.iterdir())


def test_wide_and_closed_cracks_are_more_ink(tmp_path: Path) -> None:
    def dark(*words: object) -> float:
        assert run("texture", "--seed", 5, "--size", 128, *words, "-o", tmp_path / "a.png").exit_code == 0
        with Image.open(tmp_path / "a.png") as picture:
            # All of the ink: most cracks are narrower than a pixel.
            return 255 - float(np.asarray(picture)[..., 0].mean())

    assert dark("--width", 0.03) > 1.3 * dark("--width", 0.01)
    assert dark("--width", 0.01, "--opening", 0) > 1.05 * dark("--width", 0.01)


@pytest.mark.parametrize("distribution", ["normal", "laplace"])
def test_scattered_cracks_reach_every_side_and_are_densest_in_the_middle(distribution: str, tmp_path: Path) -> None:
    words = ["--seed", 4, "--size", "192x128", "--distribution", distribution, "-o", tmp_path / "a.png"]
    assert run("texture", *words).exit_code == 0
    with Image.open(tmp_path / "a.png") as picture:
        pixels = np.asarray(picture)[..., 0].astype(int)
    ink = pixels.max() - pixels
    for side in (ink[:24], ink[-24:], ink[:, :24], ink[:, -24:]):
        assert 0 < side.mean() < ink[48:80, 72:120].mean()


@pytest.mark.parametrize(
    ("words", "part"),
    [
        (["texture", "-o", "crack.jpg"], ".png"),
        (["texture", "-o", "crack"], ".png"),
        (["texture", "-o", "no/crack.png"], "folder"),
        (["texture"], "--output"),
        (["texture", "--size", "0", "-o", "a.png"], "size"),
        (["texture", "--size", "12x", "-o", "a.png"], "4096x2048"),
        (["texture", "--size", "-5", "-o", "a.png"], "size"),
        (["texture", "--size", "9999999", "-o", "a.png"], "size"),
        (["texture", "--sites", "2", "-o", "a.png"], "sites"),
        (["texture", "--seed", "-1", "-o", "a.png"], "seed"),
        (["texture", "--seed", "x", "-o", "a.png"], "seed"),
        (["texture", "--width", "nan", "-o", "a.png"], "width"),
        (["texture", "--width", "-1", "-o", "a.png"], "width"),
        (["texture", "--distribution", "cauchy", "-o", "a.png"], "laplace"),
        (["texture", "--threads", "0", "-o", "a.png"], "threads"),
        (["compare", "nothing.png", "-o", "a.png"], "nothing.png"),
        (["compare", "text.png", "-o", "a.png"], "text.png"),
        (["compare", ".", "-o", "a.png"], "directory"),
        (["compare", "blob.png", "--first", "guess", "-o", "a.png"], "guess"),
        (["compare", "blob.png", "--points", "2", "-o", "a.png"], "points"),
        (["compare", "blob.png", "--points", "100000000", "-o", "a.png"], "points"),
        (["compare", "blob.png", "--sizes", "9,x"], "sizes"),
        (["compare", "blob.png", "--sizes", "2,9"], "sizes"),
        (["compare", "blob.png", "--sizes", "9", "--points", "9"], "points"),
        (["compare", "blob.png", "--level", "x", "-o", "a.png"], "level"),
        (["compare", "blob.png", "--dpi", "0", "-o", "a.png"], "dpi"),
        (["fly"], "fly"),
        (["--fly"], "--fly"),
        ([], "--help"),
        (["texture", "--fly"], "texture --help"),
    ],
)
def test_bad_input_is_one_line_and_code_2(
    words: list[str], part: str, blob: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(blob.parent)
    Path("text.png").write_text("no picture")
    refused(run(*words), part)
    assert sorted(path.name for path in Path().iterdir()) == ["blob.png", "text.png"]


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (MemoryError(), "out of memory"),
        (ImportError("contourpy is not installed"), "contourpy is not installed"),
        (OSError(28, "No space left on device", "a.png"), "a.png: No space left on device"),
        (cz.DegenerateInputError("2 distinct sites"), "2 distinct sites"),
        (TypeError("two\nlines"), "two lines"),
    ],
)
def test_failures_of_the_work_are_one_line(
    error: Exception, words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr(cz, "render", fail)
    refused(run("texture", "--size", 32, "-o", tmp_path / "a.png"), words)
    assert not list(tmp_path.iterdir())


def test_compare_studies_sizes(blob: Path, tmp_path: Path) -> None:
    path = tmp_path / "figure.png"
    result = run("compare", blob, "--sizes", "40, 90", "--json", "--dpi", 30, "-o", path)
    assert result.exit_code == 0
    rows = json.loads(result.output)
    assert [row["samples"] for row in rows] == [40, 40, 90, 90]
    assert path.read_bytes().startswith(b"\x89PNG")
    assert "90  edge-filter" in run("compare", blob, "--sizes", "40,90").output


def test_compare_writes_the_figure_and_prints_the_table(blob: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    pytest.importorskip("contourpy")
    path = tmp_path / "figure.png"
    result = run("compare", blob, "--points", 150, "--dpi", 50, "-o", path)
    assert result.exit_code == 0, result.output
    assert result.stdout.split()[:2] == ["one-step", "edge-filter"]
    assert "axis edges" in result.stdout
    with Image.open(path) as picture:
        assert picture.format == "PNG"
        assert picture.width == 650


def test_compare_takes_methods_and_levels(blob: Path, tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    pytest.importorskip("contourpy")
    words = ["--first", "initial", "--second", "one-step", "--level", 0.3, "--level", 0.7, "--dpi", 40]
    result = run("compare", blob, *words, "-o", tmp_path / "figure.png")
    assert result.exit_code == 0, result.output
    assert result.stdout.split()[:2] == ["initial", "one-step"]


@pytest.mark.parametrize("words", [["--help"], ["texture", "--help"], ["compare", "-h"]])
def test_help_says_how(words: list[str]) -> None:
    result = run(*words)
    assert result.exit_code == 0
    assert result.stdout.startswith("Usage: ")


@pytest.mark.parametrize(
    "name", ["texture", "skeleton", "compare", "maze", "measure", "fit", "dataset", "edit", "presets", "rerun"]
)
def test_every_command_takes_a_seed_and_an_output(name: str) -> None:
    words = run(name, "--help").stdout
    assert "--seed" in words
    assert "-o, --output" in words


def test_a_seed_changes_nothing_where_nothing_is_random(blob: Path, tmp_path: Path) -> None:
    for seed in (1, 2):
        run("skeleton", blob, "--seed", seed, "-o", tmp_path / f"{seed}.svg")
    assert (tmp_path / "1.svg").read_bytes() == (tmp_path / "2.svg").read_bytes()


def test_a_misspelt_command_is_asked_about() -> None:
    refused(run("textur"), "No such command 'textur' (did you mean 'texture'?).")
    refused(run("zzz"), "No such command 'zzz'. See")


def test_presets_are_written_once_and_make_textures(tmp_path: Path) -> None:
    folder = tmp_path / "mine"
    assert run("presets", "-o", folder).exit_code == 0
    assert {path.stem for path in folder.iterdir()} == set(cz.presets())
    assert cz.Recipe.load(folder / "glaze.toml") == cz.preset("glaze")
    refused(run("presets", "-o", folder), "asphalt-alligator.toml is there already")
    picture = tmp_path / "glaze.png"
    assert run("texture", "--recipe", folder / "glaze.toml", "--size", 32, "-o", picture).exit_code == 0


def test_a_maze_tells_what_it_is_as_json(tmp_path: Path) -> None:
    done = run("maze", "-n", 60, "--seed", 3, "--json", "-o", tmp_path / "maze.svg")
    found = json.loads(done.stdout)
    assert (found["cells"], found["seed"], found["output"]) == (60, 3, str(tmp_path / "maze.svg"))
    assert {"dead_ends", "junctions", "solution", "winding"} < found.keys()


def test_module_and_version() -> None:
    done = subprocess.run([*COMMAND, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"crazing {cz.__version__}\n"


def test_help_needs_no_optional_package() -> None:
    program = """
import sys
from crazing.cli import main
try:
    main(["texture", "--help"])
except SystemExit:
    pass
assert not {"matplotlib", "PIL", "contourpy", "rich.progress"} & sys.modules.keys()
"""
    subprocess.run([sys.executable, "-c", program], check=True, capture_output=True)


def test_a_missing_package_is_named(blob: Path, tmp_path: Path) -> None:
    program = f"""
import sys

class Missing:
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] == "matplotlib":
            raise ModuleNotFoundError(name, name="matplotlib")

sys.meta_path.insert(0, Missing)
from crazing.cli import main
main(["compare", {str(blob)!r}, "-o", {str(tmp_path / "figure.png")!r}])
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 2
    assert done.stderr.startswith("Error: matplotlib is not installed")
    assert "crazing[plot]" in done.stderr


@pytest.mark.skipif(os.name == "nt", reason="signals and pipes of POSIX")
def test_ctrl_c_is_quiet_and_leaves_nothing(tmp_path: Path) -> None:
    words = ["texture", "--size", "16384", "--sites", "20000", "-o", "crack.png"]
    child = subprocess.Popen([*COMMAND, *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while not list(tmp_path.iterdir()) and child.poll() is None:
        time.sleep(0.005)  # Until it is at work: the file has begun.
    child.send_signal(signal.SIGINT)
    output, errors = child.communicate(timeout=20)
    assert child.returncode == 130, errors
    assert b"Traceback" not in errors
    assert output == b""
    assert not list(tmp_path.iterdir())


@pytest.mark.skipif(os.name == "nt", reason="signals and pipes of POSIX")
def test_a_closed_pipe_is_quiet(tmp_path: Path) -> None:
    words = ["texture", "--seed", "1", "--size", "1024", "-o", "-"]
    child = subprocess.Popen([*COMMAND, *words], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert child.stdout is not None
    child.stdout.close()
    assert child.stderr is not None
    assert child.stderr.read() == b""
    assert child.wait(timeout=60) != 0
    child.stderr.close()


@pytest.mark.skipif(os.name == "nt", reason="terminals of POSIX")
def test_a_picture_is_not_written_to_a_terminal(tmp_path: Path) -> None:
    import pty

    ours, theirs = pty.openpty()
    words = ["texture", "--size", "32", "-o", "-"]
    done = subprocess.run([*COMMAND, *words], cwd=tmp_path, stdout=theirs, stderr=subprocess.PIPE)
    os.close(theirs)
    os.close(ours)
    assert done.returncode == 2
    assert b"terminal" in done.stderr
