"""Files: whole or not there."""

from __future__ import annotations

import errno
import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import imagecodecs
import numpy as np
import pytest
from PIL import Image

import crazing as cz
from crazing.files import atomic_write


def picture(shape, seed=0):
    return np.random.default_rng(seed).integers(0, 256, shape, dtype=np.uint8)


def read(path):
    with Image.open(path, formats=("PNG",)) as image:
        image.load()
        return np.asarray(image), image.mode, image.info


@pytest.mark.parametrize(
    ("shape", "mode"),
    [((5, 7), "L"), ((5, 7, 1), "L"), ((5, 7, 2), "LA"), ((300, 1, 3), "RGB"), ((1, 900, 4), "RGBA")],
)
def test_every_shape_comes_back(tmp_path, shape, mode):
    image = picture(shape)
    cz.save_png(tmp_path / "a.png", image)
    found, found_mode, info = read(tmp_path / "a.png")
    assert found_mode == mode
    np.testing.assert_array_equal(found, image.reshape(found.shape))
    assert info["srgb"] == 0


def test_a_render_comes_back(tmp_path):
    class Line:
        vertices = np.array([[0.0, 0.0], [1.0, 1.0]])
        edges = np.array([[0, 1]])

    image = cz.render(Line(), 100)
    cz.save_png(str(tmp_path / "line.png"), image)
    np.testing.assert_array_equal(read(tmp_path / "line.png")[0], image)


def test_booleans_and_strides():
    mask = np.eye(9, dtype=bool)
    for image in (mask, mask[::-1], mask.T, np.asfortranarray(mask), mask[::2, ::3]):
        file = io.BytesIO()
        cz.save_png(file, image)
        np.testing.assert_array_equal(read(file)[0], image * 255)


@pytest.mark.parametrize("channels", [1, 2, 3, 4])
@pytest.mark.parametrize("order", ["<u2", ">u2"])
def test_sixteen_bits_come_back(tmp_path, channels, order):
    image = np.random.default_rng(1).integers(0, 1 << 16, (40, 33, channels)).astype(order)
    image[:, 10:20] = 7
    cz.save_png(tmp_path / "a.png", image, srgb=False)
    # Pillow makes eight bits of deep colour, OpenCV four channels of grey and alpha.
    found = imagecodecs.png_decode((tmp_path / "a.png").read_bytes())
    assert found.dtype == np.uint16
    np.testing.assert_array_equal(found.reshape(image.shape), image)
    assert "srgb" not in read(tmp_path / "a.png")[2]


def test_density_is_kept(tmp_path):
    cz.save_png(tmp_path / "a.png", picture((2, 2)), density=(4000, 2000.4))
    assert read(tmp_path / "a.png")[2]["dpi"] == pytest.approx((4000 * 0.0254, 2000 * 0.0254))
    cz.save_png(tmp_path / "a.png", picture((2, 2)), density=(1e12, 1.0))
    assert "dpi" not in read(tmp_path / "a.png")[2]


def test_texts(tmp_path):
    words = {"Title": "Risse im Überzug", "Author": "釉\nglaze", "Comment": ""}
    cz.save_png(tmp_path / "a.png", picture((2, 2)), text=words)
    info = read(tmp_path / "a.png")[2]
    assert {key: info[key] for key in words} == words
    assert info["Software"].startswith("crazing ")


@pytest.mark.parametrize(
    ("image", "text", "error", "words"),
    [
        (np.zeros((3, 3)), None, TypeError, r"image \* 255"),
        (np.zeros((3, 3), dtype=np.int32), None, TypeError, "int32"),
        (np.zeros(3, dtype=np.uint8), None, ValueError, "shape"),
        (np.zeros((3, 3, 5), dtype=np.uint8), None, ValueError, "shape"),
        (np.zeros((0, 3), dtype=np.uint8), None, ValueError, "not empty"),
        (picture((2, 2)), {"": "a"}, ValueError, "keyword"),
        (picture((2, 2)), {"k" * 80: "a"}, ValueError, "keyword"),
        (picture((2, 2)), {" a": "a"}, ValueError, "keyword"),
        (picture((2, 2)), {"a  b": "a"}, ValueError, "keyword"),
        (picture((2, 2)), {"釉": "a"}, ValueError, "keyword"),
        (picture((2, 2)), {"a": "b\0"}, ValueError, "NUL"),
        (picture((2, 2)), {"a": 3}, TypeError, "strings"),
    ],
)
def test_bad_arguments_leave_nothing(tmp_path, image, text, error, words):
    with pytest.raises(error, match=words):
        cz.save_png(tmp_path / "a.png", image, text=text)
    assert not list(tmp_path.iterdir())


def test_a_path_of_another_kind():
    with pytest.raises(TypeError, match="path is int"):
        cz.save_png(3, picture((2, 2)))


