"""How the page looks: both themes, wide and narrow, and to those who do not see it."""

from __future__ import annotations

import io

import numpy as np
import pytest
from axe_playwright_python.sync_playwright import Axe
from PIL import Image

from conftest import Editor, Opener
from crazing.edit import samples

FLOWER = samples.points_of("flower", 120, 0)
SIZES = {"laptop": (1280, 760), "phone": (390, 844)}


def faults(editor: Editor) -> list[str]:
    """What axe-core finds, every rule it has, with the elements."""
    found = Axe().run(editor.page).response["violations"]
    return [f"{rule['id']}: {[node['html'][:120] for node in rule['nodes']]}" for rule in found]


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_nothing_is_inaccessible(opened: Opener, size: str, scheme: str) -> None:
    width, height = SIZES[size]
    editor = opened(width=width, height=height, color_scheme=scheme)
    assert faults(editor) == []
    editor.page.locator("[data-start=star]").click()
    editor.rest()
    for mode in ("skeleton", "compare", "maze", "crack"):
        editor.mode(mode)
        if mode == "compare":
            editor.page.get_by_label("Split", exact=True).check()
        editor.page.evaluate("() => document.querySelectorAll('.crz-fold').forEach((fold) => { fold.open = true })")
        editor.settle()
        assert faults(editor) == [], mode
    editor.do("help")
    assert faults(editor) == []
    editor.page.keyboard.press("Escape")


@pytest.mark.parametrize("width", [320, 390, 600, 900, 1280])
def test_nothing_runs_out_of_the_side(opened: Opener, width: int) -> None:
    editor = opened(FLOWER, width=width, height=700)
    for mode in ("skeleton", "compare", "maze", "crack"):
        editor.mode(mode)
        wide = editor.page.evaluate(
            """() => [...document.querySelectorAll(".crz *")].filter((e) => {
                const box = e.getBoundingClientRect();
                return box.width && e.checkVisibility() && !e.closest(".crz-hidden") && box.right > innerWidth + 0.5;
            }).map((e) => e.outerHTML.slice(0, 90))"""
        )
        assert wide == [], mode
        panel = editor.page.evaluate(
            "() => { const p = document.querySelector('.crz-panel'); return p.scrollWidth - p.clientWidth }"
        )
        assert panel <= 0, mode
    assert editor.page.evaluate("() => document.documentElement.scrollWidth") <= width


def test_the_canvas_stays_where_it_is(opened: Opener) -> None:
    editor = opened()
    before = editor.page.locator(".crz-canvas").bounding_box()
    editor.page.locator("[data-start=flower]").click()
    editor.rest()
    for mode in ("maze", "compare", "crack", "skeleton"):
        editor.mode(mode)
        assert editor.page.locator(".crz-canvas").bounding_box() == before
    editor.drop("bad.csv", b"1,2\nx\n")
    editor.page.locator("[data-tool=curve]").click()
    assert editor.page.locator(".crz-canvas").bounding_box() == before


def brightness(editor: Editor) -> float:
    return float(np.asarray(Image.open(io.BytesIO(editor.page.screenshot())).convert("L")).mean())


def test_the_theme_follows_the_system_and_the_switch(opened: Opener) -> None:
    editor = opened(FLOWER, color_scheme="dark")
    assert brightness(editor) < 70
    editor.page.emulate_media(color_scheme="light")
    editor.rest()
    assert brightness(editor) > 200
    editor.do("theme")
    editor.rest()
    assert brightness(editor) < 70
    editor.page.reload()
    editor.page.wait_for_selector(".crz-canvas")
    editor.rest()
    assert brightness(editor) < 70


def test_the_focus_is_seen_and_goes_everywhere(opened: Opener) -> None:
    editor = opened(FLOWER)
    seen = set()
    for _ in range(60):
        editor.page.keyboard.press("Tab")
        name, outline = editor.page.evaluate(
            """() => {
                const e = document.activeElement;
                const s = getComputedStyle(e);
                const name = e.dataset.action ?? e.dataset.mode ?? (e.matches("canvas") ? "canvas" : e.dataset.tool);
                return [name ?? e.className, s.outlineStyle !== "none" && parseFloat(s.outlineWidth) >= 2];
            }"""
        )
        if name:
            assert outline, name
            seen.add(name)
    assert {"draw", "theme", "canvas", "skeleton", "generate", "open", "save", "script"} <= seen
