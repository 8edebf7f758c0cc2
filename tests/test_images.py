"""Reading pictures: what each mode becomes, and what is refused."""

from __future__ import annotations

import struct
import warnings
import zlib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from crazing.errors import CrazingError
from crazing.images import PIXEL_LIMIT, brightness, read_image

Image = pytest.importorskip("PIL.Image")

GREY = np.arange(12, dtype=np.uint8).reshape(3, 4) * 20
COLOUR = np.random.default_rng(0).integers(0, 256, (3, 4, 4), dtype=np.uint8)


def saved(folder: Path, pixels: np.ndarray, name: str = "picture.png", **options) -> Path:
    path = folder / name
    Image.fromarray(pixels).save(path, **options)
    return path


@pytest.mark.parametrize("ending", ["png", "tif", "bmp", "gif"])
def test_grey_keeps_its_values(tmp_path, ending) -> None:
    pixels = read_image(saved(tmp_path, GREY, f"picture.{ending}"))
    if pixels.ndim == 3:  # GIF knows palettes only
        pixels = pixels[..., 0]
    np.testing.assert_array_equal(pixels, GREY)
    assert pixels.dtype == np.uint8


@pytest.mark.parametrize(
    ("ending", "dtype"),
    [("png", np.uint16), ("png", ">u2"), ("tif", np.uint16), ("tif", ">u2"), ("tif", np.float32), ("tif", np.int32)],
)
def test_deep_grey_keeps_its_values(tmp_path, ending, dtype) -> None:
    deep = (GREY.astype(np.float64) * 250).astype(dtype)
    pixels = read_image(saved(tmp_path, deep, f"picture.{ending}"))
    np.testing.assert_array_equal(pixels, deep)
    assert pixels.dtype.isnative and pixels.dtype.itemsize == np.dtype(dtype).itemsize


def test_one_bit_is_bool(tmp_path) -> None:
    pixels = read_image(saved(tmp_path, GREY > 100))
    assert pixels.dtype == bool
    np.testing.assert_array_equal(pixels, GREY > 100)


@pytest.mark.parametrize("channels", [3, 4])
@pytest.mark.parametrize(("ending", "options"), [("png", {}), ("tif", {}), ("webp", {"lossless": True, "exact": True})])
def test_colour(tmp_path, channels, ending, options) -> None:
    pixels = read_image(saved(tmp_path, COLOUR[..., :channels], f"picture.{ending}", **options))
    np.testing.assert_array_equal(pixels, COLOUR[..., :channels])


def test_jpeg_is_near(tmp_path) -> None:
    flat = np.full((16, 16, 3), (200, 100, 50), dtype=np.uint8)
    pixels = read_image(saved(tmp_path, flat, "picture.jpg", quality=95))
    assert np.abs(pixels.astype(int) - flat).max() < 6


def test_palette_is_looked_up(tmp_path) -> None:
    picture = Image.fromarray(np.array([[0, 1], [1, 0]], dtype=np.uint8)).convert("P")
    picture.putpalette([255, 0, 0, 0, 0, 255])
    picture.save(tmp_path / "solid.png")
    picture.save(tmp_path / "clear.png", transparency=0)
    assert read_image(tmp_path / "solid.png").tolist()[0] == [[255, 0, 0], [0, 0, 255]]
    assert read_image(tmp_path / "clear.png").tolist()[0] == [[255, 0, 0, 0], [0, 0, 255, 255]]


def test_grey_with_alpha_is_colour_with_alpha(tmp_path) -> None:
    Image.fromarray(COLOUR[..., :2]).save(tmp_path / "picture.png")
    pixels = read_image(tmp_path / "picture.png")
    np.testing.assert_array_equal(pixels, COLOUR[..., [0, 0, 0, 1]])


@pytest.mark.parametrize("name", ["picture.jpg", "picture.png", "picture.tif"])
def test_orientation_of_cameras(tmp_path, name) -> None:
    pixels = np.zeros((16, 32), dtype=np.uint8)
    pixels[:, :16] = 255
    exif = Image.Exif()
    exif[0x0112] = 6  # to be turned a quarter clockwise
    turned = read_image(saved(tmp_path, pixels, name, exif=exif))
    assert turned.shape == (32, 16)
    assert turned[:14].min() > 200 and turned[18:].max() < 50


