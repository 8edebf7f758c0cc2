"""Files of maps: read back by libraries that share no code with the writers."""

from __future__ import annotations

import json
import math
from pathlib import Path

import imagecodecs
import numpy as np
import OpenEXR
import pytest
import tifffile
import zarr
from PIL import Image

import crazing as cz
from crazing.pictures import layouts, tiff
from crazing.pictures.samples import FORMATS, PICTURES, samples

SIZE = (300, 520)
LABELS = ("cell", "strand", "generation")


@pytest.fixture(scope="module")
def crack() -> cz.Crack:
    return cz.crack(n=60, rng=5, bounds=(0, 0, 26, 15))


@pytest.fixture(scope="module")
def texture(crack: cz.Crack) -> cz.Texture:
    return cz.texture(crack, SIZE, maps="all", seed=2)


@pytest.fixture(scope="module", params=sorted(FORMATS))
def saved(request: pytest.FixtureRequest, texture: cz.Texture, tmp_path_factory: pytest.TempPathFactory):
    """A format, and the files of all maps in it by the name of their picture."""
    folder = tmp_path_factory.mktemp(request.param) / "maps"
    maps = (*(name for name in PICTURES if name != "direction"), "direction")
    paths = texture.save(folder, maps=maps, format=request.param, metres=0.01)
    return request.param, {path.stem: path for path in paths if path.suffix not in (".mtlx", ".gltf")}


def exr(path: Path) -> tuple[dict, np.ndarray]:
    with OpenEXR.File(str(path)) as file:
        channels = file.channels()
        return dict(file.header()), next(iter(channels.values())).pixels.copy()


def read(path: Path) -> np.ndarray:
    """By the library of each kind that is known for reading it."""
    if path.suffix == ".png":
        return np.asarray(imagecodecs.png_decode(path.read_bytes()))
    if path.suffix == ".tif":
        return np.asarray(tifffile.imread(path))
    if path.suffix == ".exr":
        return exr(path)[1]
    return np.asarray(zarr.open_array(path, mode="r")[:])


def record(path: Path) -> dict:
    if path.suffix == ".png":
        with Image.open(path) as image:
            return json.loads(image.text["crazing"])
    if path.suffix == ".tif":
        with tifffile.TiffFile(path) as file:
            return json.loads(file.pages[0].description)
    if path.suffix == ".exr":
        return json.loads(exr(path)[0]["crazing"])
    return dict(zarr.open_array(path, mode="r").attrs["crazing"])


def numbers(picture: str, texture: cz.Texture) -> np.ndarray:
    """What a picture shows, as floats, by the words of the documentation."""
    if picture == "orm":
        return np.dstack([texture["ao"], texture["roughness"], 0 * texture["ao"]]).astype(float)
    if picture.startswith("normal"):
        return texture["normal"] * np.array([1.0, -1.0 if picture == "normal_dx" else 1.0, 1.0])
    if picture == "direction":
        return np.dstack([texture["direction"], 0 * texture["ao"]]).astype(float)
    return texture[picture].astype(float)


def test_every_picture_comes_back(saved, texture) -> None:
    name, paths = saved
    assert set(paths) == set(PICTURES)
    for picture, path in paths.items():
        found, wanted = read(path), numbers(picture, texture)
        assert found.shape == wanted.shape, picture
        reach = record(path)["texture"].get("reach")
        if picture in LABELS:
            grown = name.startswith(("png", "exr"))
            np.testing.assert_array_equal(found.astype(int) - grown, wanted)
        elif picture in ("color", "mask") and not name.startswith("exr"):
            assert found.dtype == np.uint8
            np.testing.assert_array_equal(found, wanted)
        elif picture == "color":
            level = wanted / 255
            linear = np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)
            np.testing.assert_allclose(found, linear, atol=5e-4 if name == "exr16" else 1e-6)
        elif picture == "mask":
            np.testing.assert_allclose(found, wanted / 255, atol=5e-4)
        elif found.dtype.kind == "f":
            assert found.dtype == (np.float16 if name == "exr16" else np.float32)
            np.testing.assert_allclose(found, wanted, atol=1e-6 + (np.abs(wanted).max() / 2000) * (name == "exr16"))
        else:
            top = np.iinfo(found.dtype).max
            half = top / 2
            if picture.startswith("normal") or picture == "direction":
                levels = (wanted + 1) * half
            elif picture == "distance":
                levels = (wanted / reach + 1) * half
            else:
                levels = wanted * top
            # Half a level, and what a float32 rounds on the way.
            assert np.abs(found - levels.clip(0, top)).max() < 0.52, picture


