"""Data sets: labels that fit the pattern, pictures that depend on nothing but key and index, folders that grow."""

from __future__ import annotations

import csv
import json
import pickle
from pathlib import Path

import numpy as np
import pytest

import crazing as cz
from command_line import refused, run

Image = pytest.importorskip("PIL.Image")
LABELS = ("mask", "coverage", "strand", "cell", "distance")


def files(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("index", range(6))
def test_labels_agree_with_each_other(index: int) -> None:
    made = cz.dataset(6, size=(96, 128), labels=LABELS, thinnest=0, rng=3)[index]
    coverage, distance, strand = (made.labels[name] for name in ("coverage", "distance", "strand"))
    assert made.image.shape == (96, 128, 3)
    assert all(label.shape == (96, 128) for label in made.labels.values())
    np.testing.assert_array_equal(made.labels["mask"] == 255, coverage >= 128)
    # A strand is named as far as half a pixel from its edge.
    np.testing.assert_array_equal(strand >= 0, distance < 0.5)
    # Farther than half a diagonal, .71, from every edge a pixel is all crack or none.
    far = np.abs(distance) > 0.75
    assert set(np.unique(coverage[far & (distance > 0)])) <= {0}
    assert set(np.unique(coverage[far & (distance < 0)])) <= {255}
    assert made.labels["cell"].min() >= 0
    assert len(np.unique(made.labels["cell"])) > 1


def test_distance_is_in_pixels() -> None:
    shapely = pytest.importorskip("shapely")
    made = cz.dataset(1, presets="rock", size=(80, 60), labels="distance", rng=5)[0]
    shapes = [
        shapely.MultiPoint(ends).buffer(1e-12) if w.max() == 0 else shapely.LineString(ends)
        for ends, w in zip(made.crack.segments, made.crack.width, strict=True)
    ]
    tree = shapely.STRtree(shapes)
    for row, column in ((3, 4), (40, 30), (70, 55), (20, 48)):
        middle = shapely.Point((column + 0.5) / 80, 1 - (row + 0.5) / 80)
        to_line = 80 * shapes[tree.nearest(middle)].distance(middle)
        # The edge of a crack is at most its widest half width from its middle line.
        assert to_line - 40 * made.crack.width.max() <= made.labels["distance"][row, column] <= to_line + 1e-3


@pytest.mark.parametrize("preset", ["porcelain", "glaze", "glass-impact", "painting-dutch", "ice"])
def test_masks_of_hairlines_are_whole(preset: str) -> None:
    ndimage = pytest.importorskip("scipy.ndimage")
    made = cz.dataset(1, presets=preset, size=256, rng=5)[0]
    pieces = ndimage.label(made.labels["mask"], np.ones((3, 3)))[1]
    assert pieces <= made.crack.graph.components
    bare = cz.dataset(1, presets=preset, size=256, thinnest=0, rng=5)[0]
    assert ndimage.label(bare.labels["mask"], np.ones((3, 3)))[1] > pieces
    assert (made.labels["mask"] >= bare.labels["mask"]).all()


def test_a_picture_depends_on_key_and_index_alone() -> None:
    small, large = (cz.dataset(n, size=48, labels=LABELS, rng=9) for n in (4, 400))
    a, b = small[-1], pickle.loads(pickle.dumps(large))[3]
    np.testing.assert_array_equal(a.image, b.image)
    for name in LABELS:
        np.testing.assert_array_equal(a.labels[name], b.labels[name])
    assert a.crack == b.crack
    assert small.drawn(3) == large.drawn(3)
    other = cz.dataset(4, size=48, rng=10)[3]
    assert not np.array_equal(other.image, a.image)


def test_pictures_compare_by_what_they_hold() -> None:
    data = cz.dataset(2, size=16, labels=LABELS, rng=1)
    made = data[0]
    assert made == data[0] == pickle.loads(pickle.dumps(made)) != data[1]
    made.labels["mask"][0, 0] ^= 255
    assert made != data[0]


def test_what_is_drawn_for_no_picture() -> None:
    data = cz.dataset(3, size=16, rng=1)
    for index in (3, -1):
        with pytest.raises(ValueError, match=f"index is {index}; it must be from 0 to 2"):
            data.drawn(index)


def test_is_a_sequence() -> None:
    data = cz.dataset(3, size=16, presets=["rock"], rng=1)
    assert len(data) == 3
    assert [made.index for made in data] == [made.index for made in data[:]] == [0, 1, 2]
    assert data[-1].index == 2
    assert data[np.int64(1)].index == 1
    for index in (3, -4):
        with pytest.raises(IndexError, match="has 3 pictures"):
            data[index]
    assert repr(data[0]) == "LabelledImage(0, 16 x 16, 'rock', mask)"


def test_chances_are_as_said() -> None:
    data = cz.dataset(1500, presets=["rock", "ice"], zoom=3, rng=2)
    drawn = [data.drawn(i) for i in range(1500)]
    # Five standard deviations of a binomial.
    for name, share in (("train", 0.8), ("val", 0.1), ("test", 0.1)):
        assert sum(one["split"] == name for one in drawn) / 1500 == pytest.approx(
            share, abs=5 * (share * (1 - share) / 1500) ** 0.5
        )
    assert sum(one["preset"] == "ice" for one in drawn) / 1500 == pytest.approx(0.5, abs=0.065)
    plates = [one["plates"] / cz.preset(one["preset"]).n for one in drawn]
    assert 0.32 < min(plates) < 0.36
    assert 2.8 < max(plates) < 3.02


def test_a_folder_holds_everything_and_grows(tmp_path: Path) -> None:
    options = {"size": (40, 56), "labels": LABELS, "rng": 6}
    whole = tmp_path / "whole"
    assert cz.dataset(9, **options).write(whole, threads=3) == 9
    parts = tmp_path / "parts"
    told: list[tuple[int, int]] = []
    assert cz.dataset(4, **options).write(parts, threads=1) == 4
    assert cz.dataset(9, **options).write(parts, threads=2, progress=lambda *done: told.append(done)) == 5
    assert told == [(k, 9) for k in range(5, 10)]
    assert files(whole) == files(parts)
    assert cz.dataset(9, **options).write(parts) == 0
    with (whole / "images.csv").open() as file:
        lines = list(csv.DictReader(file))
    data = cz.dataset(9, **options)
    assert len(lines) == 9
    for i, line in enumerate(lines):
        made, path = data[i], whole / line["file"]
        assert line["split"] == made.split == path.parts[-3]
        with Image.open(path) as picture:
            np.testing.assert_array_equal(np.asarray(picture), made.image)
        for label, name in (("mask", "masks"), ("coverage", "coverage")):
            with Image.open(path.parents[1] / name / path.name) as picture:
                np.testing.assert_array_equal(np.asarray(picture), made.labels[label])
        for label, name in (("strand", "strands"), ("cell", "cells")):
            with Image.open(path.parents[1] / name / path.name) as picture:
                np.testing.assert_array_equal(np.asarray(picture).astype(int) - 1, made.labels[label])
        distances = np.load(path.parents[1] / "distances" / f"{path.stem}.npy")
        np.testing.assert_array_equal(distances, made.labels["distance"])


def test_what_is_missing_is_made_again(tmp_path: Path) -> None:
    data = cz.dataset(3, size=24, rng=6)
    data.write(tmp_path)
    before = files(tmp_path)
    lost = next(tmp_path.glob("*/masks/*.png"))
    lost.unlink()
    assert data.write(tmp_path) == 1
    assert files(tmp_path) == before


def test_a_smaller_one_forgets_no_picture(tmp_path: Path) -> None:
    options = {"presets": "rock", "size": 16, "rng": 6}
    cz.dataset(5, **options).write(tmp_path)
    before = files(tmp_path)
    assert cz.dataset(2, **options).write(tmp_path) == 0
    assert files(tmp_path) == before
    # The last is gone: the folder says no more of it.
    split = cz.dataset(5, **options).drawn(4)["split"]
    (tmp_path / split / "images" / "000004.png").unlink()
    cz.dataset(2, **options).write(tmp_path)
    assert json.loads((tmp_path / "dataset.json").read_text())["parameters"]["n"] == 4
    with (tmp_path / "images.csv").open() as file:
        told = [line["file"] for line in csv.DictReader(file)]
    assert sorted(told) == sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.glob("*/images/*"))


