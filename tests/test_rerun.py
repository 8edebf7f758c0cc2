"""Pictures made again from what their files say."""

from __future__ import annotations

import json
import struct
import zlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import crazing as cz
from crazing import provenance
from crazing.pictures.reading import record_of
from test_streaming import read


@pytest.fixture(scope="module")
def crack() -> cz.Crack:
    return cz.crack(n=40, period=(2, 1), rng=5)


@pytest.mark.parametrize("form", ["png", "png8", "tiff16", "tiff32", "exr16", "exr32", "zarr"])
@pytest.mark.parametrize("picture", ["color", "height", "normal_dx", "strand", "distance"])
def test_every_kind_of_file_is_made_again(tmp_path, crack, form, picture) -> None:
    ending = {"p": ".png", "t": ".tif", "e": ".exr", "z": ".zarr"}[form[0]]
    first = tmp_path / f"first{ending}"
    material = cz.Material(grain=0.2, tilt=0.1, plate=["#804020", "#c0a080"])
    cz.write_texture(crack, first, (50, 100), maps=picture, format=form, material=material, seed=9, metres=0.2)
    again = cz.rerun(first, tmp_path / f"again{ending}")
    np.testing.assert_array_equal(read(first), read(again))
    assert record_of(first) == record_of(again)
    if form != "zarr":
        assert first.read_bytes() == again.read_bytes()


@pytest.mark.parametrize("preset", cz.presets())
def test_a_preset_is_made_again(tmp_path, preset) -> None:
    recipe = cz.preset(preset)
    origin = provenance.of_recipe(recipe, seed=3, preset=preset, bounds=(0, 0, 1, 1))
    pattern = recipe.crack(bounds=(0, 0, 1, 1), rng=3)
    given = {"maps": "color", "material": preset, "origin": origin}
    (first,) = cz.write_texture(pattern, tmp_path / "a.png", 48, **given)
    again = cz.rerun(first, tmp_path / "b.png")
    np.testing.assert_array_equal(read(first), read(again))


def test_the_pattern_comes_back_as_it_was(crack) -> None:
    origin = json.loads(json.dumps(provenance.of_crack(crack)))
    assert provenance.crack_of(origin) == crack


def test_a_large_pattern_is_not_carried_along(tmp_path) -> None:
    large = cz.crack(n=20_000, rng=1)
    (path,) = cz.write_texture(large, tmp_path / "a.png", 32, maps="mask")
    assert path.stat().st_size < 10_000
    with pytest.raises(cz.CrazingError, match="too large to be kept"):
        cz.rerun(path, tmp_path / "b.png")
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]


def png_with(text: bytes) -> bytes:
    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 0, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + head + chunk(b"tEXt", text) + chunk(b"IEND", b"")


NOW = {"algorithm_version": cz.algorithm_version}
GIVEN = {**NOW, "texture": 3, "source": {}, "picture": "mask", "format": "png"}
BAD_RECORDS = {
    "no JSON": ("crazing", "{", "does not say how it was made"),
    "a list": ("crazing", "[1]", "does not say how it was made"),
    "another keyword": ("Title", json.dumps(GIVEN), "does not say how it was made"),
    "another version": ("crazing", '{"algorithm_version": 99}', "version 99 of the algorithms"),
    "no texture": ("crazing", json.dumps(NOW), "is damaged"),
    "strange texture": ("crazing", json.dumps(GIVEN), "is damaged"),
    "strange picture": ("crazing", json.dumps({**GIVEN, "picture": "x"}), "names the picture 'x'"),
}


@pytest.mark.parametrize("kind", BAD_RECORDS)
def test_records_that_do_not_do_are_named(tmp_path, kind) -> None:
    keyword, text, words = BAD_RECORDS[kind]
    (tmp_path / "a.png").write_bytes(png_with(f"{keyword}\0{text}".encode()))
    with pytest.raises(cz.CrazingError, match=words):
        cz.rerun(tmp_path / "a.png", tmp_path / "b.png")


@pytest.mark.parametrize("content", [b"", b"text", b"\x89PNG\r\n\x1a\n", b"II*\0", b"II+\0\0\0", b"\x76\x2f\x31\x01\2"])
def test_what_is_no_picture_is_named(tmp_path, content) -> None:
    (tmp_path / "a.png").write_bytes(content)
    with pytest.raises(cz.CrazingError, match=r"a\.png"):
        cz.rerun(tmp_path / "a.png", tmp_path / "b.png")


@pytest.mark.parametrize("target", ["b", "b.jpg", "b.tif", ""])
def test_a_place_for_another_kind_of_file_is_refused(tmp_path, crack, target) -> None:
    """A folder would get scenes as well."""
    cz.write_texture(crack, tmp_path / "a.png", (8, 16), maps="color")
    with pytest.raises(ValueError, match=r"does not end in \.png"):
        cz.rerun(tmp_path / "a.png", tmp_path / target)
    assert [entry.name for entry in tmp_path.iterdir()] == ["a.png"]


def test_folders_and_missing_files_are_named(tmp_path) -> None:
    with pytest.raises(cz.CrazingError, match="is a folder"):
        cz.rerun(tmp_path, tmp_path / "b.png")
    with pytest.raises(FileNotFoundError):
        cz.rerun(tmp_path / "no.png", tmp_path / "b.png")


@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(place=st.floats(0, 1), byte=st.integers(0, 255), form=st.sampled_from(["png", "tiff16", "exr16"]))
def test_damaged_files_give_one_error_or_the_picture(tmp_path_factory, crack, place, byte, form) -> None:
    folder = tmp_path_factory.mktemp("damaged")
    path = folder / f"a.{form[:3] if form != 'tiff16' else 'tif'}"
    cz.write_texture(crack, path, (8, 16), maps="mask", format=form)
    content = bytearray(path.read_bytes())
    content[int(place * (len(content) - 1))] = byte
    path.write_bytes(content)
    try:
        record = record_of(path)
    except cz.CrazingError as error:
        assert Path(path).name in str(error)
    else:
        assert "algorithm_version" in record
