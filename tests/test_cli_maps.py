"""`crazing texture` with maps, `crazing presets` and `crazing rerun`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import Result

import crazing as cz
from command_line import run
from crazing.pictures.reading import record_of
from test_streaming import read

RECIPE = """
title = "Mine"

[recipe]
n = 40
opening = 0.3

[material]
grain = 0.1
crack = "#102030"
"""


def done(*words: object) -> Result:
    result = run(*words)
    assert result.exit_code == 0, result.output
    return result


def test_presets_are_listed_with_title_and_source() -> None:
    text = done("presets").stdout
    rows = json.loads(done("presets", "--json").stdout)
    assert tuple(rows) == cz.presets()
    for name in cz.presets():
        recipe = cz.preset(name)
        assert rows[name] == {"title": recipe.title, "citation": recipe.citation}
        assert name in text and recipe.title in text and recipe.citation in text


def test_all_maps_of_a_preset_without_a_seam(tmp_path: Path) -> None:
    words = ["--preset", "glaze", "--seed", 4, "--size", "120x80", "--seamless", "--maps", "all", "--json"]
    report = json.loads(done("texture", *words, "-o", tmp_path / "glaze").stdout)
    assert report["parameters"]["seed"] == 4 and report["parameters"]["preset"] == "glaze"
    files = [Path(file) for file in report["files"]]
    assert sorted(files) == sorted((tmp_path / "glaze").iterdir())
    assert {file.name for file in files} >= {"glaze.gltf", "glaze.mtlx", "color.png", "orm.png", "strand.png"}
    pattern = cz.preset("glaze").crack(period=(1.5, 1.0), rng=4)
    texture = cz.texture(pattern, (80, 120), maps="all", material="glaze", seed=4)
    np.testing.assert_array_equal(read(tmp_path / "glaze" / "color.png"), texture["color"])
    np.testing.assert_array_equal(read(tmp_path / "glaze" / "strand.png").astype(int) - 1, texture["strand"])
    assert len(pattern.graph.edges) == report["edges"]


@pytest.mark.parametrize(("size", "seamless"), [("90x70", True), ("97x31", True), ("31x97", False)])
def test_every_shape_of_picture(size, seamless, tmp_path) -> None:
    words = ["--preset", "mud-mature", "--seed", 1, "--size", size, *(["--seamless"] if seamless else [])]
    done("texture", *words, "-o", tmp_path / "a.png")
    width, height = map(int, size.split("x"))
    assert read(tmp_path / "a.png").shape == (height, width, 3)
    assert run("rerun", tmp_path / "a.png").exit_code == 0
    np.testing.assert_array_equal(read(tmp_path / "a.png"), read(tmp_path / "a.again.png"))


def test_a_recipe_of_ones_own_with_its_material(tmp_path) -> None:
    (tmp_path / "mine.toml").write_text(RECIPE)
    words = [
        "--recipe",
        tmp_path / "mine.toml",
        "--seed",
        2,
        "--size",
        64,
        "--layout",
        "ambientcg",
        "--format",
        "tiff16",
    ]
    done("texture", *words, "-o", tmp_path / "out")
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert {
        "mine_64-TIFF_Color.tif",
        "mine_64-TIFF_NormalGL.tif",
        "mine_64-TIFF_Displacement.tif",
        "mine.mtlx",
    } <= names
    made = record_of(tmp_path / "out" / "mine_64-TIFF_Color.tif")
    assert made["source"]["recipe"]["n"] == 40 and made["texture"]["material"]["grain"] == 0.1
    assert made["texture"]["material"]["crack"] == [16, 32, 48]


def test_options_change_the_recipe_where_they_are_given(tmp_path) -> None:
    words = ["--preset", "painting-dutch", "--seed", 2, "--size", 32]
    done("texture", *words, "--sites", 33, "--opening", 0.9, "-o", tmp_path / "a.png")
    done("texture", *words, "-o", tmp_path / "b.png")
    dutch = cz.preset("painting-dutch")
    changed, plain = (record_of(tmp_path / name)["source"]["recipe"] for name in ("a.png", "b.png"))
    assert (changed["n"], changed["opening"]) == (33, 0.9)
    assert plain == json.loads(json.dumps({**plain, "n": dutch.n, "opening": dutch.opening}))


@pytest.mark.parametrize("ending", [".png", ".tif", ".exr", ".zarr"])
def test_rerun_of_one_map(tmp_path, ending) -> None:
    first = tmp_path / f"height{ending}"
    words = ["--preset", "bark", "--size", 48, "--maps", "height", "--metres", 0.3]
    seed = json.loads(done("texture", *words, "--json", "-o", first).stdout)["parameters"]["seed"]
    result = json.loads(done("rerun", first, "-o", tmp_path / f"again{ending}", "--json").stdout)
    assert result["source"]["seed"] == seed
    np.testing.assert_array_equal(read(first), read(tmp_path / f"again{ending}"))


@pytest.mark.parametrize("words", [["--distribution", "laplace"], ["--width", 0.02, "--opening", 0.5, "--sites", 30]])
def test_rerun_of_a_plain_picture(tmp_path, words) -> None:
    done("texture", "--seed", 3, "--size", "60x40", *words, "-o", tmp_path / "a.png")
    done("rerun", tmp_path / "a.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "a.again.png").read_bytes()


def test_a_pattern_takes_the_material_of_another_preset(tmp_path) -> None:
    words = ["--preset", "ice", "--material", "bark", "--seed", 3, "--size", 40]
    done("texture", *words, "-o", tmp_path / "a.png")
    c = cz.preset("ice").crack(bounds=(0, 0, 1, 1), rng=3)
    wanted = cz.texture(c, 40, maps=["color"], material="bark", seed=3)["color"]
    np.testing.assert_array_equal(read(tmp_path / "a.png"), wanted)
    done("rerun", tmp_path / "a.png", "-o", tmp_path / "b.png")
    np.testing.assert_array_equal(read(tmp_path / "b.png"), wanted)


def test_frames_show_the_cracks_as_they_grow(tmp_path) -> None:
    words = ["--preset", "glaze", "--seed", 3, "--size", 64, "--frames", 4, "--maps", "mask"]
    report = json.loads(done("texture", *words, "--json", "-o", tmp_path / "mask.png").stdout)
    assert [Path(file).name for file in report["files"]] == [f"mask_{n:04d}.png" for n in (1, 2, 3, 4)]
    frames = [read(Path(file)).astype(int) for file in report["files"]]
    ink = [frame.sum() for frame in frames]
    assert ink == sorted(ink) and ink[0] < ink[-1]
    done("texture", *words[:-4], "--maps", "mask", "-o", tmp_path / "whole.png")
    np.testing.assert_array_equal(frames[-1], read(tmp_path / "whole.png"))
    done("rerun", report["files"][1], "-o", tmp_path / "again.png")
    np.testing.assert_array_equal(frames[1], read(tmp_path / "again.png"))
    report = json.loads(done("texture", *words[:-2], "--json", "-o", tmp_path / "frames").stdout)
    assert (tmp_path / "frames" / "0004" / "color.png").exists()


@pytest.mark.parametrize(
    ("made", "name", "again"),
    [
        ("a.png", "a", "a.again.png"),
        ("a.png", "a.tif", "a.again.png"),
        ("a.png", "a.PNG", "a.again.PNG"),
        ("a.tif", "a.tiff", "a.again.tiff"),
        ("a.tif", "a.png", "a.again.tif"),
        ("a.exr", "a 1.jpg", "a 1.again.exr"),
        ("a.zarr", "v1.2", "v1.again.zarr"),
        ("plain.png", "plain", "plain.again.png"),
    ],
)
def test_rerun_of_a_file_that_was_renamed(made, name, again, tmp_path) -> None:
    words = [] if made == "plain.png" else ["--maps", "color"]
    done("texture", "--seed", 3, "--size", 20, *words, "-o", tmp_path / made)
    wanted = read(tmp_path / made)
    (tmp_path / made).rename(tmp_path / name)
    done("rerun", tmp_path / name)
    assert {path.name for path in tmp_path.iterdir()} == {name, again}
    (tmp_path / again).rename(tmp_path / made)
    np.testing.assert_array_equal(read(tmp_path / made), wanted)


BAD = [
    (["--preset", "mudd"], "a", "mudd"),
    (["--preset", "mud"], "a", "did you mean 'mud-fresh' or 'mud-mature'?"),
    (["--preset", "Glaze"], "a", "did you mean 'glaze'?"),
    (["--preset", "glaze", "--opening", "0.5"], "a", "--opening does nothing for glaze"),
    (["--preset", "ice", "--distribution", "laplace"], "a", "--distribution does nothing for ice"),
    (["--preset", "glaze", "--material", "mud"], "a", "did you mean 'mud-"),
    (["--recipe", "table.toml"], "a", "did you mean 'material'?"),
    (["--opening", "0.5"], "a.tif", "--maps"),
    (["--opening", "0.5"], "a", "--maps"),
    (["--width", "-1"], "a.png", "of at least 0"),
    (["--preset", "glaze", "--recipe", "mine.toml"], "a", "one of them"),
    (["--recipe", "no.toml"], "a", "no.toml"),
    (["--recipe", "bad.toml"], "a", "bad.toml"),
    (["--recipe", "material.toml"], "a", "'grian' (did you mean 'grain'"),
    (["--maps", "all"], "a.png", "name a folder"),
    (["--maps", "color"], "a.jpg", "a.jpg ends in .jpg; .png, .tif"),
    (["--preset", "rock"], "a.SVG", "or a folder is wanted"),
    (["--preset", "rock", "--frames", "2"], "a.jpg", "or a folder is wanted"),
    (["--maps", "color,heigth"], "a", "heigth"),
    (["--maps", "all", "--format", "jpg"], "a", "jpg"),
    (["--maps", "mask", "--format", "png"], "a.exr", ".png"),
    (["--maps", "all", "--layout", "blender"], "a", "blender"),
    (["--maps", "all", "--name", "a/b"], "a", "a/b"),
    (["--maps", "all", "--metres", "0"], "a", "metres"),
    (["--metres", "0"], "a.png", "metres is 0"),
    (["--maps", "mask", "--metres", "1e-320"], "a.png", "metres is 1e-320"),
    (["--maps", "color"], "", "path is empty"),
    (["--maps", "mask", "--width", "1e300"], "a.png", "widths of at most 1e+30"),
    (["--maps", "color", "--frames", "2", "--layout", "blender"], "a", "blender"),
    (["--maps", "heigth", "--frames", "2"], "a", "heigth"),
    (["--maps", "mask"], "-", "standard output"),
    (["--maps", "mask"], "no/a.png", "folder"),
    (["--maps", "mask", "--frames", "0"], "a.png", "frames"),
    (["--maps", "mask", "--size", "9999999"], "a.png", "size"),
    (["--seamless", "--distribution", "cauchy"], "a.png", "cauchy"),
    (["--maps", "height", "--format", "exr16", "--size", "20000"], "a.exr", "stands in memory"),
]


@pytest.mark.parametrize(("words", "output", "part"), BAD)
def test_bad_combinations_are_one_line_and_code_2(words, output, part, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("mine.toml").write_text(RECIPE)
    Path("bad.toml").write_text("[recipe]\nn = ")
    Path("material.toml").write_text("[recipe]\n[material]\ngrian = 3\n")
    Path("table.toml").write_text("[recipe]\n[materiel]\ngrain = 0\n")
    before = sorted(tmp_path.iterdir())
    result = run("texture", "--seed", 1, "--size", 32, *words, "-o", output)
    assert result.exit_code == 2, result.output
    assert result.stdout == ""
    assert result.stderr.startswith("Error: ") and result.stderr.count("\n") == 1
    assert part in result.stderr
    assert sorted(tmp_path.iterdir()) == before


@pytest.mark.parametrize("name", ["no.png", "text.png", "empty"])
def test_rerun_of_nothing_is_one_line_and_code_2(name, tmp_path) -> None:
    (tmp_path / "text.png").write_text("text")
    (tmp_path / "empty").mkdir()
    result = run("rerun", tmp_path / name)
    assert result.exit_code == 2
    assert result.stderr.count("\n") == 1 and name in result.stderr


def test_a_plain_picture_is_made_again_as_what_it_is(tmp_path) -> None:
    done("texture", "--seed", 1, "--size", 8, "-o", tmp_path / "a.png")
    result = run("rerun", tmp_path / "a.png", "-o", tmp_path / "b.tif")
    assert result.exit_code == 2 and "does not end in .png" in result.stderr
    assert not (tmp_path / "b.tif").exists()


@pytest.mark.parametrize(("stem", "name"), [("mein Rezept 1", "mein-Rezept-1"), ("ü", "texture"), ("a" * 99, "a" * 64)])
def test_a_recipe_may_be_called_anything(stem: str, name: str, tmp_path: Path) -> None:
    """The name of its file becomes that of the material as far as one may hold it."""
    (tmp_path / f"{stem}.toml").write_text("[recipe]\nn = 20\n")
    words = ["--recipe", tmp_path / f"{stem}.toml", "--seed", 1, "--size", 16]
    done("texture", *words, "-o", tmp_path / "maps")
    assert (tmp_path / "maps" / f"{name}.mtlx").exists()