def test_a_killed_process_leaves_nothing_among_the_pictures(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the renaming, as if killed just before it, and with nobody there to take anything away."""
    data = cz.dataset(1, size=16, labels=LABELS, rng=6)

    def killed(*_: object) -> None:
        raise RuntimeError("killed")

    monkeypatch.setattr("os.replace", lambda source, target: killed() if "json" not in str(target) else None)
    monkeypatch.setattr("os.unlink", lambda _: None)
    with pytest.raises(RuntimeError, match="killed"):
        data.write(tmp_path)
    left = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert left and all(path.parent == tmp_path for path in left)
    monkeypatch.undo()
    assert data.write(tmp_path) == 1
    assert all(path.suffix in (".png", ".npy") for path in tmp_path.glob("*/*/*"))


def test_no_name_is_no_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError, match="a folder is wanted"):
        cz.dataset(1, size=16).write("")
    refused(run("dataset", "-n", 1, "--size", 16, "-o", ""), "names no folder")
    assert not list(tmp_path.iterdir())


def test_another_data_set_is_refused(tmp_path: Path) -> None:
    cz.dataset(2, size=24, rng=6).write(tmp_path)
    before = files(tmp_path)
    with pytest.raises(cz.CrazingError, match="another data set: its size is"):
        cz.dataset(2, size=32, rng=6).write(tmp_path)
    with pytest.raises(cz.CrazingError, match=r"another data set: it was made with another seed; another folder"):
        cz.dataset(2, size=24, rng=7).write(tmp_path)
    assert files(tmp_path) == before
    (tmp_path / "dataset.json").write_text("{")
    with pytest.raises(cz.CrazingError, match="damaged"):
        cz.dataset(2, size=24, rng=6).write(tmp_path)


def test_a_failure_comes_out_and_stops_the_rest(tmp_path: Path) -> None:
    def failing(done: int, total: int) -> None:
        raise RuntimeError("stopped here")

    with pytest.raises(RuntimeError, match="stopped here"):
        cz.dataset(50, size=16, rng=6).write(tmp_path, threads=2, progress=failing)
    assert len(list(tmp_path.glob("*/images/*.png"))) < 10
    assert not list(tmp_path.rglob(".tmp-*"))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"n": 0}, "n is 0"),
        ({"presets": ["clay"]}, r"presets\[0\]"),
        ({"presets": []}, "one name or more"),
        ({"labels": ["mask", "mask"]}, "twice"),
        ({"labels": "depth"}, r"labels\[0\]"),
        ({"zoom": 0.5}, "zoom"),
        ({"thinnest": -1}, "thinnest"),
        ({"size": (0, 3)}, "size"),
    ],
)
def test_bad_arguments_are_named(options: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        cz.dataset(**{"n": 3, **options})


def test_the_command_makes_the_same_folder(tmp_path: Path) -> None:
    words = ["--size", "32x24", "--labels", "mask,strand", "--seed", 4, "--preset", "rock", "--preset", "ice"]
    result = run("dataset", "-n", 3, *words, "--json", "-o", tmp_path / "told")
    assert result.exit_code == 0, result.output
    told = json.loads(result.stdout)
    assert told["pictures"] == told["made"] == told["train"] + told["val"] + told["test"] == 3
    cz.dataset(3, presets=["rock", "ice"], size=(24, 32), labels=["mask", "strand"], rng=4).write(tmp_path / "called")
    assert files(tmp_path / "told") == files(tmp_path / "called")


def test_the_same_command_without_a_seed_goes_on(tmp_path: Path) -> None:
    words = ["--size", 24, "--preset", "rock,ice", "--preset", "glaze"]
    assert run("dataset", "-n", 2, *words, "-o", tmp_path / "a").exit_code == 0
    before = files(tmp_path / "a")
    result = run("dataset", "-n", 4, *words, "--json", "-o", tmp_path / "a")
    assert result.exit_code == 0, result.output
    told, after = json.loads(result.stdout), files(tmp_path / "a")
    assert told["made"] == 2 and told["seed"] is None
    pictures = [name for name in before if name.endswith(("0.png", "1.png"))]
    assert len(pictures) == 4 and all(before[name] == after[name] for name in pictures)
    assert "the seed it had" in run("dataset", "-n", 4, *words, "-o", tmp_path / "a").stdout
    refused(run("dataset", "-n", 4, *words, "--seed", 5, "-o", tmp_path / "a"), "another seed")


def test_the_command_refuses(tmp_path: Path) -> None:
    refused(run("dataset", "--preset", "clay", "-o", tmp_path / "a"), "clay", "rock")
    refused(run("dataset", "-o", tmp_path / "no" / "folder"), "lies in no folder")
    refused(run("dataset", "--size", "big", "-o", tmp_path / "a"), "'big'")
    assert not (tmp_path / "a").exists()


def test_labels_come_as_asked_for_and_may_be_written_to() -> None:
    asked = ["strand", "mask", "distance", "coverage", "cell"]
    made = cz.dataset(1, presets="glaze", size=32, labels=asked, rng=1)[0]
    assert list(made.labels) == asked
    for array in (made.image, *made.labels.values()):
        assert array.flags.writeable and array.flags.owndata and array.flags.c_contiguous
    with pytest.raises(TypeError, match="index is 'mask'; an integer or a slice"):
        cz.dataset(1)["mask"]
