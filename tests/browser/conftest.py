"""A real browser on a real server. Not part of `python -m pytest`: run `python -m pytest tests/browser`.

Needs the extra `browser` and Chromium, of the system or named by CRAZING_CHROMIUM; without one these tests fail.
"""

from __future__ import annotations

import base64
import os
import shutil
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from crazing.edit.server import Server
from crazing.edit.session import Session

# A browser looks around for updates and the like; in a closed network each look is a complaint.
QUIET = ["background-networking", "component-update", "sync", "quic", "gpu"]


@pytest.fixture(scope="session")
def browser() -> Iterator[Browser]:
    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    path = os.environ.get("CRAZING_CHROMIUM") or next(filter(None, map(shutil.which, names)), None)
    assert path, "no Chromium: apt-get install chromium, or set CRAZING_CHROMIUM to a browser's path"
    with sync_playwright() as play:
        found = play.chromium.launch(
            executable_path=path, args=["--no-first-run", *(f"--disable-{word}" for word in QUIET)]
        )
        yield found
        found.close()


@dataclass
class Editor:
    """An open page, the session behind it, and what went wrong on it."""

    page: Page
    session: Session
    server: Server
    complaints: list[str] = field(default_factory=list)

    @property
    def points(self) -> NDArray[np.float64]:
        """What Python has, once it has all."""
        self.rest()
        return self.session.points

    def rest(self) -> None:
        """Waits until nothing is asked, answered or drawn any more."""
        idle = """() => {
            const e = document.querySelector(".crz").editor;
            return !e.layers.busy && !e.contour.busy && !e.preview.task && !e.scene.frame;
        }"""
        self.page.wait_for_timeout(30)
        self.page.wait_for_function(idle)

    def settle(self) -> None:
        """Waits for the large preview too."""
        self.page.wait_for_timeout(300)
        self.rest()

    @property
    def corner(self) -> tuple[float, float]:
        """Of the canvas, in the window."""
        box = self.page.locator(".crz-canvas").bounding_box()
        assert box
        return box["x"], box["y"]

    def place(self, x: float, y: float) -> tuple[float, float]:
        """Where a data point is, in the window."""
        left, top = self.page.evaluate("([x, y]) => document.querySelector('.crz').editor.view.toScreen(x, y)", [x, y])
        return left + self.corner[0], top + self.corner[1]

    def click(self, x: float, y: float, **more: Any) -> None:
        """Clicks at a data point."""
        self.page.mouse.click(*self.place(x, y), **more)

    def drag(self, start: tuple[float, float], end: tuple[float, float], steps: int = 6) -> None:
        """Drags from one data point to another."""
        self.page.mouse.move(*self.place(*start))
        self.page.mouse.down()
        self.page.mouse.move(*self.place(*end), steps=steps)
        self.page.mouse.up()

    def drop(self, name: str, content: bytes, kind: str = "") -> None:
        """Drops a file on the page."""
        encoded = base64.b64encode(content).decode()
        self.page.evaluate(
            """([name, kind, encoded]) => {
                const bytes = Uint8Array.from(atob(encoded), (letter) => letter.charCodeAt(0));
                const dataTransfer = new DataTransfer();
                dataTransfer.items.add(new File([bytes], name, { type: kind }));
                const how = { dataTransfer, bubbles: true, cancelable: true };
                for (const type of ["dragenter", "dragover", "drop"]) {
                    document.querySelector(".crz").dispatchEvent(new DragEvent(type, how));
                }
            }""",
            [name, kind, encoded],
        )
        self.page.wait_for_timeout(150)
        self.rest()

    def do(self, action: str) -> None:
        """Presses a button by its word."""
        self.page.locator(f"[data-action={action}]").click()

    def turn(self, knob: str, value: Any) -> None:
        """Turns a visible knob."""
        row = self.page.locator(f"[data-knob={knob}]:visible")
        if isinstance(value, bool):
            row.locator("input").set_checked(value)
        elif isinstance(value, str):
            row.locator("select").select_option(value)
        else:
            row.locator("input").fill(str(value))
        self.rest()

    def mode(self, name: str) -> None:
        """Switches to a mode."""
        self.page.locator(f"[data-mode={name}]").click()
        self.rest()

    def keep(self, action: str) -> tuple[str, bytes]:
        """Name and content of what a button downloads."""
        with self.page.expect_download() as waiting:
            self.do(action)
        path = waiting.value.path()
        return waiting.value.suggested_filename, path.read_bytes()


Opener = Callable[..., Editor]


@pytest.fixture
def opened(browser: Browser) -> Iterator[Opener]:
    """Opens editors; at the end none may have complained, nor asked anybody but its own server."""
    made: list[tuple[Editor, BrowserContext, threading.Thread]] = []

    def opener(points: Any = None, *, width: int = 1200, height: int = 760, **context: Any) -> Editor:
        session = Session(points)
        server = Server(session)
        thread = threading.Thread(target=server.run)
        thread.start()
        tab = browser.new_context(viewport={"width": width, "height": height}, accept_downloads=True, **context)
        editor = Editor(tab.new_page(), session, server)
        made.append((editor, tab, thread))
        watch(editor)
        editor.page.goto(server.address)
        editor.page.wait_for_selector(".crz-canvas")
        editor.rest()
        return editor

    yield opener
    for editor, tab, thread in made:
        tab.close()
        editor.server.stop()
        thread.join(20)
        assert not thread.is_alive()
    assert [words for editor, _, _ in made for words in editor.complaints] == []


def watch(editor: Editor) -> None:
    """Notes every error of the page, and every request to others."""
    own = f"127.0.0.1:{editor.server.port}/"
    page = editor.page

    def asked(request: Any) -> None:
        if not request.url.startswith((f"http://{own}", f"blob:http://{own}")):
            editor.complaints.append(f"asked for {request.url}")

    page.on("request", asked)
    page.on("pageerror", lambda error: editor.complaints.append(str(error)))
    page.on(
        "console", lambda words: editor.complaints.append(words.text) if words.type in ("error", "warning") else None
    )
