"""Textures straight into files: parts equal the whole, memory is bounded, a stopped run goes on."""

from __future__ import annotations

import dataclasses
import os
import re
import signal
import subprocess
import sys
import textwrap
import time
from pathlib import Path

import imagecodecs
import numpy as np
import OpenEXR
import pytest
import tifffile
import zarr

import crazing as cz
from crazing.pictures import job

SIZE = (700, 300)
MAPS = ("color", "height", "normal_dx", "strand", "mask")


@pytest.fixture(scope="module")
def crack() -> cz.Crack:
    return cz.crack(n=60, rng=5, bounds=(0, 0, 3, 7))


def read(path: Path) -> np.ndarray:
    if path.suffix == ".png":
        return np.asarray(imagecodecs.png_decode(path.read_bytes()))
    if path.suffix == ".tif":
        return np.asarray(tifffile.imread(path))
    if path.suffix == ".exr":
        with OpenEXR.File(str(path)) as file:
            return next(iter(file.channels().values())).pixels.copy()
    return np.asarray(zarr.open_array(path, mode="r")[:])


def pixels(folder: Path) -> dict[str, np.ndarray]:
    return {path.stem: read(path) for path in folder.iterdir() if path.suffix not in (".gltf", ".mtlx")}


def same(first: dict[str, np.ndarray], second: dict[str, np.ndarray]) -> None:
    assert first.keys() == second.keys() and first
    for name, array in first.items():
        assert array.dtype == second[name].dtype
        np.testing.assert_array_equal(array, second[name])


@pytest.mark.parametrize("form", ["png", "tiff16", "tiff32", "exr16", "zarr"])
def test_bands_of_any_height_equal_the_whole(tmp_path, monkeypatch, crack, form) -> None:
    texture = cz.texture(crack, SIZE, maps=["color", "height", "normal", "strand", "mask"], seed=3)
    texture.save(tmp_path / "whole", maps=MAPS, format=form)
    whole = pixels(tmp_path / "whole")
    assert {array.shape[:2] for array in whole.values()} == {SIZE}
    for rows in (64, 16):
        monkeypatch.setattr(job, "BANDS", (rows,))
        cz.write_texture(crack, tmp_path / str(rows), SIZE, maps=MAPS, format=form, seed=3)
        same(pixels(tmp_path / str(rows)), whole)
    assert not list(tmp_path.glob(".*"))


class Stop(Exception):
    """Raised by a test's progress."""


def stopping(rows: int):
    def progress(done: int, total: int) -> None:
        if done >= rows:
            raise Stop

    return progress


