"""How long the editor takes to answer a moved point of 2,000: Python alone, and with --browser the whole way.

Without a browser: processor time from a message to its answer, and its ratio to the triangulation.
With one: milliseconds from the pointer's move to the frame that shows it, in Chromium at the sizes of two windows.
"""

from __future__ import annotations

import argparse
import os
import resource
import shutil
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np

import crazing as cz
from crazing.edit import knobs
from crazing.edit.samples import points_of
from crazing.edit.session import Message, Session
from crazing.edit.wire import packed, unpacked

#: Every layer of a skeleton that is live at any size.
LAYERS = ("delaunay", "voronoi", "crust", "axis", "poles")

#: Pixels of the windows: a laptop's, and a large one.
WINDOWS = {"laptop": (1280, 720), "large": (1920, 1080)}

#: A preview of a crack, some 300 pixels across.
PREVIEW = {"scale": 1e3, "view": [-9, -9, 9, 9], "pixels": 90_000}

#: What a moved point should be drawn within.
LIMIT = 100

#: Notes when a move arrives, is asked, answered, ready and on the screen; all of the last answer.
WATCH = """() => {
    const e = document.querySelector(".crz").editor;
    const marks = (window.marks = {});
    e.canvas.addEventListener("pointermove", () => { marks.moved = performance.now(); }, true);
    const [ask, show, draw] = [e.wire.ask.bind(e.wire), e.layers.show, e.scene.draw.bind(e.scene)];
    e.wire.ask = async (content, buffers) => {
        if (content.kind !== "layers") return ask(content, buffers);
        marks.asked = performance.now();
        const answer = await ask(content, buffers);
        return Object.assign(marks, { answered: performance.now(), python: answer.milliseconds }) && answer;
    };
    e.layers.show = async (answer) => {
        await show(answer);
        Object.assign(marks, { ready: performance.now(), shown: 0, side: answer.preview ? answer.preview.width : 0 });
    };
    e.scene.draw = () => {
        draw();
        // The frame after the next begins when this one has been painted.
        if (!marks.shown) requestAnimationFrame(() => { marks.shown = performance.now(); });
    };
}"""

#: Whether the last move is on the screen.
SHOWN = """() => {
    const e = document.querySelector(".crz").editor;
    return !e.layers.busy && !e.preview.task && !e.scene.frame && window.marks.shown > window.marks.moved;
}"""


def processor() -> float:
    """Milliseconds of processor time so far, of all threads."""
    usage = resource.getrusage(resource.RUSAGE_SELF)
    return 1e3 * (usage.ru_utime + usage.ru_stime)


def values_with(layers: tuple[str, ...]) -> knobs.Values:
    """The knobs as nobody has turned them, but with these layers of a skeleton."""
    values = knobs.defaults()
    values["skeleton"].update(dict.fromkeys(layers, True))
    return values


def answer_time(session: Session, frame: bytes, rounds: int) -> float:
    """Median of the time from a frame to its reply's frame."""
    times = []
    for _ in range(rounds + 1):
        start = processor()
        message = unpacked(frame)
        packed(session.answer(message.content, message.buffers))
        times.append(processor() - start)
    return median(times[1:])


def answers(count: int, rounds: int) -> list[str]:
    """A row a point set and mode: milliseconds of Python's answers, as ratios to the triangulation too."""
    inputs = {"uniform": cz.sample.uniform(count, rng=5), "curve": points_of("flower", count, 0)}
    lines = [f"{count} points: milliseconds of processor time, and ratio to the triangulation alone"]
    for name, points in inputs.items():
        start = processor()
        for _ in range(rounds):
            cz.diagram(points)
        alone = (processor() - start) / rounds
        for mode in knobs.PANELS:
            content = {"kind": "layers", "serial": 1, "mode": mode, "values": values_with(LAYERS), "moving": True}
            frame = packed(Message({**content, "preview": PREVIEW}, [points.tobytes()]))
            took = answer_time(Session(), frame, rounds)
            lines.append(f"{name:8} {mode:9} {took:7.1f} ms {took / alone:6.1f} x")
    return lines


@contextmanager
def opened(browser: Any, session: Session, window: tuple[int, int]) -> Iterator[Any]:
    """A page with the editor, on a server of its own."""
    from crazing.edit.server import Server

    server = Server(session)
    thread = threading.Thread(target=server.run)
    thread.start()
    page = browser.new_page(viewport={"width": window[0], "height": window[1]})
    try:
        page.goto(server.address)
        page.wait_for_selector(".crz-canvas")
        page.wait_for_timeout(500)
        page.evaluate(WATCH)
        yield page
    finally:
        page.close()
        server.stop()
        thread.join()


def drag(page: Any, point: np.ndarray, moves: int) -> list[dict[str, float]]:
    """What was noted of every move of a point that is dragged."""
    box = page.locator(".crz-canvas").bounding_box()
    x, y = page.evaluate("([x, y]) => document.querySelector('.crz').editor.view.toScreen(x, y)", point.tolist())
    page.mouse.move(box["x"] + x, box["y"] + y)
    page.mouse.down()
    noted = []
    for i in range(moves):
        page.mouse.move(box["x"] + x + 5 + 2 * i, box["y"] + y + i)
        page.wait_for_function(SHOWN)
        noted.append(page.evaluate("() => ({ ...window.marks })"))
    page.mouse.up()
    return noted


def row(noted: list[dict[str, float]]) -> str:
    """First, median and slowest of the moves in milliseconds, and the parts of the median."""
    whole = [marks["shown"] - marks["moved"] for marks in noted]
    part = {
        "python": [marks["python"] for marks in noted],
        "wire": [marks["answered"] - marks["asked"] - marks["python"] for marks in noted],
        "page": [marks["ready"] - marks["answered"] for marks in noted],
        "drawing": [marks["shown"] - marks["ready"] for marks in noted],
    }
    parts = "".join(f"{median(times):9.0f}" for times in part.values())
    size = f"{noted[-1]['side']:8.0f} px" if noted[-1]["side"] else ""
    late = " *" if median(whole) > LIMIT else ""
    return f"{whole[0]:6.0f} {median(whole):7.0f} {max(whole):8.0f} {parts}{size}{late}"


def drawings(count: int, moves: int) -> list[str]:
    """A row a window and mode: milliseconds from a move to its frame."""
    from playwright.sync_api import sync_playwright

    names = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    path = os.environ.get("CRAZING_CHROMIUM") or next(filter(None, map(shutil.which, names)), None)
    points = cz.sample.uniform(count, rng=5)
    lines = [
        f"{count} points: milliseconds from a move to its frame, * where the median is above {LIMIT}",
        f"{'':17} first  median  slowest    python     wire     page  drawing   preview",
    ]
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=path)
        for window, size in WINDOWS.items():
            for mode in knobs.PANELS:
                session = Session(points)
                session.mode, session.values = mode, values_with(LAYERS)
                with opened(browser, session, size) as page:
                    lines.append(f"{window:7} {mode:9} {row(drag(page, points[count // 2], moves))}")
        browser.close()
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few points, few rounds")
    parser.add_argument("--browser", action="store_true", help="in Chromium too; needs the extra browser")
    parser.add_argument("-o", "--output", type=Path, help="also write the table to a file in this folder")
    options = parser.parse_args()
    count, rounds = (200, 3) if options.small else (2000, 30)
    lines = answers(count, rounds)
    if options.browser:
        lines += ["", *drawings(count, rounds)]
    print("\n".join(lines))
    if options.output:
        options.output.mkdir(parents=True, exist_ok=True)
        (options.output / "editor.txt").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
