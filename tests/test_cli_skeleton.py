"""`crazing skeleton`: what it finds, writes and refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from command_line import refused, run

Image = pytest.importorskip("PIL.Image")


@pytest.mark.parametrize("ending", [".svg", ".dxf", ".geojson", ".png"])
def test_skeleton_of_a_picture_has_no_hairs_from_its_pixels(blob: Path, tmp_path: Path, ending: str) -> None:
    path = tmp_path / f"axis{ending}"
    result = run("skeleton", blob, "--json", "-o", path)
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    # Two discs that overlap: one line from middle to middle.
    assert (found["components"], found["leaves"]) == (1, 2)
    assert found["length"] == pytest.approx(30, abs=4)
    assert path.stat().st_size > 0


def test_skeleton_keeps_hairs_when_asked(blob: Path, tmp_path: Path) -> None:
    path = tmp_path / "axis.geojson"
    assert json.loads(run("skeleton", blob, "--hairs", "--json", "-o", path).stdout)["leaves"] > 10
    lines = json.loads(path.read_text())
    assert lines["type"] == "MultiLineString" or lines["type"].startswith("Feature")


@pytest.mark.parametrize("part", ["inner", "main", "axis", "crust"])
@pytest.mark.parametrize("method", ["initial", "poles", "edge-filter", "one-step"])
def test_skeleton_by_every_method(part: str, method: str, tmp_path: Path) -> None:
    angle = np.linspace(0, 2 * np.pi, 120, endpoint=False)
    ellipse = np.column_stack([10 + 2 * np.cos(angle), np.sin(angle)])
    np.savetxt(tmp_path / "ellipse.csv", ellipse, delimiter=",")
    words = ["--method", method, "--part", part, "--json", "-o", tmp_path / "out.geojson"]
    result = run("skeleton", tmp_path / "ellipse.csv", *words)
    assert result.exit_code == 0, result.output
    found = json.loads(result.stdout)
    assert found["samples"] == 120
    if part == "crust" and method != "initial":
        assert found["edges"] == 120
    if part == "main":
        assert found["length"] == pytest.approx(3, abs=0.3)
    # The outer axis runs off to infinity; what is written stays near.
    assert found["length"] < 400


def test_skeleton_of_a_drawing(tmp_path: Path) -> None:
    pytest.importorskip("svgpathtools")
    path = tmp_path / "bar.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0 H80 V10 H0 Z"/></svg>')
    result = run("skeleton", path, "--spacing", 0.5, "--part", "main", "--json", "-o", tmp_path / "main.svg")
    assert json.loads(result.stdout)["length"] == pytest.approx(70 + 2 * 5 * 2**0.5, rel=0.05)


def test_skeleton_refuses_what_it_cannot_do(blob: Path, tmp_path: Path) -> None:
    points = tmp_path / "points.csv"
    points.write_text("0,0\n1,0\n0,1\n1,1\n")
    out = tmp_path / "x.svg"
    refused(run("skeleton", blob, "--points", 9, "--spacing", 2, "-o", out), "--points", "--spacing")
    refused(run("skeleton", points, "--points", 9, "-o", out), "as they are")
    refused(run("skeleton", points, "-o", tmp_path / "x.txt"), ".txt", ".svg")
    refused(run("skeleton", points, "--method", "magic", "-o", out), "magic", "one-step")
    points.write_text("0,0\n1,zero\n")
    refused(run("skeleton", points, "-o", out), "line 2")
    assert not out.exists()
