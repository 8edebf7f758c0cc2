"""MaterialX and glTF beside the maps, opened by readers of others."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path

import imagecodecs
import numpy as np
import pytest
from PIL import Image

import crazing as cz
from crazing.pictures.reading import record_of

SIZE = (300, 520)


@pytest.fixture(scope="module")
def texture() -> cz.Texture:
    crack = cz.crack(n=60, rng=5, bounds=(0, 0, 26, 15))
    return cz.texture(crack, SIZE, maps=["color", "normal", "height", "ao", "roughness"], seed=2)


@pytest.fixture(scope="module")
def scene(texture, tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("scene") / "mud"
    texture.save(folder, layout="ambientcg", name="mud", metres=0.01)
    return folder


def test_a_reader_of_gltf_finds_the_plane_and_its_pictures(scene) -> None:
    import pygltflib

    document = pygltflib.GLTF2().load(str(scene / "mud.gltf"))
    assert document.asset.version == "2.0"
    for image in document.images:
        with Image.open(scene / image.uri) as picture:
            assert picture.size == SIZE[::-1]
    by_name = {image.name: index for index, image in enumerate(document.images)}
    material = document.materials[0]
    surface = material.pbrMetallicRoughness
    assert document.textures[surface.baseColorTexture.index].source == by_name["color"]
    assert document.textures[material.normalTexture.index].source == by_name["normal_gl"]
    assert document.textures[surface.metallicRoughnessTexture.index].source == by_name["orm"]
    assert document.textures[material.occlusionTexture.index].source == by_name["orm"]
    box = document.accessors[0]
    np.testing.assert_allclose(np.subtract(box.max, box.min), [0.26, 0.15, 0], rtol=1e-6)
    blob = document.get_data_from_buffer_uri(document.buffers[0].uri)
    arrays = []
    for accessor in document.accessors:
        view = document.bufferViews[accessor.bufferView]
        dtype = {5126: "<f4", 5123: "<u2"}[accessor.componentType]
        data = np.frombuffer(blob, dtype, view.byteLength // int(dtype[-1]), view.byteOffset)
        arrays.append(data.reshape(accessor.count, -1))
    corners, normals, _, uv, rows = arrays
    a, b, c = corners[rows[:3, 0]]
    # The face looks along its normal, and what is on top of the picture is on top of the plane.
    assert np.dot(np.cross(b - a, c - a), normals[0]) > 0
    assert corners[np.argmin(uv[:, 1]), 1] == corners[:, 1].max()
    assert document.asset.extras["crazing"]["command"] == "texture"


def test_a_reader_of_materialx_finds_the_material(scene) -> None:
    import MaterialX

    document = MaterialX.createDocument()
    MaterialX.readFromXmlFile(document, str(scene / "mud.mtlx"))
    valid, message = document.validate()
    assert valid, message
    material = document.getMaterialNodes()[0]
    (surface,) = MaterialX.getShaderNodes(material, "surfaceshader")
    assert surface.getCategory() == "standard_surface"
    graph = document.getNodeGraphs()[0]
    files = {node.getName(): node.getInputValue("file") for node in graph.getNodes("image")}
    assert set(files) == {"color", "roughness", "normal_gl", "height"}
    assert all((scene / file).exists() for file in files.values())
    for port in ("base_color", "specular_roughness", "normal"):
        assert surface.getInput(port).getConnectedOutput() is not None
    (moved,) = MaterialX.getShaderNodes(material, "displacementshader")
    assert moved.getInputValue("scale") > 0
    assert json.loads(ElementTree.parse(scene / "mud.mtlx").getroot().get("doc"))["command"] == "texture"


@pytest.mark.parametrize("form", ["png16", "tiff16", "tiff32", "exr16", "exr32"])
def test_the_nodes_of_materialx_make_of_every_format_the_same_colours_and_normals(texture, tmp_path, form) -> None:
    import MaterialX

    texture.save(tmp_path / "a", name="a", format=form)
    document = MaterialX.createDocument()
    MaterialX.readFromXmlFile(document, str(tmp_path / "a" / "a.mtlx"))
    assert document.validate()[0]
    graph = document.getNodeGraphs()[0]

    def value(node):
        if node.getCategory() == "image":
            return samples(tmp_path / "a" / node.getInputValue("file"))
        if node.getCategory() == "normalmap":
            return 2 * value(node.getConnectedNode("in")) - 1
        act = {"multiply": np.multiply, "add": np.add}[node.getCategory()]
        return act(value(node.getConnectedNode("in1")), node.getInputValue("in2"))

    normals = value(graph.getOutput("out_normal_gl").getConnectedNode())
    np.testing.assert_allclose(normals, texture["normal"], atol=2e-3)
    color = graph.getNode("color")
    is_encoded = color.getInput("file").getColorSpace() == "srgb_texture"
    light = linear(value(color)) if is_encoded else value(color)
    np.testing.assert_allclose(light, linear(texture["color"] / 255), atol=1e-3)


def linear(level: np.ndarray) -> np.ndarray:
    """Light by levels of sRGB, IEC 61966-2-1."""
    return np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)


def samples(path: Path) -> np.ndarray:
    """A picture as numbers: whole ones from 0 to 1, floats as they are."""
    if path.suffix == ".exr":
        import OpenEXR

        with OpenEXR.File(str(path)) as file:
            return file.channels()["RGB"].pixels.astype(float)
    array = imagecodecs.imread(path)
    return array / np.iinfo(array.dtype).max if array.dtype.kind == "u" else array.astype(float)


def test_a_periodic_texture_repeats_in_its_scenes(tmp_path) -> None:
    crack = cz.crack(n=40, period=(1, 1), rng=1)
    cz.texture(crack, 64, maps=["color"]).save(tmp_path / "a", name="a")
    assert json.loads((tmp_path / "a" / "a.gltf").read_text())["samplers"][0]["wrapS"] == 10497
    assert 'value="periodic"' in (tmp_path / "a" / "a.mtlx").read_text()
    assert math.isclose(record_of(tmp_path / "a" / "color.png")["texture"]["texel_size"], 1 / 64)


@pytest.mark.parametrize(
    ("bounds", "size", "tiles"),
    [
        (None, (96, 64), True),
        ((0.1, 0.1, 0.6, 0.85), (96, 64), False),
        ((0, 0, 2, 1.5), (96, 128), True),
        ((0, 0, 1, 3), (96, 32), True),
        ((0, 0, 1.5, 1.5), (96, 96), False),
    ],
)
def test_a_part_of_a_period_does_not_repeat(tmp_path, bounds, size, tiles) -> None:
    """Its lower border lay in front of its upper one: it cast shadows, and scenes laid it side by side."""
    crack = cz.crack(preset="bark", period=(1.0, 1.5), rng=5)
    maps = ("color", "normal", "height", "ao", "roughness")
    shown = cz.texture(crack, size, maps=maps, bounds=bounds, material=cz.Material(relief=2.0, grain=0.1))
    assert shown.tiles == tiles
    assert cz.texture_plan(crack, size, maps="height", bounds=bounds).tiles == tiles
    shown.save(tmp_path / "a", name="a")
    assert ('value="periodic"' in (tmp_path / "a" / "a.mtlx").read_text()) == tiles
    alone = replace(shown, period=None)
    assert not alone.tiles and np.array_equal(shown.lit(), alone.lit()) != tiles
    if tiles:
        by = (17, -23)
        moved = replace(shown, maps={name: np.roll(array, by, axis=(0, 1)) for name, array in shown.maps.items()})
        np.testing.assert_array_equal(moved.lit(), np.roll(shown.lit(), by, axis=(0, 1)))
