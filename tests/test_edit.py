"""The editor without its page: files of points, messages, layers, and Python that makes the same."""

from __future__ import annotations

import io
import json
import re
import zlib
from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
import traitlets
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray
from PIL import Image

import crazing as cz
from crazing.edit import exchange, front, knobs, layers, samples, wire
from crazing.edit.script import script
from crazing.edit.session import Message, Session

Points = NDArray[np.float64]
FINITE = st.floats(-1e300, 1e300, allow_nan=False)
POINTS = arrays.arrays(np.float64, st.tuples(st.integers(0, 30), st.just(2)), elements=FINITE)
EDGES = np.array([(0.1, -0.0), (5e-324, -1e300), (1 / 3, 2.0**53 + 2)])
STAR = samples.points_of("star", 120, 0)
MODES = ("skeleton", "compare", "maze", "crack")


def raw(points: Points) -> list[bytes]:
    return [points.astype("<f8").tobytes()]


def asked(session: Session, kind: str, buffers: list[bytes] | None = None, **content: Any) -> Message:
    reply = session.answer({"kind": kind, "serial": 1, **content}, [] if buffers is None else buffers)
    assert reply.content["serial"] == 1
    json.dumps(reply.content, allow_nan=False)
    return reply


def good(session: Session, kind: str, buffers: list[bytes] | None = None, **content: Any) -> Message:
    reply = asked(session, kind, buffers, **content)
    assert reply.content["kind"] != "error", reply.content
    return reply


def points_in(reply: Message) -> Points:
    return np.frombuffer(reply.buffers[0], dtype="<f8").reshape(-1, 2)


# ---- files of points


@settings(deadline=None)
@given(points=POINTS, ending=st.sampled_from(exchange.FORMATS))
@example(points=EDGES, ending="csv")
@example(points=EDGES, ending="npy")
@example(points=EDGES, ending="svg")
@example(points=EDGES, ending="geojson")
def test_points_come_back_to_the_last_bit(points: Points, ending: str) -> None:
    assert exchange.load(exchange.written(points, ending)).tobytes() == points.tobytes()


def test_other_programs_read_the_files() -> None:
    content = {ending: exchange.written(STAR, ending) for ending in exchange.FORMATS}
    table = np.loadtxt(io.BytesIO(content["csv"]), delimiter=",", skiprows=1)
    circles = ElementTree.fromstring(content["svg"]).iter("{http://www.w3.org/2000/svg}circle")
    assert np.array_equal(table, STAR)
    assert np.array_equal(np.load(io.BytesIO(content["npy"]), allow_pickle=False), STAR)
    assert json.loads(content["geojson"])["geometry"]["coordinates"] == STAR.tolist()
    assert [[float(c.get("cx", "")), -float(c.get("cy", ""))] for c in circles] == STAR.tolist()


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (b"x;y\r\n1;2\r\n\r\n3;4\r\n", [[1, 2], [3, 4]]),
        (b"\xef\xbb\xbf1 2 9\n3\t4\t9", [[1, 2], [3, 4]]),
        (b"", []),
        (b'{"type": "Point", "coordinates": [1, 2, 9]}', [[1, 2]]),
        (
            b'{"type": "FeatureCollection", "features": [{"geometry": {"type": "Polygon", '
            b'"coordinates": [[[1, 2], [3, 4]]]}}, {"geometry": null}, '
            b'{"geometry": {"geometries": [{"coordinates": [5, 6]}]}}]}',
            [[1, 2], [3, 4], [5, 6]],
        ),
    ],
)
def test_forms_of_other_programs_are_read(content: bytes, wanted: list[list[float]]) -> None:
    assert exchange.load(content).tolist() == wanted


def npy(array: NDArray[Any]) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


