"""The Python that the editor copies makes what its page shows."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from PIL import Image

import crazing as cz
from crazing.edit import knobs, layers, samples
from crazing.edit.script import script
from crazing.edit.session import Session
from edit_messages import STAR, asked, good, raw

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


def smaller(text: str, size: int) -> str:
    """The script with pictures whose longer side has `size` pixels."""

    def shape(found: re.Match[str]) -> str:
        return str(tuple(max(1, round(int(side) * size / 1024)) for side in found.groups()))

    return re.sub(r"(?<=crack, )\((\d+), (\d+)\)", shape, text)


@pytest.mark.parametrize(("mode", "given_values"), list(varied()), ids=str)
def test_the_copied_python_makes_the_same(
    mode: str, given_values: dict[str, Any], tmp_path: Any, monkeypatch: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    values = knobs.read({mode: given_values})
    text = good(Session(), "script", raw(STAR), mode=mode, values=values).content["text"]
    names: dict[str, Any] = {}
    # Its picture is a large one; no pixel is looked at here.
    exec(smaller(text, 32), names)
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
    disk = {"sampler": "poisson_disk", "n": 300, "seed": 3}
    names: dict[str, Any] = {}
    exec(script(samples.points_of(**disk), "maze", knobs.defaults()["maze"], disk), names)
    assert np.array_equal(names["points"], samples.points_of(**disk))
    moved = points.copy()
    moved[7, 0] += 1e-9
    text = script(moved, "maze", knobs.defaults()["maze"], source)
    assert "laplace" not in text
    assert repr(float(moved[7, 0])) in text


def test_the_lit_picture_is_that_of_the_copied_python(tmp_path: Any, monkeypatch: Any) -> None:
    monkeypatch.chdir(tmp_path)
    shown = {"mode": "crack", "values": {"crack": {"material": "mud-mature"}}, "lamp": {"side": 300, "high": 25}}
    text = good(Session(), "script", raw(STAR), **shown).content["text"]
    exec(smaller(text, 80), {})
    made = np.asarray(Image.open(tmp_path / "lit.png"))
    reply = good(Session(), "export", raw(STAR), what="lit", size=80, **shown)
    assert reply.content["name"] == "lit.png"
    taken = np.asarray(Image.open(io.BytesIO(reply.buffers[0])))
    assert np.array_equal(taken, made)
    other = good(Session(), "export", raw(STAR), what="lit", size=80, **{**shown, "lamp": {"side": 120}})
    assert not np.array_equal(np.asarray(Image.open(io.BytesIO(other.buffers[0]))), made)
    for lamp in ({"high": 0}, {"side": "left"}, [135, 40]):
        assert asked(Session(), "script", raw(STAR), **{**shown, "lamp": lamp}).content["kind"] == "error"
