"""Where unfinished files lie, and how they get to their places: links, other disks, full disks, other runs."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import crazing as cz
from crazing import files
from crazing.pictures import job, png
from test_streaming import Stop, read, stopping

ENDINGS = [".png", ".tif", ".exr", ".zarr"]


@pytest.fixture(scope="module")
def crack() -> cz.Crack:
    return cz.crack(n=60, rng=5)


@pytest.fixture(autouse=True)
def _small_bands(monkeypatch) -> None:
    monkeypatch.setattr(job, "BANDS", (16,))


def test_unfinished_files_lie_in_a_folder_that_is_there(tmp_path, crack) -> None:
    """It may be another disk, or all that its user may write to."""
    target = tmp_path / "a"
    target.mkdir()
    with pytest.raises(Stop):
        cz.write_texture(crack, target, 64, maps=["mask", "height"], progress=stopping(48))
    assert [path.name for path in target.iterdir()] == [".part"] and list(tmp_path.iterdir()) == [target]
    begun: list[int] = []
    cz.write_texture(crack, target, 64, maps=["mask", "height"], progress=lambda done, _: begun.append(done))
    assert begun[0] >= 32
    assert sorted(path.name for path in target.iterdir()) == ["height.png", "mask.png"]


def test_a_folder_that_came_in_between_does_not_lose_the_parts(tmp_path, crack) -> None:
    target = tmp_path / "a"
    with pytest.raises(Stop):
        cz.write_texture(crack, target, 64, maps="mask", progress=stopping(48))
    target.mkdir()
    begun: list[int] = []
    cz.write_texture(crack, target, 64, maps="mask", progress=lambda done, _: begun.append(done))
    assert begun[0] >= 32 and list(tmp_path.glob("**/.*")) == []


@pytest.fixture
def elsewhere(tmp_path):
    """A folder on another disk."""
    shared = Path("/dev/shm")
    if not shared.is_dir() or shared.stat().st_dev == tmp_path.stat().st_dev:
        pytest.skip("needs a second file system")
    import tempfile

    with tempfile.TemporaryDirectory(dir=shared) as folder:
        yield Path(folder)


@pytest.mark.parametrize("ending", ENDINGS)
def test_links_to_another_disk_are_followed(tmp_path, elsewhere, crack, ending) -> None:
    (tmp_path / "folder").symlink_to(elsewhere)
    made = cz.write_texture(crack, tmp_path / "folder", 16, maps=["mask", "height"], format=_format(ending))
    assert all(path.parent == tmp_path / "folder" and path.exists() for path in made)
    (tmp_path / f"file{ending}").symlink_to(elsewhere / f"there{ending}")
    for size in (16, 24):
        (path,) = cz.write_texture(crack, tmp_path / f"file{ending}", size, maps="mask")
        assert path == tmp_path / f"file{ending}" and path.is_symlink()
        assert read(elsewhere / f"there{ending}").shape == (size, size)
    assert list(tmp_path.glob(".*")) == list(elsewhere.glob(".*")) == []


def _format(ending: str) -> str:
    return {".png": "png", ".tif": "tiff16", ".exr": "exr16", ".zarr": "zarr"}[ending]


@pytest.mark.skipif(os.name == "nt", reason="permissions of POSIX")
@pytest.mark.parametrize("ending", ENDINGS[:3])
def test_an_old_file_keeps_its_permissions_and_a_link_its_name(tmp_path, crack, ending) -> None:
    """As those of `save_png` do; what a link points to needs no ending."""
    (tmp_path / "there").write_bytes(b"old")
    (tmp_path / "there").chmod(0o640)
    (tmp_path / f"a{ending}").symlink_to("there")
    cz.write_texture(crack, tmp_path / f"a{ending}", 16, maps="mask")
    assert (tmp_path / f"a{ending}").readlink() == Path("there")
    assert (tmp_path / "there").stat().st_mode & 0o777 == 0o640 and (tmp_path / "there").stat().st_size > 100


LIMITED = """
    import os, resource, signal, sys
    import crazing as cz
    crack = cz.crack(n=60, rng=5)
    (path,) = cz.write_texture(crack, sys.argv[1], 64, maps="height")
    size = path.stat().st_size
    path.unlink()
    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(float(sys.argv[2]) * size), resource.RLIM_INFINITY))
    try:
        cz.write_texture(crack, sys.argv[1], 64, maps="height")
    except OSError as error:
        print(error.strerror, error.filename, os.path.exists(sys.argv[1]), *os.listdir("."), sep="|")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="limits of Linux stand for a full disk")