def png_header(width: int, height: int) -> bytes:
    """A PNG that claims a size and holds almost nothing."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(b"\0")) + chunk(b"IEND", b"")


def test_bombs_are_refused_by_their_header(tmp_path) -> None:
    path = tmp_path / "bomb.png"
    path.write_bytes(png_header(1 << 14, (1 << 14) + 1))
    with (
        pytest.warns(Image.DecompressionBombWarning),
        pytest.raises(CrazingError, match=rf"bomb\.png has 16384 x 16385 pixels; at most {PIXEL_LIMIT}"),
    ):
        read_image(path)
    path.write_bytes(png_header(1 << 20, 1 << 20))
    with pytest.raises(CrazingError, match=r"bomb\.png"):
        read_image(path)


@pytest.mark.parametrize(
    ("name", "options"), [("large.png", {}), ("large.tif", {"compression": "group4"}), ("large.tif", {})]
)
def test_pictures_beyond_pillows_own_limit_are_read(tmp_path, name, options) -> None:
    limit = Image.MAX_IMAGE_PIXELS
    Image.new("1", (14_000, 14_000)).save(tmp_path / name, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert read_image(tmp_path / name).shape == (14_000, 14_000)
    assert limit == Image.MAX_IMAGE_PIXELS


def test_pillows_limit_returns_after_many_readers_at_once(tmp_path) -> None:
    limit = Image.MAX_IMAGE_PIXELS
    good = saved(tmp_path, GREY)
    bad = tmp_path / "bad.png"
    bad.write_bytes(b"no picture")

    def read(path: Path) -> bool:
        try:
            return read_image(path).shape == GREY.shape
        except CrazingError:
            return False

    with ThreadPoolExecutor(8) as pool:
        assert sum(pool.map(read, [good, bad] * 100)) == 100
    assert limit == Image.MAX_IMAGE_PIXELS


def test_errors_of_the_system_stay(tmp_path) -> None:
    with pytest.raises(FileNotFoundError):
        read_image(tmp_path / "none.png")
    with pytest.raises(IsADirectoryError):
        read_image(tmp_path)


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"text, not pixels",
        b"\x89PNG\r\n\x1a\n",
        b"II*\0",
        b"BM",
        b"GIF89a",
        b"RIFF0000WAVE",
        b"\xff\xd8\xff",
    ],
)
def test_what_is_no_picture(tmp_path, content) -> None:
    path = tmp_path / "picture.png"
    path.write_bytes(content)
    with pytest.raises(CrazingError, match=r"picture\.png"):
        read_image(path)


@pytest.mark.parametrize(("kind", "shape"), [("f8", (4, 5)), ("f2", (4, 5)), ("u8", (4, 5)), ("f4", (4, 5, 3))])
def test_a_tiff_of_another_kind_is_called_one(tmp_path, kind, shape) -> None:
    tifffile = pytest.importorskip("tifffile")
    path = tmp_path / "heights.tif"
    tifffile.imwrite(path, np.ones(shape, kind), photometric="rgb" if len(shape) == 3 else "minisblack")
    with pytest.raises(CrazingError, match=r"heights\.tif is a TIFF that is .* of a kind that is not read; .*float32"):
        read_image(path)


@pytest.mark.parametrize("kind", ["PPM", "TGA", "ICO"])
def test_other_formats_are_refused(tmp_path, kind) -> None:
    path = tmp_path / "picture.png"
    Image.fromarray(COLOUR).convert("RGB").save(path, format=kind)
    with pytest.raises(CrazingError, match="is wanted"):
        read_image(path)


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "TIFF", "BMP", "GIF", "WEBP"])
@given(place=st.floats(0, 1), byte=st.integers(0, 255), cut=st.floats(0, 1))
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_damaged_files_give_one_error(tmp_path, kind, place, byte, cut) -> None:
    path = tmp_path / "picture"
    Image.fromarray(COLOUR[..., :3]).save(path, format=kind)
    content = bytearray(path.read_bytes())
    content[int(place * (len(content) - 1))] = byte
    path.write_bytes(content[: max(1, int(cut * 2 * len(content)))])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # Pillow's remarks on damaged metadata
        try:
            assert read_image(path).ndim in (2, 3)
        except CrazingError as error:
            assert str(path) in str(error)


def test_brightness_of_colour() -> None:
    primaries = np.eye(3)[None]
    np.testing.assert_allclose(brightness(primaries), [[0.2126, 0.7152, 0.0722]])
    np.testing.assert_allclose(brightness(np.full((1, 1, 3), 255, dtype=np.uint8)), [[1.0]])


def test_brightness_over_white() -> None:
    half = np.array([[[0, 0, 0, 0.25], [1, 1, 1, 0.5], [0.3, 0.9, 0.1, 0]]])
    np.testing.assert_allclose(brightness(half), [[0.75, 1.0, 1.0]])