PROMISE = np.lib.format.magic(1, 0) + (118).to_bytes(2, "little")
PROMISE += b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 2), }".ljust(117) + b"\n"
DEEP = b"[" * 100_000
LAUGHS = (
    b'<!DOCTYPE svg [<!ENTITY a "aaaa">]><svg xmlns="http://www.w3.org/2000/svg"><g id="crazing-points">&a;</g></svg>'
)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"1,2\n3,four", "line 2 is '3,four'"),
        (b"1,2\n3", "line 2 is '3'"),
        (b"1,nan", r"points\[0\] is \(1.0, nan\)"),
        (PROMISE, "header does not fit"),
        (npy(np.array([{}], dtype=object)), "NPY file cannot be read|does not fit"),
        (npy(np.zeros((3, 3))), r"shape \(3, 3\)"),
        (npy(np.zeros((3, 2)))[:-1], "does not fit"),
        (b"\x93NUMPY\x09\x00", "NPY file cannot be read"),
        (DEEP, "GeoJSON cannot be read"),
        (b'{"coordinates": ["a", 1]}', "where positions are wanted"),
        (b'{"coordinates": [1e999, 1]}', "finite"),
        (b"<svg", "SVG cannot be read"),
        (LAUGHS, "document type"),
        (b'<svg><g id="crazing-points"><circle cx="a"/></g></svg>', "no position"),
        (b"\xff\xfe\x00\x01", "no CSV, NPY, GeoJSON or SVG"),
    ],
)
def test_damaged_files_get_one_clear_error(content: bytes, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        exchange.load(content)


def test_too_many_points_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exchange, "MOST_POINTS", 3)
    with pytest.raises(cz.CrazingError, match="at most 3"):
        exchange.checked(np.zeros((4, 2)))
    with pytest.raises(cz.CrazingError, match="more than 3"):
        exchange.load(b"1,2\n" * 4)


# ---- messages


@settings(max_examples=40, deadline=None)
@given(content=st.dictionaries(st.text(), st.text(), max_size=3), buffers=st.lists(st.binary(max_size=64), max_size=3))
def test_frames_come_back(content: dict[str, Any], buffers: list[bytes]) -> None:
    frame = wire.packed(Message(content, buffers))
    assert len(frame) % 8 == 0
    assert wire.unpacked(frame) == Message(content, buffers)


@settings(deadline=None)
@given(frame=st.binary(max_size=200))
@example(frame=b"\x02\0\0\0{}")
@example(frame=b"\xff\xff\xff\xff{}")
@example(frame=b'\x22\0\0\0{"content": {}, "sizes": [1000000]}')
@example(frame=b'\x20\0\0\0{"content": {}, "sizes": [-9999]}')
@example(frame=b'\x1c\0\0\0{"content": {}, "sizes": [1')
def test_broken_frames_are_refused(frame: bytes) -> None:
    with pytest.raises(cz.CrazingError, match="frame"):
        wire.unpacked(frame)


WORD = st.one_of(st.none(), st.booleans(), st.integers(), FINITE, st.text(max_size=9), st.just([1, 2]))
KINDS = st.sampled_from(["hello", "layers", "sample", "load", "contour", "save", "export", "script", "x"])
NAMES = st.sampled_from(
    ["mode", "values", "preview", "sampler", "n", "seed", "level", "format", "what", "size", "source"]
)


@settings(max_examples=60, deadline=None)
@given(
    kind=KINDS,
    content=st.dictionaries(NAMES, st.one_of(WORD, st.dictionaries(st.sampled_from(MODES), WORD))),
    buffers=st.lists(st.one_of(st.binary(max_size=64), st.just(STAR.tobytes())), max_size=2),
)
def test_whatever_is_sent_is_answered(kind: str, content: dict[str, Any], buffers: list[bytes]) -> None:
    # Large pictures are asked for elsewhere.
    content = {name: value for name, value in content.items() if not (name in ("size", "n") and isinstance(value, int))}
    reply = asked(Session(), kind, buffers, **content)
    assert "a bug" not in reply.content.get("message", ""), reply.content


@pytest.mark.parametrize("content", [None, [], "hello", {"kind": ["layers"]}, {"kind": "layers", "serial": {"a": 1}}])
def test_what_is_no_message_is_answered(content: Any) -> None:
    assert Session().answer(content).content["kind"] == "error"


@pytest.mark.parametrize(
    ("panel", "name", "value"),
    [
        ("crack", "opening", 2),
        ("crack", "opening", "1"),
        ("crack", "seed", -1),
        ("crack", "seed", 1.5),
        ("maze", "tree", "oak"),
        ("skeleton", "delaunay", 1),
        ("skeleton", "iterations", 6),
        ("skeleton", "nonsense", 1),
        ("nonsense", "seed", 1),
    ],
)
def test_knobs_refuse_what_they_do_not_take(panel: str, name: str, value: Any) -> None:
    with pytest.raises((TypeError, ValueError), match=name if panel != "nonsense" else "nonsense"):
        knobs.read({panel: {name: value}})


