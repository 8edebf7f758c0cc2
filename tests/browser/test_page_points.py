"""Points on the page: what hand and keys do is what Python gets."""

from __future__ import annotations

import io

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from conftest import Editor, Opener

RING = [(0.2, 0.2), (0.8, 0.2), (0.8, 0.8), (0.2, 0.8), (0.5, 0.55)]


def shot(editor: Editor) -> NDArray[np.float64]:
    """Brightness of the canvas in pixels of the device."""
    picture = editor.page.locator(".crz-canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(picture)).convert("L"), dtype=float)


@pytest.mark.parametrize("ratio", [1, 1.5, 2])
def test_clicks_land_within_half_a_pixel(opened: Opener, ratio: float) -> None:
    editor = opened(device_scale_factor=ratio, width=1111, height=743)
    editor.mode("maze")
    left, top = editor.corner
    clicks = [(150.0, 130.0), (411.0, 97.0), (388.0, 402.0), (620.0, 333.0), (97.0, 551.0)]
    for x, y in clicks:
        editor.page.mouse.click(left + x, top + y)
    points = editor.points
    assert len(points) == len(clicks)
    # One scale, y turned: what is left over is how far off a click was.
    pixels = np.array(clicks)
    x, y = pixels[:, 0] - pixels[:, 0].mean(), pixels[:, 1].mean() - pixels[:, 1]
    u, v = (points - points.mean(axis=0)).T
    scale = (x @ u + y @ v) / (u @ u + v @ v)
    assert np.hypot(x - scale * u, y - scale * v).max() < 0.5
    # And the dot that is seen is where the pointer was.
    editor.page.mouse.move(left + 5, top + 700)
    editor.page.locator("[data-knob=solution] input").uncheck()
    editor.page.evaluate(
        "() => { const s = document.querySelector('.crz').editor.scene; s.layers = []; s.hover = -1; s.draw() }"
    )
    picture = shot(editor)
    for x, y in clicks:
        row, column = round(y * ratio), round(x * ratio)
        dark = 255 - picture[row - 7 : row + 8, column - 7 : column + 8]
        dark = np.where(dark > 90, dark, 0)
        rows, columns = np.mgrid[row - 7 : row + 8, column - 7 : column + 8] + 0.5
        middle = (columns * dark).sum() / dark.sum() / ratio, (rows * dark).sum() / dark.sum() / ratio
        assert np.hypot(middle[0] - x, middle[1] - y) < 0.5


def test_drag_moves_and_undo_takes_back(opened: Opener) -> None:
    editor = opened(RING)
    editor.drag((0.5, 0.55), (0.62, 0.4))
    moved = editor.points
    assert np.allclose(moved[4], (0.62, 0.4), atol=0.002)
    assert np.array_equal(moved[:4], np.array(RING)[:4])
    editor.page.keyboard.press("Control+z")
    assert np.array_equal(editor.points, RING)
    editor.do("redo")
    assert np.array_equal(editor.points, moved)
    editor.do("undo")
    assert editor.page.locator("[data-action=undo]").is_disabled()


def test_a_press_that_drags_on_is_one_step(opened: Opener) -> None:
    editor = opened(RING)
    editor.drag((0.4, 0.3), (0.45, 0.35))
    assert len(editor.points) == 6
    assert np.allclose(editor.points[5], (0.45, 0.35), atol=0.002)
    editor.page.keyboard.press("Control+z")
    assert np.array_equal(editor.points, RING)


def test_points_are_selected_moved_together_and_deleted(opened: Opener) -> None:
    editor = opened(RING)
    editor.page.locator("[data-tool=select]").click()
    editor.drag((0.15, 0.15), (0.85, 0.6))
    assert "3 selected" in editor.page.locator(".crz-many").inner_text()
    editor.drag((0.5, 0.55), (0.5, 0.65))
    assert np.allclose(editor.points - RING, [[0, 0.1], [0, 0.1], [0, 0], [0, 0], [0, 0.1]], atol=0.002)
    editor.page.keyboard.down("Shift")
    editor.click(0.8, 0.3)
    editor.page.keyboard.up("Shift")
    assert "2 selected" in editor.page.locator(".crz-many").inner_text()
    editor.page.keyboard.press("Delete")
    assert len(editor.points) == 3
    editor.page.keyboard.press("Control+a")
    editor.page.keyboard.press("Backspace")
    assert len(editor.points) == 0
    assert editor.page.locator(".crz-empty").is_visible()
    editor.page.keyboard.press("Control+z")
    editor.page.keyboard.press("Control+z")
    assert len(editor.points) == 5


def test_everything_can_be_done_with_keys(opened: Opener) -> None:
    editor = opened()
    editor.page.locator(".crz-canvas").focus()
    press = editor.page.keyboard.press
    press("g")
    press("Enter")
    press("Enter")
    for keys in (["ArrowRight"] * 2, ["ArrowUp"] * 3, ["Shift+ArrowLeft"]):
        for key in keys:
            press(key)
        press("Enter")
    points = editor.points
    step = editor.page.evaluate("() => document.querySelector('.crz').editor.view.step()")
    assert np.allclose((points - points[0]) / step, [(0, 0), (2, 0), (2, 3), (-8, 3)])
    assert "Point 4 added" in editor.page.locator(".crz [role=status].crz-hidden").inner_text()
    press("Space")
    press("ArrowDown")
    assert np.allclose(editor.points[3] - points[3], (0, -step))
    press("n")
    assert "Point 1 of 4" in editor.page.locator(".crz [role=status].crz-hidden").inner_text()
    press("Delete")
    assert np.array_equal(editor.points[:2], points[1:3])
    press("Control+z")
    press("Control+z")
    assert np.array_equal(editor.points, points)
    press("Tab")
    assert not editor.page.evaluate("() => document.activeElement.matches('.crz-canvas')")


def test_snapped_points_are_short_decimals(opened: Opener) -> None:
    editor = opened()
    editor.do("snap")
    for place in [(0.213, 0.687), (0.71, 0.304), (0.452, 0.118)]:
        editor.click(*place)
    assert all(len(repr(value)) <= 5 for value in editor.points.ravel().tolist())
    assert np.abs(editor.points - [(0.213, 0.687), (0.71, 0.304), (0.452, 0.118)]).max() <= 0.051


def test_a_freehand_curve_is_sampled_at_the_spacing(opened: Opener) -> None:
    editor = opened()
    editor.page.locator("[data-tool=curve]").click()
    editor.page.locator(".crz-options input").fill("30")
    editor.page.mouse.move(*editor.place(0.2, 0.5))
    editor.page.mouse.down()
    for x, y in [(0.5, 0.5), (0.5, 0.8), (0.9, 0.8)]:
        editor.page.mouse.move(*editor.place(x, y), steps=15)
    editor.page.mouse.up()
    points = editor.points
    scale = editor.page.evaluate("() => document.querySelector('.crz').editor.view.scale")
    steps = np.hypot(*np.diff(points, axis=0).T) * scale
    assert len(points) == int(np.hypot(0, 1) * scale / 30) + 1
    # Shorter only across the two corners.
    assert (np.abs(steps - 30) < 0.01).sum() >= len(steps) - 2
    assert steps.max() < 30.01


def test_zoom_keeps_its_place_and_pan_moves_it(opened: Opener) -> None:
    editor = opened(RING)
    # A wheel turns at whole pixels.
    at = tuple(map(round, editor.place(0.8, 0.8)))
    off = np.subtract(editor.place(0.8, 0.8), at)
    editor.page.mouse.move(*at)
    scale = editor.page.evaluate("() => document.querySelector('.crz').editor.view.scale")
    for _ in range(4):
        editor.page.mouse.wheel(0, -120)
    editor.page.wait_for_timeout(100)
    zoomed = editor.page.evaluate("() => document.querySelector('.crz').editor.view.scale") / scale
    assert zoomed > 2
    assert np.allclose(editor.place(0.8, 0.8), at + off * zoomed, atol=0.01)
    was = np.array(editor.place(0.8, 0.8))
    before = np.hypot(*np.subtract(editor.place(0.8, 0.8), editor.place(0.2, 0.8)))
    assert before > 700
    editor.page.mouse.down(button="middle")
    editor.page.mouse.move(at[0] - 50, at[1] + 20)
    editor.page.mouse.up(button="middle")
    assert np.allclose(editor.place(0.8, 0.8), was + np.array([-50, 20]), atol=0.01)
    editor.page.keyboard.press("0")
    left, _ = editor.corner
    assert left < editor.place(0.2, 0.5)[0] < editor.place(0.8, 0.5)[0] < left + 880
    assert np.array_equal(editor.points, RING)


def test_two_fingers_zoom_and_leave_no_point(opened: Opener) -> None:
    editor = opened(RING, has_touch=True)
    left, top = editor.corner
    session = editor.page.context.new_cdp_session(editor.page)

    def touch(kind: str, *places: tuple[float, float]) -> None:
        spots = [{"x": left + x, "y": top + y, "id": i} for i, (x, y) in enumerate(places)]
        session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": spots})

    scale = editor.page.evaluate("() => document.querySelector('.crz').editor.view.scale")
    touch("touchStart", (300, 300))
    touch("touchStart", (300, 300), (400, 300))
    for i in range(1, 6):
        touch("touchMove", (300 - 10 * i, 300), (400 + 10 * i, 300))
    touch("touchEnd")
    assert np.isclose(
        editor.page.evaluate("() => document.querySelector('.crz').editor.view.scale") / scale, 2, rtol=0.02
    )
    assert np.array_equal(editor.points, RING)


def test_a_reload_keeps_everything_and_the_link_works_once(opened: Opener) -> None:
    editor = opened(RING)
    editor.click(0.5, 0.3)
    editor.mode("maze")
    points = editor.points
    address = editor.server.address
    assert "token" not in editor.page.url
    editor.page.reload()
    editor.page.wait_for_selector(".crz-canvas")
    assert np.array_equal(editor.points, points)
    assert editor.page.locator("[data-mode=maze]").get_attribute("aria-selected") == "true"
    stranger = editor.page.context.browser.new_context().new_page()  # type: ignore[union-attr]
    assert stranger.goto(address).status == 403  # type: ignore[union-attr]
    assert "crazing edit" in stranger.inner_text("body")
