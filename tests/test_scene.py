"""MaterialX and glTF beside the maps, opened by readers of others."""

from __future__ import annotations

import json
import math
import xml.etree.ElementTree as ElementTree
from pathlib import Path

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


def test_a_periodic_texture_repeats_in_its_scenes(tmp_path) -> None:
    crack = cz.crack(n=40, period=(1, 1), rng=1)
    cz.texture(crack, 64, maps=["color"]).save(tmp_path / "a", name="a")
    assert json.loads((tmp_path / "a" / "a.gltf").read_text())["samplers"][0]["wrapS"] == 10497
    assert 'value="periodic"' in (tmp_path / "a" / "a.mtlx").read_text()
    assert math.isclose(record_of(tmp_path / "a" / "color.png")["texture"]["texel_size"], 1 / 64)