def test_limits_hold() -> None:
    session = Session()
    for content in ({"kind": "export", "what": "png", "size": 10**6}, {"kind": "layers", "preview": 10**6}):
        reply = asked(session, **content, mode="crack", buffers=raw(STAR))
        assert "it must be from" in reply.content["message"]
    values = {"skeleton": {"nested": True, "iterations": 5}}
    crowd = cz.sample.uniform(20_000, rng=1)
    reply = asked(session, "layers", raw(crowd), mode="skeleton", values=values)
    assert "too many" in reply.content["message"]
    assert (
        asked(session, "layers", [b"123"], mode="maze").content["message"]
        == "points have 3 bytes; 16 a point are wanted"
    )
    assert "finite" in asked(session, "layers", raw(np.array([[np.nan, 0]])), mode="maze").content["message"]


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize("points", [[], [(0, 0)], [(0, 0), (1, 1)], [(0, 0), (1, 1), (2, 2)], [(1, 1)] * 5])
def test_few_or_flat_points_are_no_error(mode: str, points: list[tuple[float, float]]) -> None:
    reply = good(Session(), "layers", raw(np.array(points, dtype=float).reshape(-1, 2)), mode=mode)
    assert (reply.content["note"] == "") == (not points) or mode in ("maze", "crack")


def test_a_session_remembers() -> None:
    session = Session([(0, 0), (1, 0), (0, 1)])
    assert points_in(good(session, "hello")).tolist() == [[0, 0], [1, 0], [0, 1]]
    values = knobs.defaults()
    values["maze"]["tree"] = "prim"
    good(session, "layers", raw(STAR), mode="maze", values=values)
    state = good(session, "hello")
    assert np.array_equal(points_in(state), STAR)
    assert (state.content["mode"], state.content["values"]) == ("maze", values)


def test_layers_far_from_the_origin_stay_sharp() -> None:
    far = np.round(STAR * 100) + np.array([5e8, -7e8])
    values = {"skeleton": {"delaunay": True, "axis": False, "crust": False}}
    reply = good(Session(), "layers", raw(far), mode="skeleton", values=values)
    drawn = np.frombuffer(reply.buffers[0], dtype="<f4").reshape(-1, 2, 2).astype(float) + reply.content["origin"]
    assert np.allclose(drawn, cz.diagram(far).delaunay.segments, rtol=0, atol=1e-5)


# ---- Python that makes the same


def varied() -> Iterator[tuple[str, dict[str, Any]]]:
    """Every mode with every knob away from its default at least once."""
    for panel, described in knobs.PANELS.items():
        yield panel, {}
        for knob in described:
            for value in knob.choices[:4] or (not knob.default if knob.kind == "switch" else None,):
                if value is not None:
                    yield panel, {knob.name: value}
            if knob.kind in ("number", "count", "seed"):
                middle = (knob.low + 2 * knob.high) / 3 if knob.kind == "number" else max(2, min(int(knob.high), 3))
                needs = dict([knob.needs.split(":")]) if ":" in knob.needs else {knob.needs: True} if knob.needs else {}
                yield panel, {**needs, knob.name: middle}
    yield "skeleton", {"axis_method": "one-step", "prune": True, "residual": 0.05}
    for name in list(knobs.recipes())[::4]:
        steps = {step: getattr(knobs.recipes()[name], step) for step in knobs.recipe_fields()}
        yield "crack", {"recipe": name, **steps}


def same(layer: layers.Layer, made: Any) -> bool:
    if layer.graph is None:
        return np.array_equal(layer.marks, made)
    return np.array_equal(layer.graph.segments, made.segments)


