"""The editor without its page: messages, limits, the widget and its module."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
import traitlets
from hypothesis import example, given, settings
from hypothesis import strategies as st

import crazing as cz
from crazing.edit import front, knobs, previews, wire
from crazing.edit.session import Message, Session
from edit_messages import MODES, STAR, asked, good, points_in, raw

FINITE = st.floats(-1e300, 1e300, allow_nan=False)


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


def test_a_recipe_takes_whatever_its_knobs_can_be_set_to() -> None:
    """The stretch of plates went down to a tenth on the page, and what it was set to below 1 was refused."""
    for knob in knobs.CRACK:
        for end in (knob.low, knob.high) if knob.name in knobs.recipe_fields() and not knob.choices else ():
            value = int(end) if knob.kind == "count" else end
            assert getattr(cz.Recipe().replace(**{knob.name: value}), knob.name) == value
            assert knob.help or knob.name == "n"


@pytest.mark.parametrize(("mode", "what"), [("maze", "recipe"), ("skeleton", "texture"), ("compare", "lit")])
def test_a_mode_has_its_own_files(mode: str, what: str) -> None:
    reply = asked(Session(), "export", raw(STAR), what=what, mode=mode)
    assert f"what is '{what}'; one of 'png', 'svg', 'dxf' is wanted" in reply.content["message"]


def test_limits_hold() -> None:
    session = Session()
    reply = asked(session, "export", raw(STAR), what="png", size=10**6, mode="crack")
    assert "it must be from" in reply.content["message"]
    # A preview has a largest size, whatever is wished for.
    wish = {"scale": 1e9, "view": [-9, -9, 9, 9], "pixels": 10**9}
    reply = good(session, "layers", raw(STAR), mode="crack", preview=wish, later=True)
    assert max(reply.content["preview"]["width"], reply.content["preview"]["height"]) <= previews.LARGEST
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


# ---- previews


WHOLE = [-9, -9, 9, 9]


def test_rows_of_a_preview_are_those_of_the_whole() -> None:
    for material in ("ink", "mud-mature"):
        values = {"crack": {"material": material}}
        asking = {"mode": "crack", "values": values, "preview": {"scale": 90, "view": WHOLE, "pixels": 10**6}}
        session = Session()
        later = good(session, "layers", raw(STAR), **asking, later=True)
        assert len(later.buffers) == 2
        height = later.content["preview"]["height"]
        parts = [good(session, "rows", top=top, count=min(40, height - top)) for top in range(0, height, 40)]
        whole = good(session, "rows", top=0, count=height).buffers[0]
        assert b"".join(part.buffers[0] for part in parts) == whole
        assert "count" in asked(session, "rows", top=0, count=height + 1).content["message"]
    assert "no preview" in asked(Session(), "rows", top=0, count=1).content["message"]


def test_a_preview_shows_what_is_seen_at_the_size_it_is_seen_at() -> None:
    whole = good(Session(), "layers", raw(STAR), mode="crack", preview={"scale": 200, "view": WHOLE, "pixels": 10**7})
    shown = whole.content["preview"]
    assert np.allclose(shown["bounds"], shown["whole"], rtol=0, atol=1 / 200)
    assert abs(shown["width"] - 200 * (shown["whole"][2] - shown["whole"][0])) < 2
    near = {"scale": 800, "view": [0.4, 0.4, 0.6, 0.6], "pixels": 10**7}
    part = good(Session(), "layers", raw(STAR), mode="crack", preview=near).content["preview"]
    # A tenth more all round, and whole pixels.
    assert np.allclose(part["bounds"], [0.38, 0.38, 0.62, 0.62], rtol=0, atol=2 / 800)
    assert abs(part["width"] - 192) <= 2
    few = good(Session(), "layers", raw(STAR), mode="crack", preview={**near, "pixels": 900}).content["preview"]
    assert few["width"] * few["height"] <= 1100
    away = {"scale": 800, "view": [50, 50, 51, 51], "pixels": 900}
    assert "preview" not in good(Session(), "layers", raw(STAR), mode="crack", preview=away).content


def test_thin_cracks_are_left_to_the_page() -> None:
    values = {"crack": {"material": "ink", "thickness": 0.02, "taper": 0.0, "hierarchy": 0.0, "unevenness": 0.0}}

    def inked(scale: float) -> tuple[float, float, int]:
        wish = {"scale": scale, "view": WHOLE, "pixels": 10**7}
        reply = good(Session(), "layers", raw(STAR), mode="crack", values=values, preview=wish)
        widths = np.frombuffer(reply.buffers[reply.content["layers"][0]["widths"]], dtype="<f4")
        pixels = np.frombuffer(reply.buffers[-1], dtype=np.uint8).reshape(-1, 4)
        assert len(widths) * 16 == len(reply.buffers[0])
        return float(np.median(widths)), reply.content["preview"]["resolved"], int((pixels[:, :3] < 128).sum())

    width, resolved, dark = inked(100)
    assert width < resolved and dark == 0
    width, resolved, dark = inked(1500)
    assert width > resolved and dark > 1000


def test_what_nobody_would_see_is_left_out_while_points_move() -> None:
    def edges(roughness: float, scale: float) -> int:
        wish = {"preview": {"scale": scale, "view": WHOLE, "pixels": 10_000}, "moving": True, "later": True}
        values = {"crack": {"roughness": roughness}}
        return int(good(Session(), "layers", raw(STAR), mode="crack", values=values, **wish).content["rows"][0][1])

    assert edges(0.01, 100) == edges(0.0, 100) < edges(0.3, 4000)


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