@pytest.mark.parametrize("name", ["a.jpg", "a", ".png", "a.png.tif", "a.png "])
def test_an_ending_of_another_format(tmp_path, name):
    """Other programs would take the file for what its name says."""
    with pytest.raises(ValueError, match=r"path is '.*'; an ending of \.png is wanted"):
        cz.save_png(tmp_path / name, picture((2, 2)))
    assert not list(tmp_path.iterdir())
    cz.save_png(tmp_path / "A.PNG", picture((2, 2)))


@pytest.mark.parametrize("name", ["a.svg", "a.png"])
def test_a_folder_is_not_replaced(tmp_path, name):
    """What is named is the path that was given, not the file beside it."""
    (tmp_path / name).mkdir()
    with pytest.raises(IsADirectoryError) as found:
        graph = cz.PlanarGraph([[0, 0], [1, 1]], [[0, 1]])
        graph.save(tmp_path / name) if name == "a.svg" else cz.save_png(tmp_path / name, picture((2, 2)))
    assert found.value.filename == str(tmp_path / name) and found.value.filename2 is None
    assert [path.name for path in tmp_path.iterdir()] == [name]


class Refusing(io.RawIOBase):
    """A file that takes some bytes at a time and then fails."""

    def __init__(self, room, step):
        super().__init__()
        self.room, self.step, self.taken = room, step, bytearray()

    def write(self, data):
        if len(self.taken) >= self.room:
            raise BlockingIOError("no more room")
        piece = bytes(data[: self.step])
        self.taken += piece
        return len(piece)


def test_an_exception_of_the_file_comes_out_as_it_is():
    with pytest.raises(BlockingIOError, match="no more room"):
        cz.save_png(Refusing(3_000_000, 1 << 30), picture((2048, 2048)))


def test_a_file_that_takes_parts_gets_the_whole():
    image = picture((700, 700))
    file = Refusing(1 << 40, 1000)
    cz.save_png(file, image)
    np.testing.assert_array_equal(read(io.BytesIO(bytes(file.taken)))[0], image)


def test_an_error_in_the_block_leaves_the_old_file(tmp_path):
    path = tmp_path / "a"
    path.write_bytes(b"old")
    with pytest.raises(ZeroDivisionError), atomic_write(path) as file:
        file.write(b"new")
        raise ZeroDivisionError
    assert path.read_bytes() == b"old"
    assert list(tmp_path.iterdir()) == [path]


def test_a_full_disk_is_told_of_with_the_name(tmp_path):
    with (
        pytest.raises(OSError, match=r"No space left on device: '.*picture.png'"),
        atomic_write(tmp_path / "picture.png"),
    ):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    assert not [*tmp_path.iterdir()]


def test_permissions_and_links_stay(tmp_path):
    path, link, fresh = tmp_path / "a", tmp_path / "b", tmp_path / "c"
    path.write_bytes(b"old")
    path.chmod(0o604)
    link.symlink_to(path)
    for place in (link, fresh):
        with atomic_write(place) as file:
            file.write(b"new")
    assert link.is_symlink() and path.read_bytes() == b"new"
    assert path.stat().st_mode & 0o777 == 0o604
    plain = tmp_path / "d"
    plain.write_bytes(b"")
    assert fresh.stat().st_mode == plain.stat().st_mode


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="needs named pipes")
def test_a_pipe_stays_a_pipe_and_gets_the_bytes(tmp_path):
    path = tmp_path / "pipe.png"
    os.mkfifo(path)
    command = [sys.executable, "-c", f"import sys; sys.stdout.buffer.write(open({str(path)!r}, 'rb').read())"]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as reader:
        cz.save_png(path, np.eye(9, dtype=bool))
        assert np.array_equal(np.asarray(Image.open(io.BytesIO(reader.communicate()[0]))), 255 * np.eye(9))
    assert path.is_fifo()
    assert [file.name for file in tmp_path.iterdir()] == ["pipe.png"]


def test_a_missing_folder_is_an_os_error(tmp_path):
    with pytest.raises(FileNotFoundError):
        cz.save_png(tmp_path / "no" / "a.png", picture((2, 2)))


ENDLESS = """
import sys, numpy as np, crazing as cz
image = np.random.default_rng(0).integers(0, 256, (1500, 1500, 4), dtype=np.uint8)
print("start", flush=True)
while True:
    cz.save_png(sys.argv[1], image)
"""


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="needs kill -9")
def test_a_killed_save_leaves_a_whole_file(tmp_path):
    path = tmp_path / "a.png"
    cz.save_png(path, picture((4, 4)))
    for delay in (0.02, 0.05, 0.1, 0.15):
        with subprocess.Popen(
            [sys.executable, "-c", ENDLESS, os.fspath(path)], stdout=subprocess.PIPE, text=True
        ) as child:
            assert child.stdout is not None and child.stdout.readline() == "start\n"
            time.sleep(delay)
            child.kill()
        assert read(path)[0].shape in {(4, 4), (1500, 1500, 4)}
    left = {entry.name for entry in Path(tmp_path).iterdir()} - {"a.png"}
    assert all(name.startswith(".tmp-") for name in left)