@pytest.mark.parametrize(("mode", "given_values"), list(varied()), ids=str)
def test_the_copied_python_makes_the_same(
    mode: str, given_values: dict[str, Any], tmp_path: Any, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    values = knobs.read({mode: given_values})
    text = good(Session(), "script", raw(STAR), mode=mode, values=values).content["text"]
    names: dict[str, Any] = {}
    # Its picture is a large one; no pixel is looked at here.
    exec(text.replace("1024", "32"), names)
    assert "points" not in names or np.array_equal(names["points"], STAR)
    drawing = layers.draw(STAR, mode, values[mode])
    assert drawing.layers
    for layer in drawing.layers:
        word, _, number = layer.name.partition("-") if layer.name.startswith("nested") else (layer.name, "", "")
        if word == "ends":
            continue
        made = names[word.replace("-", "_")]
        if word == "crack":
            assert made == drawing.subject
            made = made.graph
        assert same(layer, made[int(number)] if number else made), layer.name


def test_a_sampler_is_named_only_if_it_made_the_points() -> None:
    source = {"sampler": "laplace", "n": 50, "seed": 3}
    points = cz.sample.laplace(50, rng=3)
    assert "cz.sample.laplace(50, rng=3)" in script(points, "maze", knobs.defaults()["maze"], source)
    moved = points.copy()
    moved[7, 0] += 1e-9
    text = script(moved, "maze", knobs.defaults()["maze"], source)
    assert "laplace" not in text
    assert repr(float(moved[7, 0])) in text


# ---- samplers and pictures


@pytest.mark.parametrize("name", samples.SAMPLERS)
def test_samplers_are_those_of_the_library(name: str) -> None:
    reply = good(Session(), "sample", sampler=name, n=40, seed=5)
    assert np.array_equal(points_in(reply), getattr(cz.sample, name)(40, rng=5))
    assert reply.content["source"] == {"sampler": name, "n": 40, "seed": 5}


@pytest.mark.parametrize("name", samples.OUTLINES)
def test_outlines_are_closed_curves(name: str) -> None:
    points = samples.points_of(name, 200, 0)
    assert set(cz.curve(points).degrees.tolist()) == {2}


def disc(size: int = 200, radius: float = 60.0) -> bytes:
    row, column = np.mgrid[:size, :size] + 0.5
    inside = np.hypot(row - size / 2, column - size / 2) < radius
    file = io.BytesIO()
    Image.fromarray((255 * ~inside).astype(np.uint8)).save(file, "PNG")
    return file.getvalue()


def test_a_picture_gives_its_contour() -> None:
    session = Session()
    assert good(session, "load", [disc()]).content == {
        "kind": "picture", "width": 200, "height": 200, "of": "load", "serial": 1,
    }  # fmt: skip
    plain = points_in(good(session, "contour", n=100))
    wanted = cz.sample.from_image(np.asarray(Image.open(io.BytesIO(disc()))), n=100)
    assert np.array_equal(plain, wanted)
    smooth = points_in(good(session, "contour", n=100, smoothing=4))
    away = [np.abs(np.hypot(*(points - 100).T) - 60) for points in (plain, smooth)]
    assert away[1].max() < away[0].max()
    assert away[1].max() < 1
    rings = points_in(good(session, "contour", n=99, smoothing=6, levels=3, spread=0.8))
    radii = np.hypot(*(rings - 100).T)
    assert np.ptp(radii) > 4


def test_a_large_picture_is_traced_smaller_and_placed_at_its_size() -> None:
    session = Session()
    good(session, "load", [disc(2050, 800)])
    radii = np.hypot(*(points_in(good(session, "contour", n=300)) - 1025).T)
    assert np.abs(radii - 800).max() < 3


def test_hostile_pictures_are_refused() -> None:
    header = io.BytesIO()
    Image.new("1", (8, 8)).save(header, "PNG")
    bomb = bytearray(header.getvalue())
    bomb[16:24] = (60_000).to_bytes(4, "big") * 2
    bomb[29:33] = zlib.crc32(bytes(bomb[12:29])).to_bytes(4, "big")
    session = Session()
    assert re.search("pixels.*(at most|exceeds)", asked(session, "load", [bytes(bomb)]).content["message"])
    assert "cannot be read" in asked(session, "load", [disc()[:300]]).content["message"]
    assert "no picture" in asked(session, "contour").content["message"]
    for content in (b"%PDF-1.4\xff\xfe", b"GIF8\x00", b"\x89PNG\r\n\x1a\n", b"BMxxxxxxxx", b"II*\x00\x00\x00\x00\x00"):
        assert asked(session, "load", [content]).content["kind"] == "error"


def test_a_drawing_of_others_is_left_to_the_browser() -> None:
    other = (
        b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"><script>alert(1)</script><path d="M0 0"/></svg>'
    )
    assert good(Session(), "load", [other]).content["kind"] == "drawing"


# ---- what can be taken away


@pytest.mark.parametrize("mode", MODES)
def test_svg_and_dxf_hold_the_layers(mode: str) -> None:
    session = Session()
    values = knobs.read({"skeleton": {"poles": True, "nested": True, "delaunay": True, "iterations": 2}})
    drawing = layers.draw(STAR, mode, values[mode])
    svg = good(session, "export", raw(STAR), mode=mode, values=values, what="svg").buffers[0]
    groups = {g.get("id"): g for g in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}g")}
    dxf = good(session, "export", raw(STAR), mode=mode, values=values, what="dxf").buffers[0]
    document = ezdxf.read(io.StringIO(dxf.decode()))
    assert not document.audit().errors
    space = document.modelspace()
    lines = {layer.name: layer for layer in drawing.layers if layer.name in groups and layer.graph is not None}
    assert set(groups) == {"points", *lines, *(layer.name for layer in drawing.layers if layer.marks is not None)}
    for name, layer in lines.items():
        assert layer.graph is not None
        coords, offsets = layer.graph.polylines()
        found = re.findall(r"M([^M]*)", groups[name][0].get("d", ""))
        drawn = [np.array(part.replace("L", " ").split(), dtype=float).reshape(-1, 2) * (1, -1) for part in found]
        assert [len(part) for part in drawn] == np.diff(offsets).tolist()
        assert np.array_equal(np.concatenate([np.empty((0, 2)), *drawn]), coords)
        assert len(space.query(f'LWPOLYLINE[layer=="{name.upper()}"]')) == len(drawn)
    assert len(space.query('POINT[layer=="POINTS"]')) == len(STAR)


@pytest.mark.parametrize("mode", MODES)
def test_png_has_the_size_asked_for(mode: str) -> None:
    wide = STAR * (2, 1)
    reply = good(Session(), "export", raw(wide), mode=mode, what="png", size=300)
    picture = np.asarray(Image.open(io.BytesIO(reply.buffers[0])).convert("RGB"))
    assert max(picture.shape) == 300
    assert picture.shape[1] > picture.shape[0]
    assert 0.002 < (picture.mean(axis=2) < 128).mean() < 0.6


def test_nothing_is_no_file() -> None:
    reply = asked(Session(), "export", raw(np.empty((0, 2))), mode="maze", what="svg")
    assert "nothing to be written" in reply.content["message"]


# ---- the widget and the module


def test_the_widget_is_live_in_both_directions() -> None:
    editor = cz.edit(STAR)
    sent: list[tuple[Any, Any]] = []
    editor.send = lambda content, buffers: sent.append((content, buffers))
    seen: list[int] = []
    editor.observe(lambda change: seen.append(len(change.new)), "points")
    editor._handle_custom_msg({"kind": "layers", "serial": 4, "mode": "maze"}, [memoryview(STAR[:50].tobytes())])
    assert (sent[0][0]["kind"], sent[0][0]["serial"]) == ("layers", 4)
    # What the page sets comes as bytes.
    editor.set_state({"points": memoryview(STAR[:9].tobytes())})
    assert seen == [9]
    assert np.array_equal(editor.points, STAR[:9])
    editor.points = [(1, 2)]
    editor._handle_custom_msg({"kind": "hello", "serial": 5}, [])
    assert np.frombuffer(sent[1][1][0]).tolist() == [1, 2]
    with pytest.raises((traitlets.TraitError, ValueError), match="finite"):
        editor.points = [(1, np.inf)]
    with pytest.raises(ValueError, match="opening"):
        editor.settings = {"crack": {"opening": 3}}
    editor.settings = {"mode": "crack", "crack": {"opening": 0.25}}
    assert editor.settings["crack"]["opening"] == 0.25
    with pytest.raises(ValueError, match="read-only"):
        editor.points[0, 0] = 5


def test_one_module_is_made_of_parts_that_share_no_name() -> None:
    declared = r"^(?:export )?(?:async )?(?:class|const|function|let) (\w+)"
    names = [
        name for part in front.PARTS for name in re.findall(declared, front.text(f"{part}.js"), flags=re.MULTILINE)
    ]
    assert len(names) == len(set(names))
    module = front.module()
    assert not re.search(r"^import ", module, flags=re.MULTILINE)
    assert re.findall(r"^export.*", module, flags=re.MULTILINE) == ["export default { render };"]


def test_parts_import_only_what_stands_before_them() -> None:
    for i, part in enumerate(front.PARTS):
        targets = re.findall(r'from "\./(\w+)\.js"', front.text(f"{part}.js"))
        assert set(targets) <= set(front.PARTS[:i]), part


@pytest.mark.parametrize("path", sorted(front.FOLDER.iterdir()), ids=lambda path: path.name)
def test_the_page_names_no_other_host(path: Any) -> None:
    text = path.read_text(encoding="utf-8")
    addresses = set(re.findall(r"(?:https?|wss?):?//[^\s\"'`]+", text)) | set(
        re.findall(r"url\([^)]*\)|@import.*", text)
    )
    assert addresses <= {"http://www.w3.org/2000/svg", "ws://${location.host}/socket"}
    for word in ("innerHTML", "insertAdjacentHTML", "document.write", "eval(", "new Function", "outerHTML"):
        assert word not in text