@pytest.mark.parametrize("part", [0, 0.9])
@pytest.mark.parametrize("ending", [".png", ".tif", ".exr"])
def test_a_full_disk_is_an_error_of_the_system_with_the_name(tmp_path, ending, part) -> None:
    command = [sys.executable, "-c", textwrap.dedent(LIMITED), f"a{ending}", str(part)]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    words, name, is_there, *left = done.stdout.strip().split("|")
    assert (words, name, is_there) == ("File too large", f"a{ending}", "False"), done.stdout
    # What can be gone on with, and nothing else.
    journals = list(tmp_path.glob(".*/journal.jsonl"))
    assert left == [path.parent.name for path in journals] and all(path.stat().st_size for path in journals)
    assert not left or (ending != ".exr" and part)


def test_no_run_takes_over_while_files_are_put_in_their_places(tmp_path, monkeypatch, crack) -> None:
    """It took away a folder that was on its way."""
    pytest.importorskip("fcntl")
    target, others, place = tmp_path / "a.zarr", [], job._place

    def slowly(source: Path, target: Path) -> None:
        if threading.current_thread() is threading.main_thread():
            others.append(threading.Thread(target=cz.write_texture, args=(crack, target, 48), kwargs={"maps": "mask"}))
            others[0].start()
            time.sleep(0.3)
            assert (source / "zarr.json").exists()
        place(source, target)

    monkeypatch.setattr(job, "_place", slowly)
    cz.write_texture(crack, target, 32, maps="mask")
    others[0].join()
    assert read(target).shape == (48, 48)
    assert not list(tmp_path.glob(".*"))


def test_a_run_that_was_taken_over_while_it_held_the_parts_to_their_sums_cuts_off_nothing(
    tmp_path, monkeypatch, crack
) -> None:
    target, resume = tmp_path / "a.png", png.Writer.resume
    given = {"size": 128, "maps": "mask"}
    with pytest.raises(Stop):
        cz.write_texture(crack, target, **given, progress=stopping(48))

    def slowly(writer: png.Writer, states: list) -> int:
        whole = resume(writer, states)
        monkeypatch.setattr(png.Writer, "resume", resume)
        with pytest.raises(Stop):
            cz.write_texture(crack, target, **given, progress=stopping(96))
        return whole

    monkeypatch.setattr(png.Writer, "resume", slowly)
    with pytest.raises(cz.CrazingError, match="being made by another run"):
        cz.write_texture(crack, target, **given)
    begun: list[int] = []
    cz.write_texture(crack, target, **given, progress=lambda done, _: begun.append(done))
    assert begun[0] >= 80
    np.testing.assert_array_equal(read(target), cz.texture(crack, **given)["mask"])


@pytest.mark.timeout(60)
def test_a_folder_that_a_script_holds_all_along_holds_nobody_up(tmp_path, monkeypatch, crack) -> None:
    """As ``flock . make`` does."""
    fcntl = pytest.importorskip("fcntl")
    monkeypatch.setattr(files, "_PATIENCE", 0.05)
    number = os.open(tmp_path, os.O_RDONLY)
    try:
        fcntl.flock(number, fcntl.LOCK_EX)
        cz.write_texture(crack, tmp_path / "a.png", 32, maps="mask")
    finally:
        os.close(number)
    assert read(tmp_path / "a.png").shape == (32, 32)
