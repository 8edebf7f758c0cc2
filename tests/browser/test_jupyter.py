"""The same editor as a widget in JupyterLab."""

from __future__ import annotations

import contextlib
import json
import secrets
import socket
import subprocess
import sys
import time
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Browser, Page, TimeoutError

CELL = "import crazing as cz\neditor = cz.edit([(0.2, 0.2), (0.8, 0.2), (0.5, 0.8)])\neditor"
REPORT = "import json; print('points', json.dumps(editor.points.tolist()), editor.settings['mode'])"


@pytest.fixture
def lab(tmp_path: Path) -> Iterator[str]:
    """The address of a notebook in a JupyterLab of its own."""
    cells = [
        {"cell_type": "code", "id": f"c{i}", "metadata": {}, "outputs": [], "execution_count": None, "source": text}
        for i, text in enumerate([CELL, REPORT, "editor.points = editor.points[:2]"])
    ]
    kernel = {"name": "python3", "display_name": "Python 3", "language": "python"}
    notebook = {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}
    (tmp_path / "editor.ipynb").write_text(json.dumps(notebook))
    with socket.create_server(("127.0.0.1", 0)) as probe:
        port = probe.getsockname()[1]
    token = secrets.token_hex(8)
    options = ["--no-browser", "--allow-root", f"--ServerApp.port={port}", f"--IdentityProvider.token={token}"]
    options += [f"--ServerApp.root_dir={tmp_path}", "--LabApp.news_url=None"]
    command = [sys.executable, "-m", "jupyter", "lab", *options]
    with (tmp_path / "log").open("w") as log, subprocess.Popen(command, stdout=log, stderr=log) as program:
        address = f"http://127.0.0.1:{port}"
        for _ in range(240):
            try:
                urllib.request.urlopen(f"{address}/api?token={token}", timeout=5)
                break
            except OSError:
                time.sleep(0.25)
        else:
            pytest.fail((tmp_path / "log").read_text())
        yield f"{address}/lab/tree/editor.ipynb?token={token}"
        program.terminate()


def run(page: Page, cell: int) -> None:
    page.locator(".jp-Notebook .jp-CodeCell .cm-content").nth(cell).click()
    page.keyboard.press("Control+Enter")


def test_clicks_reach_python_and_python_reaches_the_page(browser: Browser, lab: str) -> None:
    page = browser.new_page(viewport={"width": 1400, "height": 1300})
    page.goto(lab)
    page.wait_for_selector(".jp-Notebook .jp-CodeCell .cm-content", timeout=60_000)
    page.get_by_text("| Idle").wait_for(timeout=60_000)
    # A cell that is run while the kernel is still being connected is forgotten.
    for _ in range(6):
        run(page, 0)
        with contextlib.suppress(TimeoutError):
            page.wait_for_selector(".crz-canvas", timeout=10_000)
            break
    page.locator(".crz-canvas").scroll_into_view_if_needed()
    page.wait_for_function("() => { const e = document.querySelector('.crz').editor; return !e.layers.busy }")
    box = page.locator(".crz-canvas").bounding_box()
    assert box
    places = [(200.0, 150.0), (412.0, 333.0), (305.0, 260.0)]
    for x, y in places:
        page.mouse.click(box["x"] + x, box["y"] + y)
    view = page.evaluate("() => { const v = document.querySelector('.crz').editor.view; return [v.scale, v.x, v.y] }")
    scale, middle = view[0], np.array(view[1:])
    page.locator("[data-mode=maze]").click()
    page.wait_for_timeout(500)
    run(page, 1)
    output = page.locator(".jp-OutputArea-output pre", has_text="points")
    output.wait_for(timeout=30_000)
    _, rest = output.inner_text().split(" ", 1)
    text, mode = rest.strip().rsplit(" ", 1)
    points = np.array(json.loads(text))
    assert mode == "maze"
    assert points[:3].tolist() == [[0.2, 0.2], [0.8, 0.2], [0.5, 0.8]]
    half = np.array([box["width"], box["height"]]) / 2
    wanted = middle + (np.array(places) - half) * (1, -1) / scale
    assert np.abs(points[3:] - wanted).max() * scale < 0.5
    run(page, 2)
    page.get_by_text("2 points", exact=True).wait_for(timeout=30_000)
    page.locator(".crz-canvas").focus()
    page.keyboard.press("Control+z")
    page.get_by_text("6 points", exact=True).wait_for(timeout=30_000)
    page.close()
