"""Long calls stop at Ctrl-C, leave a living process, and let other threads run."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import crazing as cz
from crazing.export import geojson

# Each takes many seconds when nobody stops it.
LONG_CALLS = {
    "diagram": "cz.diagram(points)",
    "crust": "cz.crust(points)",
    "medial_axis": "cz.medial_axis(points)",
    "curve": "cz.curve(points[:200_000])",
    "maze": "cz.maze(points, rng=1)",
    "crack": "cz.crack(points, rng=1)",
    "render": "while True: cz.render(crack, 16384)",
}
PROGRAM = """
    import time
    import numpy as np
    import crazing as cz
    points = np.random.default_rng(1).random((6_000_000, 2))
    crack = cz.crack(cz.sample.uniform(1000, rng=1), rng=1)
    print("ready", flush=True)
    try:
        {call}
    except KeyboardInterrupt:
        stopped = time.monotonic()
        assert len(cz.diagram([[0, 0], [1, 0], [0, 1]]).triangles) == 1
        print("stopped", stopped, flush=True)
"""


@pytest.mark.skipif(os.name == "nt", reason="SIGINT cannot be sent to one process on Windows")
@pytest.mark.parametrize("name", LONG_CALLS)
def test_ctrl_c_stops_the_call_and_spares_the_process(name: str) -> None:
    program = textwrap.dedent(PROGRAM).format(call=LONG_CALLS[name])
    with subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True) as child:
        assert child.stdout is not None
        assert child.stdout.readline() == "ready\n"
        time.sleep(0.3)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        try:
            answer, _ = child.communicate(timeout=60)
        finally:
            child.kill()
    assert child.returncode == 0
    word, stopped = answer.split()
    assert word == "stopped"
    # The promise is a second; a loaded machine is given five.
    assert float(stopped) - sent < 5


@pytest.mark.skipif(os.name == "nt", reason="SIGINT cannot be sent to one process on Windows")
def test_ctrl_c_stops_threads_that_make_pictures(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "crazing", "dataset", "-n", "4", "--size", "5000", "--preset", "glaze"]
    with subprocess.Popen([*command, "--threads", "2", "--seed", "1", "-o", tmp_path / "a"]) as child:
        while not (tmp_path / "a" / "dataset.json").exists():
            time.sleep(0.05)
        time.sleep(1.0)
        sent = time.monotonic()
        child.send_signal(signal.SIGINT)
        try:
            # Making the two that are under way takes many times that.
            assert child.wait(timeout=60) == 130
        finally:
            child.kill()
    assert time.monotonic() - sent < 5
    assert not list((tmp_path / "a").rglob("*.png")) and not list((tmp_path / "a").rglob(".tmp-*"))


def test_other_threads_run_while_rust_works(rng: np.random.Generator) -> None:
    points = rng.random((300_000, 2))
    began = threading.Event()
    turns: list[float] = []
    done = threading.Event()

    def spin() -> None:
        began.set()
        while not done.is_set():
            turns.append(time.monotonic())
            time.sleep(0.001)

    spinner = threading.Thread(target=spin)
    spinner.start()
    began.wait()
    start = time.monotonic()
    cz.diagram(points)
    end = time.monotonic()
    done.set()
    spinner.join()
    inside = [start, *(turn for turn in turns if start < turn < end), end]
    longest = max(np.diff(inside))
    # A held interpreter would give one gap as long as the whole call.
    assert longest < 0.5 * (end - start), f"no other thread ran for {longest:.3f} s of {end - start:.3f} s"


# Of each most was once a single step of NumPy, of the encoder of JSON, or of Rust: how many points, and the call.
STEADY: dict[str, tuple[int, Callable[[cz.Diagram], object]]] = {
    "poles": (600_000, cz.poles),
    "nearest neighbours": (600_000, lambda d: cz.crust(d, method="nn")),
    "distances": (400_000, lambda d: d.delaunay.distances(d.sites)),
    "svg": (100_000, lambda d: d.delaunay.to_svg()),
    "geojson": (100_000, lambda d: geojson(d.delaunay)),
    "mapping": (100_000, lambda d: d.delaunay.__geo_interface__),
}


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="needs a timer that sends signals")
@pytest.mark.parametrize("name", STEADY)
def test_a_signal_is_looked_for_all_along(name: str, rng: np.random.Generator) -> None:
    count, call = STEADY[name]
    diagram = cz.diagram(rng.random((count, 2)))
    # In processor time, which waiting for others on the machine is not.
    looks: list[float] = []
    before = signal.signal(signal.SIGPROF, lambda *_: looks.append(time.process_time()))
    start = time.process_time()
    signal.setitimer(signal.ITIMER_PROF, 0.001, 0.001)
    try:
        call(diagram)
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)
        signal.signal(signal.SIGPROF, before)
    end = time.process_time()
    longest = max(np.diff([start, *looks, end]))
    assert longest < 0.45 * (end - start), f"no look for {longest:.3f} s of {end - start:.3f} s"