def harm(part: Path, kind: str) -> None:
    """What a crash can do to a file that is not finished."""
    if kind == "torn journal":
        with (part / "journal.jsonl").open("a") as file:
            file.write('[{"end": 12')
    elif kind == "torn tail":
        for path in part.glob("*.png"):
            with path.open("ab") as file:
                file.write(b"half a band")
    elif kind == "lost bytes":
        for path in [*part.glob("*.png"), *part.glob("*.tif")]:
            path.write_bytes(path.read_bytes()[:-7])
        for path in part.glob("*.zarr/c/0/*"):
            if path.is_file():
                path.write_bytes(path.read_bytes()[:-7])
    elif kind == "flipped byte":
        for path in [*part.glob("1.png"), *part.glob("1.tif")]:
            data = bytearray(path.read_bytes())
            data[len(data) // 3] ^= 1
            path.write_bytes(data)
    elif kind == "lost file":
        for path in [*part.glob("0.png"), *part.glob("0.tif")]:
            path.unlink()


HARMS = ["none", "torn journal", "torn tail", "lost bytes", "flipped byte", "lost file"]


@pytest.mark.parametrize(
    ("form", "kind"),
    [
        *((form, kind) for form in ("png", "tiff16") for kind in HARMS),
        ("zarr", "none"),
        ("zarr", "lost bytes"),
        ("exr16", "none"),
    ],
)
def test_a_stopped_run_goes_on_behind_what_is_whole(tmp_path, monkeypatch, crack, form, kind) -> None:
    monkeypatch.setattr(job, "BANDS", (64,))
    given = {"maps": MAPS, "format": form, "layout": "polyhaven"}
    cz.write_texture(crack, tmp_path / "straight", SIZE, **given)
    with pytest.raises(Stop):
        cz.write_texture(crack, tmp_path / "a", SIZE, **given, progress=stopping(400))
    part = tmp_path / ".a.part"
    # An EXR is not gone on with, and leaves nothing.
    assert part.is_dir() == (form != "exr16") and not (tmp_path / "a").exists()
    harm(part, kind)
    begun: list[int] = []
    cz.write_texture(crack, tmp_path / "a", SIZE, **given, progress=lambda done, total: begun.append(done))
    same(pixels(tmp_path / "a"), pixels(tmp_path / "straight"))
    assert not part.exists()
    if form == "exr16" or kind == "lost file":
        return
    # One band is drawn ahead of what is written, so that row 320 is where it goes on at the earliest.
    assert begun[0] >= (320 if kind in ("none", "torn journal", "torn tail") else 0)
    if kind == "none":
        assert begun[0] in (320, 384)


def test_another_texture_does_not_go_on_with_the_parts(tmp_path, monkeypatch, crack) -> None:
    monkeypatch.setattr(job, "BANDS", (64,))
    with pytest.raises(Stop):
        cz.write_texture(crack, tmp_path / "a.png", SIZE, maps="height", seed=1, progress=stopping(400))
    begun: list[int] = []
    cz.write_texture(crack, tmp_path / "a.png", SIZE, maps="height", seed=2, progress=lambda a, b: begun.append(a))
    assert begun[0] == 0 and begun[-1] == SIZE[0]
    cz.write_texture(crack, tmp_path / "b.png", SIZE, maps="height", seed=2)
    np.testing.assert_array_equal(read(tmp_path / "a.png"), read(tmp_path / "b.png"))


def test_another_pattern_of_the_same_origin_does_not_go_on_with_the_parts(tmp_path, monkeypatch, crack) -> None:
    """What an origin says is the user's; half of one pattern and half of another became one picture."""
    monkeypatch.setattr(job, "BANDS", (64,))
    given = {"size": SIZE, "maps": "mask", "origin": {"drawn": "by hand"}}
    with pytest.raises(Stop):
        cz.write_texture(crack, tmp_path / "a.png", **given, progress=stopping(400))
    other = dataclasses.replace(crack, width=3 * crack.width)
    (path,) = cz.write_texture(other, tmp_path / "a.png", **given)
    np.testing.assert_array_equal(read(path), cz.texture(other, SIZE, maps="mask")["mask"])


@pytest.mark.parametrize("ending", [".png", ".tif", ".exr", ".zarr"])
@pytest.mark.parametrize("at", [64, 128])
@pytest.mark.parametrize("seed", [3, 4])
def test_a_run_that_another_takes_over_stops(tmp_path, monkeypatch, crack, ending, at, seed) -> None:
    """It would put the unfinished file of the other in its place."""
    monkeypatch.setattr(job, "BANDS", (64,))
    target = tmp_path / f"height{ending}"

    def other(done: int, total: int) -> None:
        if done == at:
            with pytest.raises(Stop):
                cz.write_texture(crack, target, 128, maps="height", seed=seed, progress=stopping(64))

    with pytest.raises(cz.CrazingError, match=rf"height\{ending} is being made by another run as well"):
        cz.write_texture(crack, target, 128, maps="height", seed=3, progress=other)
    assert not target.exists()
    cz.write_texture(crack, target, 128, maps="height", seed=seed)
    cz.write_texture(crack, tmp_path / f"plain{ending}", 128, maps="height", seed=seed)
    np.testing.assert_array_equal(read(target), read(tmp_path / f"plain{ending}"))
    assert not list(tmp_path.glob(".*"))


def test_what_cannot_be_written_is_named_as_it_was_given(tmp_path, crack) -> None:
    target = tmp_path / f"{'a' * 250}.png"
    with pytest.raises(OSError, match=r"aaa\.png'$") as found:
        cz.write_texture(crack, target, 8, maps="mask")
    assert found.value.filename == str(target)
    assert not list(tmp_path.iterdir())


def test_a_run_that_stops_before_its_first_band_leaves_nothing(tmp_path, crack) -> None:
    with pytest.raises(Stop):
        cz.write_texture(crack, tmp_path / "a", 64, progress=stopping(0))
    assert not list(tmp_path.iterdir())


def test_an_old_file_stays_until_the_new_one_is_whole(tmp_path, monkeypatch, crack) -> None:
    monkeypatch.setattr(job, "BANDS", (16,))
    for name in ("a.png", "a.zarr"):
        cz.write_texture(crack, tmp_path / name, 64, maps="mask")
        before = read(tmp_path / name)
        with pytest.raises(Stop):
            cz.write_texture(crack, tmp_path / name, 96, maps="mask", progress=stopping(48))
        np.testing.assert_array_equal(read(tmp_path / name), before)
        cz.write_texture(crack, tmp_path / name, 96, maps="mask")
        assert read(tmp_path / name).shape == (96, 96)


PROGRAM = """
    import sys
    from pathlib import Path
    import crazing as cz
    crack = cz.crack(n=100, rng=1)
    size = tuple(map(int, sys.argv[2].split("x")))
    cz.write_texture(crack, sys.argv[1], size, maps=["height", "mask"], format=sys.argv[3])
    # Of this program alone: what getrusage has begins with the peak of the process that started it.
    print(next(line.split()[1] for line in Path("/proc/self/status").read_text().splitlines() if "VmHWM" in line))
"""


@pytest.mark.skipif(sys.platform != "linux", reason="reads what Linux tells")
@pytest.mark.parametrize("form", ["png", "tiff32"])
def test_memory_does_not_grow_with_the_rows(tmp_path, form) -> None:
    program = textwrap.dedent(PROGRAM)
    peaks = []
    for size in ("256x1024", "8192x1024"):
        command = [sys.executable, "-c", program, str(tmp_path / size), size, form]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        peaks.append(int(done.stdout) / 1024)
    # All rows at once take 40 MiB more, with their samples 60; two bands ahead take a few.
    assert peaks[1] < peaks[0] + 20, peaks


def test_the_bound_that_is_stated_holds_for_the_widest_of_all_maps(crack) -> None:
    # 16 rows of every map, at the widest side that the documentation names.
    assert re.search(r"140,000", cz.write_texture.__doc__ or "")
    maps = cz.texture(crack, (1, 1000), maps="all")
    assert 16 * 140 * sum(array.nbytes for array in maps.values()) <= job.BAND_BYTES


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
@pytest.mark.parametrize("way", [signal.SIGINT, signal.SIGKILL])
def test_a_killed_run_leaves_no_torn_file_and_goes_on(tmp_path, way) -> None:
    words = ["texture", "--preset", "glaze", "--seed", "5", "--size", "1024x6144", "--maps", "height,mask"]
    command = [sys.executable, "-m", "crazing", *words, "-o", "mud"]
    with subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as child:
        journal = tmp_path / ".mud.part" / "journal.jsonl"
        for _ in range(600):
            if journal.exists() and journal.read_text().count("\n") >= 2:
                break
            time.sleep(0.02)
        child.send_signal(way)
        output, errors = child.communicate(timeout=60)
    if way == signal.SIGINT:
        assert child.returncode == 130 and output == b"" and b"Traceback" not in errors
    assert not (tmp_path / "mud").exists()
    bands = journal.read_text().count("\n")
    assert 2 <= bands < 24
    begun: list[int] = []
    arguments = {"maps": ("height", "mask"), "name": "glaze"}
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    assert "1024 x 6144" in done.stdout and not journal.parent.exists()
    recipe = cz.preset("glaze")
    pattern = recipe.crack(bounds=(0, 0, 1024 / 6144, 1), detail=3 / 6144, rng=5)
    progress = lambda done, total: begun.append(done)  # noqa: E731
    cz.write_texture(
        pattern,
        tmp_path / "b",
        (6144, 1024),
        material="glaze",
        seed=5,
        bounds=pattern.bounds,
        progress=progress,
        **arguments,
    )
    same(pixels(tmp_path / "mud"), pixels(tmp_path / "b"))
