"""A material in MaterialX and a textured plane in glTF 2.0, beside the pictures that they name."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from crazing.pictures.samples import Format

_CLAMP, _REPEAT, _LINEAR, _MIPMAPS = 33071, 10497, 9729, 9987
_FLOAT, _USHORT = 5126, 5123


@dataclass(frozen=True)
class Scene:
    """What a scene shows."""

    name: str
    files: Mapping[str, str]
    """The file of each picture."""
    sides: tuple[float, float]
    """Width and height, metres."""
    relief: float
    """What heights from 0 to 1 are, metres."""
    tiles: bool
    """Whether the texture repeats."""
    form: Format
    """How the pictures are stored."""
    record: Mapping[str, Any]


def materialx(scene: Scene) -> str:
    """The text of an .mtlx file: a standard surface with the pictures that are there."""
    name = re.sub(r"\W", "_", scene.name)
    mode = "periodic" if scene.tiles else "clamp"
    nodes, surface, material = [], [], []
    for picture, kind, space, port in (
        ("color", "color3", "lin_rec709" if scene.form.kind == "exr" else "srgb_texture", "base_color"),
        ("roughness", "float", "", "specular_roughness"),
        ("normal_gl", "vector3", "", "normal"),
        ("height", "float", "", ""),
    ):
        if picture not in scene.files:
            continue
        nodes.append(_image(picture, kind, space, scene.files[picture], mode))
        out = picture
        if picture == "normal_gl":
            out = "bumped"
            nodes.extend(_normals(picture, out, has_signs=scene.form.bits == 32 or scene.form.kind == "exr"))
        nodes.append(f'    <output name="out_{picture}" type="{kind}" nodename="{out}" />')
        if port:
            surface.append(_wire(port, kind, f"NG_{name}", picture))
    shaders = [_shader("standard_surface", f"SR_{name}", "surfaceshader", surface)]
    material.append(f'    <input name="surfaceshader" type="surfaceshader" nodename="SR_{name}" />')
    if "height" in scene.files:
        scale = f'    <input name="scale" type="float" value="{scene.relief!r}" />'
        wires = [_wire("displacement", "float", f"NG_{name}", "height"), scale]
        shaders.append(_shader("displacement", f"DR_{name}", "displacementshader", wires))
        material.append(f'    <input name="displacementshader" type="displacementshader" nodename="DR_{name}" />')
    return "\n".join(
        [
            '<?xml version="1.0"?>',
            f'<materialx version="1.38" colorspace="lin_rec709" doc={_quoted(json.dumps(scene.record))}>',
            f'  <nodegraph name="NG_{name}">',
            *nodes,
            "  </nodegraph>",
            *shaders,
            f'  <surfacematerial name="{name}" type="material">',
            *material,
            "  </surfacematerial>",
            "</materialx>",
            "",
        ]
    )


def _quoted(text: str) -> str:
    # It brings urllib and http with it.
    from xml.sax.saxutils import quoteattr

    return quoteattr(text)


def _node(kind: str, name: str, result: str, *inputs: str) -> str:
    return "\n".join(
        [f'    <{kind} name="{name}" type="{result}">', *(f"      {line}" for line in inputs), f"    </{kind}>"]
    )


def _normals(picture: str, out: str, *, has_signs: bool) -> Iterator[str]:
    """The nodes that make normals of a picture: `normalmap` takes 0 to 1, where floats are stored from -1 to 1."""
    if has_signs:
        for kind, name, value in (("multiply", "halved", picture), ("add", "levels", "halved")):
            first = f'<input name="in1" type="vector3" nodename="{value}" />'
            yield _node(kind, name, "vector3", first, '<input name="in2" type="float" value="0.5" />')
        picture = "levels"
    yield _node("normalmap", out, "vector3", f'<input name="in" type="vector3" nodename="{picture}" />')


def _image(picture: str, kind: str, space: str, file: str, mode: str) -> str:
    where = f' colorspace="{space}"' if space else ""
    modes = (f'<input name="{axis}addressmode" type="string" value="{mode}" />' for axis in "uv")
    return _node("image", picture, kind, f'<input name="file" type="filename" value={_quoted(file)}{where} />', *modes)


def _wire(port: str, kind: str, graph: str, picture: str) -> str:
    return f'    <input name="{port}" type="{kind}" nodegraph="{graph}" output="out_{picture}" />'


def _shader(kind: str, name: str, result: str, lines: list[str]) -> str:
    return "\n".join([f'  <{kind} name="{name}" type="{result}">', *lines, f"  </{kind}>"])


def gltf(scene: Scene) -> str:
    """The text of a .gltf file: an upright plane of the true size that faces +Z, with the pictures that are there."""
    views, buffer = _plane(*scene.sides)
    textures = {picture: index for index, picture in enumerate(p for p in _SHOWN if p in scene.files)}
    wrap = _REPEAT if scene.tiles else _CLAMP
    document = {
        "asset": {"version": "2.0", "generator": "crazing", "extras": {"crazing": dict(scene.record)}},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": scene.name}],
        "meshes": [{"name": scene.name, "primitives": [_primitive()]}],
        "materials": [_material(scene.name, textures)],
        "textures": [{"source": index, "sampler": 0} for index in textures.values()],
        "images": [{"uri": scene.files[picture], "mimeType": "image/png", "name": picture} for picture in textures],
        "samplers": [{"magFilter": _LINEAR, "minFilter": _MIPMAPS, "wrapS": wrap, "wrapT": wrap}],
        "accessors": _accessors(*scene.sides),
        "bufferViews": views,
        "buffers": [
            {
                "byteLength": len(buffer),
                "uri": "data:application/octet-stream;base64," + base64.b64encode(buffer).decode("ascii"),
            }
        ],
    }
    return json.dumps(document, indent=1, allow_nan=False) + "\n"


_SHOWN = ("color", "normal_gl", "orm")


def _material(name: str, textures: Mapping[str, int]) -> dict[str, Any]:
    surface: dict[str, Any] = {"metallicFactor": 0.0}
    material: dict[str, Any] = {"name": name, "pbrMetallicRoughness": surface}
    if "color" in textures:
        surface["baseColorTexture"] = {"index": textures["color"]}
    if "orm" in textures:
        surface["metallicRoughnessTexture"] = {"index": textures["orm"]}
        material["occlusionTexture"] = {"index": textures["orm"]}
    if "normal_gl" in textures:
        material["normalTexture"] = {"index": textures["normal_gl"]}
    return material


def _primitive() -> dict[str, Any]:
    names = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0")
    return {"attributes": {name: index for index, name in enumerate(names)}, "indices": 4, "material": 0}


def _corners(width: float, height: float) -> np.ndarray[Any, np.dtype[np.float32]]:
    signs = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]])
    return (signs * [width / 2, height / 2, 0]).astype(np.float32)


def _plane(width: float, height: float) -> tuple[list[dict[str, int]], bytes]:
    """Four corners, counter-clockwise from below on the left; v runs down, as the rows of a picture do."""
    arrays: list[np.ndarray[Any, Any]] = [
        _corners(width, height),
        np.tile(np.array([0, 0, 1], np.float32), (4, 1)),
        np.tile(np.array([1, 0, 0, 1], np.float32), (4, 1)),
        np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32),
        np.array([0, 1, 2, 0, 2, 3], np.uint16),
    ]
    ends = np.cumsum([array.nbytes for array in arrays]).tolist()
    views = [
        {"buffer": 0, "byteOffset": end - array.nbytes, "byteLength": array.nbytes, "target": target}
        for array, end, target in zip(arrays, ends, (34962, 34962, 34962, 34962, 34963), strict=True)
    ]
    return views, b"".join(array.tobytes() for array in arrays)


def _accessors(width: float, height: float) -> list[dict[str, Any]]:
    corners = _corners(width, height)
    kinds = ((_FLOAT, 4, "VEC3"), (_FLOAT, 4, "VEC3"), (_FLOAT, 4, "VEC4"), (_FLOAT, 4, "VEC2"), (_USHORT, 6, "SCALAR"))
    found: list[dict[str, Any]] = [
        {"bufferView": index, "componentType": component, "count": count, "type": kind}
        for index, (component, count, kind) in enumerate(kinds)
    ]
    found[0] |= {"min": corners.min(axis=0).tolist(), "max": corners.max(axis=0).tolist()}
    return found