def test_bits_are_those_of_the_format(saved) -> None:
    name, paths = saved
    deep = {"png": np.uint16, "png8": np.uint8, "png16": np.uint16, "tiff16": np.uint16, "exr16": np.float16}
    shallow = {**deep, "png": np.uint8}
    for picture in ("height", "normal_gl", "distance"):
        assert read(paths[picture]).dtype == deep.get(name, np.float32)
    for picture in ("ao", "roughness", "orm"):
        assert read(paths[picture]).dtype == shallow.get(name, np.float32)


def test_every_file_knows_how_it_was_made(saved, texture) -> None:
    name, paths = saved
    for picture, path in paths.items():
        found = record(path)
        assert (found["picture"], found["format"], found["command"]) == (picture, name, "texture")
        assert found["algorithm_version"] == cz.algorithm_version
        assert found["texture"]["size"] == list(SIZE)
        assert found["texture"]["texel_size"] == pytest.approx(0.01 * 26 / 520)
        assert cz.Material(**found["texture"]["material"]) == texture.material


def test_density_is_in_the_fields_of_the_format(saved) -> None:
    name, paths = saved
    pixels_a_metre = 520 / 0.26
    if name.startswith("png"):
        with Image.open(paths["height"]) as image:
            assert image.info["dpi"][0] == pytest.approx(pixels_a_metre * 0.0254, rel=1e-3)
    elif name.startswith("tiff"):
        with Image.open(paths["mask"]) as image:
            assert image.info["dpi"][0] == pytest.approx(pixels_a_metre * 0.0254, rel=1e-3)
    elif name.startswith("exr"):
        assert exr(paths["height"])[0]["xDensity"] == pytest.approx(pixels_a_metre * 0.0254, rel=1e-6)


def test_other_readers_see_the_same(saved) -> None:
    name, paths = saved
    if name.startswith(("png", "tiff")):
        for picture in ("height", "mask", "color"):
            with Image.open(paths[picture]) as image:
                np.testing.assert_array_equal(np.asarray(image), read(paths[picture]))
    if name.startswith("tiff"):
        for picture in ("height", "normal_dx", "roughness", "cell"):
            found = imagecodecs.tiff_decode(paths[picture].read_bytes())
            np.testing.assert_array_equal(found, read(paths[picture]))


def test_only_colours_claim_to_be_srgb(saved) -> None:
    name, paths = saved
    if name.startswith("png"):
        for picture, path in paths.items():
            with Image.open(path) as image:
                assert ("srgb" in image.info) == (picture == "color")


@pytest.mark.parametrize("dtype", [np.uint8, np.uint16, np.int32, np.float32])
def test_large_tiff_is_bigtiff(tmp_path, monkeypatch, texture, dtype) -> None:
    monkeypatch.setattr(tiff, "CLASSIC", 1000)
    picture = {np.uint8: "mask", np.uint16: "height", np.int32: "cell", np.float32: "height"}[dtype]
    form = "tiff16" if dtype is np.uint16 else "tiff32"
    (path,) = texture.save(tmp_path / "a.tif", maps=picture, format=form)
    with tifffile.TiffFile(path) as file:
        assert file.is_bigtiff and file.pages[0].is_tiled and file.pages[0].dtype == dtype
        found = file.asarray()
    with Image.open(path) as image:
        assert image.size == SIZE[::-1]
    if dtype is not np.uint16:
        np.testing.assert_array_equal(found, texture[picture])


