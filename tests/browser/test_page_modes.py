"""Layers, modes and files on the page."""

from __future__ import annotations

import io
import os
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

import crazing as cz
from conftest import Editor, Opener
from crazing.edit import exchange, samples

FLOWER = samples.points_of("flower", 150, 0)
AWKWARD = np.array([(0.1, -0.0), (1 / 3, 2e-7), (1e3 + 1e-10, -77.7), (5e-324, 12.5)])


def rows(editor: Editor) -> dict[str, list[str]]:
    """The table of counts that is shown."""
    table = editor.page.locator(".crz-counts:visible tbody tr")
    cells = [row.locator("th, td").all_inner_texts() for row in table.all()]
    return {name: values for name, *values in cells}


def shot(editor: Editor) -> NDArray[np.uint8]:
    picture = editor.page.locator(".crz-canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))


def far(a: NDArray[np.uint8], b: NDArray[np.uint8]) -> float:
    """The share of pixels that differ visibly."""
    return float((np.abs(a.astype(int) - b).max(axis=2) > 24).mean())


def test_layers_are_switched_and_counted(opened: Opener) -> None:
    editor = opened(FLOWER)
    found = rows(editor)
    skeleton = cz.medial_axis(FLOWER)
    assert found["crust edges"] == [str(len(skeleton.crust.edges))]
    assert found["axis edges"] == [str(len(skeleton.axis.edges))]
    before = shot(editor)
    for knob in ("delaunay", "voronoi", "poles", "curve", "nested"):
        editor.turn(knob, True)
        after = shot(editor)
        assert far(before, after) > 0.0005, knob
        before = after
    assert rows(editor)["nested 3, axis edges"]
    for method in ("one-step", "initial", "poles"):
        editor.turn("axis_method", method)
        assert rows(editor)["axis edges"] == [str(len(cz.medial_axis(FLOWER, method=method).axis.edges))]
    editor.turn("prune", True)
    assert "not pruned" in editor.page.locator(".crz-note").inner_text()
    editor.turn("axis_method", "one-step")
    assert not editor.page.locator(".crz-note").is_visible()
    pruned = cz.medial_axis(FLOWER, method="one-step").prune(0.025).axis
    assert rows(editor)["axis edges"] == [str(len(pruned.edges))]


def test_two_methods_as_overlay_and_split(opened: Opener) -> None:
    editor = opened(cz.sample.uniform(80, rng=3))
    editor.mode("compare")
    table = cz.compare(cz.sample.uniform(80, rng=3)).table
    assert rows(editor)["axis edges"] == [str(value) for value in table[1][1:]]
    overlay = shot(editor)
    editor.page.get_by_label("Split", exact=True).check()
    editor.rest()
    split = shot(editor)
    assert far(overlay, split) > 0.003
    assert editor.page.locator(".crz-side:visible").all_inner_texts() == ["one-step", "edge-filter"]
    slider = editor.page.locator(".crz-split")
    slider.focus()
    slider.press("End")
    editor.rest()
    assert far(split, shot(editor)) > 0.003
    assert len(editor.points) == 80


def test_maze_with_its_solution(opened: Opener) -> None:
    editor = opened(FLOWER)
    editor.mode("maze")
    assert rows(editor)["cells"] == ["150"]
    with_solution = shot(editor)
    editor.turn("solution", False)
    assert far(with_solution, shot(editor)) > 0.001
    editor.turn("cells", "in the curve")
    editor.turn("fill", 200)
    assert 20 < int(rows(editor)["cells"][0]) < 200
    editor.turn("fill", 1)
    assert "3 to" in editor.page.locator("[data-knob=fill] [role=alert]").inner_text()


def test_crack_under_a_moving_light(opened: Opener) -> None:
    editor = opened(cz.sample.uniform(60, rng=1))
    editor.mode("crack")
    editor.settle()
    dark = shot(editor)
    editor.turn("recipe", "painting-italian")
    editor.settle()
    # The knobs follow the recipe.
    opening = editor.page.locator("[data-knob=opening]:visible input").input_value()
    assert abs(float(opening) - cz.preset("painting-italian").opening) <= 0.005
    assert far(dark, shot(editor)) > 0.01
    lit = shot(editor).astype(int)
    editor.turn("side", 315)
    editor.page.wait_for_timeout(150)
    other = shot(editor).astype(int)
    assert np.abs(lit - other).max() > 40
    editor.turn("opening", 0)
    editor.settle()
    assert int(rows(editor)["edges"][0].replace(",", "")) > 50
    editor.turn("plates", "of the recipe")
    editor.settle()
    editor.do("clear")
    editor.settle()
    assert not editor.page.locator(".crz-empty").is_visible()
    assert int(rows(editor)["edges"][0].replace(",", "")) > 50


PREVIEW = """() => {
    const { preview, scene, view } = document.querySelector(".crz").editor;
    const { image, bounds } = scene.preview;
    return [image.width / (bounds[2] - bounds[0]) / view.scale, preview.covers, bounds[2] - bounds[0]];
}"""


def test_a_crack_at_rest_is_as_sharp_as_the_screen(opened: Opener) -> None:
    editor = opened(cz.sample.uniform(60, rng=1), device_scale_factor=2, width=900, height=600)
    editor.mode("crack")
    editor.settle()
    sharpness, covers, wide = editor.page.evaluate(PREVIEW)
    assert abs(sharpness - 2) < 0.02 and covers
    # Zoomed in, only what is seen is drawn, again as sharp.
    editor.page.mouse.move(*editor.place(0.5, 0.5))
    for _ in range(4):
        editor.page.mouse.wheel(0, -300)
    editor.settle()
    sharpness, covers, near = editor.page.evaluate(PREVIEW)
    assert abs(sharpness - 2) < 0.02 and covers and near < 0.5 * wide
    # While the pointer is down nothing large is drawn.
    x, y = editor.place(*editor.points[30])
    editor.do("fit")
    editor.settle()
    x, y = editor.place(*editor.points[30])
    editor.page.mouse.move(x, y)
    editor.page.mouse.down()
    editor.page.mouse.move(x + 20, y, steps=4)
    editor.page.wait_for_timeout(600)
    editor.rest()
    assert editor.page.evaluate(PREVIEW)[0] < 1.2
    editor.page.mouse.up()
    editor.settle()
    assert abs(editor.page.evaluate(PREVIEW)[0] - 2) < 0.02


def test_points_by_the_brightness_of_a_picture(opened: Opener) -> None:
    editor = opened()
    editor.drop("disc.png", disc("PNG"), "image/png")
    assert not editor.page.locator("[data-knob=dark]").is_visible()
    editor.turn("way", "by brightness")
    assert not editor.page.locator("[data-knob=level]").is_visible()
    editor.turn("smoothing", 0)
    grey = np.asarray(Image.open(io.BytesIO(disc("PNG")))) / 255
    assert np.array_equal(editor.points, cz.sample.from_density(1 - grey, 400, rng=7))
    editor.page.locator("[data-knob=dark]:visible input").uncheck()
    assert np.array_equal(editor.points, cz.sample.from_density(grey, 400, rng=7))


def disc(kind: str) -> bytes:
    row, column = np.mgrid[:160, :200] + 0.5
    grey = np.where(np.hypot(column - 100, row - 80) < 50, 30, 230).astype(np.uint8)
    file = io.BytesIO()
    Image.fromarray(grey).save(file, kind)
    return file.getvalue()


def test_a_dropped_picture_is_traced_with_sliders(opened: Opener) -> None:
    editor = opened()
    editor.drop("disc.png", disc("PNG"), "image/png")
    wanted = cz.sample.from_image(np.asarray(Image.open(io.BytesIO(disc("PNG")))), n=400)
    assert np.array_equal(editor.points, wanted)
    assert "disc.png, 200 \u00d7 160" in editor.page.locator(".crz-about").inner_text()
    for value in (60, 90, 120):
        editor.page.locator("[data-knob=n]:visible input").first.fill(str(value))
        editor.rest()
    assert len(editor.points) == 120
    editor.turn("smoothing", 6)
    editor.turn("levels", 2)
    radii = np.hypot(*(editor.points - (100, 80)).T)
    assert np.ptp(radii) > 3
    assert 40 < radii.min() < radii.max() < 60
    # All sliding was one step.
    editor.page.locator(".crz-canvas").focus()
    editor.page.keyboard.press("Control+z")
    assert len(editor.points) == 0


def test_a_dropped_drawing_is_traced(opened: Opener) -> None:
    editor = opened()
    drawing = (
        '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100" width="100" height="100">'
        '<image href="http://evil.example/x.png" width="9" height="9"/><script>fetch("http://evil.example")</script>'
        '<circle cx="50" cy="50" r="30"/></svg>'
    )
    editor.drop("circle.svg", drawing.encode(), "image/svg+xml")
    editor.page.wait_for_timeout(300)
    radii = np.hypot(*(editor.points - 512).T)
    assert len(radii) == 400
    assert np.abs(radii - 307.2).max() < 1


@pytest.mark.parametrize("ending", exchange.FORMATS)
def test_points_are_saved_and_opened_again(opened: Opener, ending: str) -> None:
    editor = opened(AWKWARD)
    editor.page.get_by_label("Format of the points").select_option(ending)
    name, content = editor.keep("save")
    assert name == f"points.{ending}"
    assert exchange.load(content).tobytes() == AWKWARD.tobytes()
    editor.do("clear")
    assert len(editor.points) == 0
    editor.page.set_input_files("input[type=file]", [{"name": name, "mimeType": "", "buffer": content}])
    editor.page.wait_for_timeout(200)
    assert editor.points.tobytes() == AWKWARD.tobytes()


def test_a_bad_file_is_told_where_it_was_opened(opened: Opener) -> None:
    editor = opened()
    bad = {"name": "bad.csv", "mimeType": "text/csv", "buffer": b"1,2\nx,y\n"}
    editor.page.set_input_files("input[type=file]", [bad])
    complaint = editor.page.locator(".crz-section", has_text="Generate").locator(".crz-complaint")
    complaint.get_by_text("line 2 is 'x,y'; two numbers are wanted").wait_for(timeout=5000)
    # It is seen, though the panel is longer than the window, and gone when a file could be read.
    box = complaint.bounding_box()
    assert box and 0 <= box["y"] < 760 - box["height"]
    good = {"name": "good.csv", "mimeType": "text/csv", "buffer": b"1,2\n3,5\n"}
    editor.page.set_input_files("input[type=file]", [good])
    editor.page.wait_for_function("() => document.querySelector('.crz').editor.cloud.size === 2")
    assert complaint.inner_text() == ""
    # The note comes with the answer, a moment after the points.
    editor.page.locator(".crz-note", has_text="Add 1 more point").wait_for(timeout=5000)
    editor.page.set_input_files("input[type=file]", [bad])
    complaint.get_by_text("line 2").wait_for(timeout=5000)
    assert "Add 1 more point" in editor.page.locator(".crz-note").inner_text()
    editor.drop("bad.csv", b"1,2\n3,<b>4</b>\n")
    assert "line 2 is '3,<b>4</b>'" in editor.page.locator(".crz-note").inner_text()


def made(text: str) -> dict[str, Any]:
    names: dict[str, Any] = {}
    exec(text, names)
    return names


def test_files_are_taken_away_and_read_back(opened: Opener, tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    editor = opened(FLOWER)
    _, svg = editor.keep("export-svg")
    groups = [g.get("id") for g in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}g")]
    assert groups == ["axis", "crust", "points"]
    _, dxf = editor.keep("export-dxf")
    assert {line.dxf.layer for line in ezdxf.read(io.StringIO(dxf.decode())).modelspace()} == {
        "AXIS",
        "CRUST",
        "POINTS",
    }
    editor.page.get_by_label("Pixels of the longer side").select_option("512")
    name, png = editor.keep("export-png")
    assert name == "skeleton.png"
    assert max(Image.open(io.BytesIO(png)).size) == 512
    editor.mode("crack")
    editor.turn("recipe", "painting-italian")
    editor.turn("opening", 0.5)
    name, recipe = editor.keep("export-recipe")
    (tmp_path / name).write_bytes(recipe)
    loaded = cz.Recipe.load(tmp_path / name)
    assert loaded == cz.preset("painting-italian").replace(opening=0.5)
    _, png = editor.keep("export-png")
    editor.do("script")
    editor.page.locator(".crz-script").wait_for()
    editor.page.wait_for_function("() => document.querySelector('.crz-script').value")
    names = made(editor.page.locator(".crz-script").input_value())
    assert names["crack"] == loaded.crack(FLOWER, bounds=names["crack"].bounds, rng=7)
    shown = cz.texture(
        names["crack"], Image.open(io.BytesIO(png)).size[::-1], maps="color", material="painting-italian", seed=7
    )
    assert np.array_equal(np.asarray(Image.open(io.BytesIO(png))), shown["color"])


def test_layers_follow_a_drag_of_two_thousand_points(opened: Opener) -> None:
    times: dict[str, float] = {}
    for mode in ("skeleton", "compare", "maze", "crack"):
        editor = opened(cz.sample.uniform(2000, rng=5))
        if mode == "skeleton":
            for knob in ("delaunay", "voronoi", "poles"):
                editor.turn(knob, True)
        editor.mode(mode)
        # The picture of rest, begun before the button is down, would wait until it is up.
        editor.settle()
        x, y = editor.place(*editor.points[1000])
        editor.page.mouse.move(x, y)
        editor.page.mouse.down()
        taken = []
        for i in range(9):
            editor.page.mouse.move(x + 2 * i, y + i)
            editor.rest()
            taken.append(float(editor.page.evaluate("() => document.querySelector('.crz').dataset.milliseconds")))
        editor.page.mouse.up()
        times[mode] = float(np.median(taken[3:]))
        assert not np.array_equal(editor.points[1000], cz.sample.uniform(2000, rng=5)[1000])
    print(
        "milliseconds from a move to its drawing, 2,000 points:", {name: round(value) for name, value in times.items()}
    )
    # A busy machine is slower than a quiet one; CRAZING_LIVE says how slow is too slow.
    assert max(times.values()) < float(os.environ.get("CRAZING_LIVE", "1000"))