def test_labels_beyond_sixteen_bits_are_refused_and_leave_nothing(tmp_path, texture) -> None:
    maps = {"cell": np.full((4, 4), 70_000, dtype=np.int32)}
    large = cz.Texture(
        maps, (4, 4), *(getattr(texture, n) for n in ("bounds", "period", "scale", "material")), 1.0, 0, texture.crack
    )
    with pytest.raises(cz.CrazingError, match=r"cell has the label 70000.*tiff32"):
        large.save(tmp_path / "a.png")
    assert not list(tmp_path.iterdir())
    (path,) = large.save(tmp_path / "a.tif")
    np.testing.assert_array_equal(tifffile.imread(path), maps["cell"])


def test_distances_beyond_half_floats_are_refused_and_leave_nothing(tmp_path) -> None:
    """They became infinite."""
    wide = cz.crack(n=20, rng=1, bounds=(0, 0, 1e6, 1e6))
    with pytest.raises(cz.CrazingError, match=r"distance reaches .*exr32"):
        cz.write_texture(wide, tmp_path / "a.exr", 16, maps="distance", format="exr16")
    assert not list(tmp_path.iterdir())
    (path,) = cz.write_texture(wide, tmp_path / "a.exr", 16, maps="distance")
    np.testing.assert_array_equal(read(path), cz.texture(wide, 16, maps="distance")["distance"])
    # Where there is no crack at all distances are infinite, in every format of floats.
    (path,) = cz.write_texture(wide.at(0), tmp_path / "b.exr", 4, maps="distance", format="exr16")
    assert np.isposinf(read(path)).all()


NAMES = {
    "ambientcg": "Color NormalGL NormalDX Displacement Roughness AmbientOcclusion",
    "polyhaven": "diff nor_gl nor_dx disp rough ao",
    "unreal": "D N H R AO",
    "plain": "color normal_gl height roughness ao",
}
PATTERNS = {"ambientcg": "mud_2K-PNG_{}.png", "polyhaven": "mud_{}_2k.png", "unreal": "T_mud_{}.png", "plain": "{}.png"}


@pytest.mark.parametrize("name", NAMES)
def test_layouts_have_the_names_of_their_libraries(name) -> None:
    layout = layouts.named(name)
    maps = ("color", "normal", "height", "roughness", "ao")
    found = [layout.file("mud", picture, 2048, "PNG", ".png") for picture in layouts.chosen(maps, layout)]
    assert found == [PATTERNS[name].format(word) for word in NAMES[name].split()]


@pytest.mark.parametrize(
    ("name", "picture"), [("plain", "normal_gl"), ("polyhaven", "normal_gl"), ("unreal", "normal_dx")]
)
def test_the_normals_of_a_layout_are_those_of_one_file_as_well(tmp_path, texture, name, picture) -> None:
    """Unreal's were upside down where a file was asked for instead of a folder."""
    (path,) = texture.save(tmp_path / "a.tif", maps="normal", layout=name)
    assert record(path)["picture"] == picture
    np.testing.assert_array_equal(read(path), numbers(picture, texture).astype(np.float32))


@pytest.mark.parametrize(("pixels", "word"), [(1024, "1K"), (8192, "8K"), (131072, "128K"), (1000, "1000"), (3, "3")])
def test_resolutions(pixels, word) -> None:
    assert layouts.resolution(pixels) == word


BAD = [
    ({"path": "a.png"}, ValueError, "name a folder for several"),
    ({"path": "a", "format": "bmp"}, ValueError, "format is 'bmp'"),
    ({"path": "a", "layout": "blender"}, ValueError, "layout is 'blender'"),
    ({"path": "a", "name": "../b"}, ValueError, "name is '../b'"),
    ({"path": "a", "metres": 0}, ValueError, "metres is 0"),
    ({"path": "a", "metres": math.nan}, ValueError, "metres is nan"),
    ({"path": "a", "metres": 1e30}, ValueError, r"the whole is 2.6e\+31 metres"),
    ({"path": "a", "maps": []}, ValueError, "maps is empty"),
    ({"path": "a", "maps": ["heigth"]}, ValueError, r"maps\[0\] is 'heigth'"),
    ({"path": "a.tif", "maps": "mask", "format": "png"}, ValueError, "does not end in .png"),
    ({"path": "no/a.png", "maps": "mask"}, OSError, "no folder"),
    ({"path": "file", "maps": "mask"}, OSError, "is a file"),
    ({"path": "folder.png", "maps": "mask"}, OSError, "is a folder"),
    ({"path": "folder.zarr", "maps": "mask"}, OSError, "is a folder"),
]


@pytest.mark.parametrize(("given", "error", "words"), BAD)
def test_bad_arguments_leave_nothing(tmp_path, monkeypatch, texture, crack, given, error, words) -> None:
    monkeypatch.chdir(tmp_path)
    Path("file").write_text("mine")
    for name in ("folder.png", "folder.zarr"):
        Path(name).mkdir()
        Path(name, "mine").write_text("mine")
    before = sorted(tmp_path.rglob("*"))
    given = dict(given)
    path = given.pop("path")
    with pytest.raises(error, match=words):
        texture.save(path, **given)
    with pytest.raises(error, match=words):
        cz.write_texture(crack, path, 64, **given)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_map_that_was_not_drawn_is_named(tmp_path, crack) -> None:
    with pytest.raises(ValueError, match="a map to be saved is 'ao'"):
        cz.texture(crack, 32, maps=["roughness"]).save(tmp_path / "a", maps=["orm"])


def around(levels: np.ndarray, low: float, steep: float) -> np.ndarray:
    """Numbers whose levels change from one to the next, and beyond the last ones, in the order of rows of a picture."""
    at = ((levels - 0.5) / steep + low).astype(np.float32)
    beside = [np.nextafter(at, np.float32(to)) for to in (-np.inf, np.inf)]
    beyond = np.array([0.0, -0.0, 1.0, -1.0, 1e-41, -1e-41, 3e38, -3e38, np.inf, -np.inf], dtype=np.float32)
    return np.concatenate([at, *beside, beyond])


@pytest.mark.parametrize("kind", ["float16", "float32", "float64"])
@pytest.mark.parametrize(
    ("picture", "form", "low", "half"),
    [
        *((picture, "png16", 0.0, 1.0) for picture in ("height", "ao", "wear")),
        ("height", "png8", 0.0, 1.0),
        ("roughness", "png", 0.0, 1.0),
        *((picture, form, -1.0, 0.5) for picture in ("normal_gl", "direction") for form in ("tiff16", "png8")),
        *(("distance", form, -0.3, 0.5 / 0.3) for form in ("tiff16", "png8")),
    ],
)
def test_levels_are_the_nearest_to_the_last_bit(picture, form, low, half, kind) -> None:
    dtype = np.dtype(np.uint8 if form in ("png", "png8") else np.uint16)
    top = np.iinfo(dtype).max
    numbers = around(np.arange(-3, top + 4), low, half * top)
    with np.errstate(over="ignore"):
        numbers = numbers.astype(kind)
    with np.errstate(over="ignore"):
        steps = numbers.astype(np.float32) - np.float32(low)
        wanted = (steps * np.float32(half * top) + np.float32(0.5)).clip(0, top).astype(dtype)
    for shape in ((-1, 1), (1, -1)):
        found = samples(picture, numbers.reshape(shape), FORMATS[form], 0.3)
        assert found.dtype == dtype
        np.testing.assert_array_equal(found.reshape(-1), wanted)
