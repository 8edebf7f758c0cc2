"""How long a height map takes from the pattern to the disk, as ratios to writing the same bytes uncompressed.

``python python/benchmarks/streaming.py`` prints a table. Baseline and run alternate; both flush to the disk. A ratio
of at most 3 is wanted at 16384 x 16384, with less than 1 GB at the peak. "drawing" is the time of the maps alone,
"writing" that of the files alone, from maps that are there: the two overlap in a run. With ``--profile`` the slowest
functions of one run are printed. ``--encoders`` compares settings of PNG and TIFF on the same picture.
"""

from __future__ import annotations

import argparse
import cProfile
import importlib
import io
import os
import pstats
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Callable
from pathlib import Path

import numpy as np

import crazing as cz

FORMATS = {"png16": ".png", "tiff16": ".tif", "tiff32": ".tif", "zarr": ".zarr"}
BYTES = {"png16": 2, "tiff16": 2, "tiff32": 4, "zarr": 4}
BAND = 256


def seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def plain(path: Path, side: int, itemsize: int) -> None:
    """The bytes of the map, uncompressed, flushed to the disk."""
    rows = np.full((BAND, side), 7, dtype=f"u{itemsize}")
    with path.open("wb") as file:
        for top in range(0, side, BAND):
            file.write(rows[: side - top].data)
        file.flush()
        os.fsync(file.fileno())
    path.unlink()


def drawing(crack: cz.Crack, side: int) -> None:
    """All bands, thrown away."""
    plan = cz.texture_plan(crack, side, maps="height")
    for top in range(0, side, BAND):
        plan.window(top, 0, min(BAND, side - top), side)


def peak(side: int, form: str, sites: int, folder: Path) -> float:
    """MiB of a process that does nothing else."""
    command = [sys.executable, __file__, "--alone", form, "--side", str(side), "--sites", str(sites), "-o", str(folder)]
    if sys.platform != "linux":
        return float("nan")
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def alone(side: int, form: str, sites: int, folder: Path) -> None:
    """One run, and what it took at most."""
    crack = cz.crack(n=sites, rng=1)
    cz.write_texture(crack, folder / f"alone{FORMATS[form]}", side, maps="height", format=form)
    # Of this program alone: what getrusage has begins with the peak of the process that started it.
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    print(int(next(line for line in lines if line.startswith("VmHWM")).split()[1]) / 1024)


def stored(path: Path) -> int:
    """Bytes of a file, or of all files of a store."""
    return sum(entry.stat().st_size for entry in ([path] if path.is_file() else path.rglob("*")) if entry.is_file())


def row(crack: cz.Crack, side: int, form: str, repeats: int, sites: int, folder: Path) -> str:
    """One line of the table."""
    path = folder / f"height{FORMATS[form]}"
    raw, runs, draws = [], [], []
    for _ in range(repeats):
        raw.append(seconds(lambda: plain(folder / "plain", side, BYTES[form])))
        runs.append(seconds(lambda: cz.write_texture(crack, path, side, maps="height", format=form)))
        draws.append(seconds(lambda: drawing(crack, side)))
    texture = cz.texture(crack, side, maps="height") if side**2 <= 1 << 28 else None
    written = seconds(lambda: texture.save(path, format=form)) if texture is not None else float("nan")
    size = stored(path) / (side * side * BYTES[form])
    base = min(raw)
    cells = f"{min(runs) / base:8.2f}{min(draws) / base:10.2f}{written / base:10.2f}{size:8.2f}"
    return f"{form:8}{side:7d}{base:10.3f}{cells}{peak(side, form, sites, folder):10.0f}"


def encoders(crack: cz.Crack, side: int) -> list[str]:
    """Seconds of processor time and size of the encoders at hand, on one height map of 16 bits."""
    height = np.round(cz.texture(crack, side, maps="height", material=cz.Material(grain=0.02))["height"] * 65535)
    image = height.astype(np.uint16)
    flat = np.diff(image.astype(">u2").view(np.uint8).reshape(side, -1), axis=0, prepend=np.uint8(0)).tobytes()
    works: dict[str, Callable[[], bytes]] = {
        "own PNG": lambda: own_png(image),
        **{f"zlib level {level}": lambda level=level: zlib.compress(flat, level) for level in (1, 3, 6)},  # type: ignore[misc]
    }
    try:
        codecs = importlib.import_module("imagecodecs")
        for level in (0, 1):
            works[f"libpng level {level}"] = lambda level=level: codecs.png_encode(image, level=level)  # type: ignore[misc]
    except ImportError:
        pass
    lines = [f"{'encoder':16}{'MB/s':>10}{'size':>8}   of processor time, {side} x {side}, 16 bits, with grain"]
    for name, work in works.items():
        before = time.process_time()
        size = len(work())
        spent = max(time.process_time() - before, 1e-9)
        lines.append(f"{name:16}{image.nbytes / spent / 1e6:10.0f}{size / image.nbytes:8.2f}")
    return lines


def own_png(image: np.ndarray) -> bytes:
    """By our encoder."""
    file = io.BytesIO()
    cz.save_png(file, image, srgb=False)
    return file.getvalue()


def profile(crack: cz.Crack, side: int, form: str, folder: Path) -> str:
    """Where the time goes: drawing and writing one after the other, by our own functions."""
    texture = cz.texture(crack, side, maps="height")
    profiler = cProfile.Profile()
    profiler.enable(builtins=True)
    drawing(crack, side)
    profiler.disable()
    job = importlib.import_module("crazing.pictures.job")
    original = job.Job._write

    def measured(self: object, *given: object) -> None:
        profiler.enable(builtins=True)
        try:
            original(self, *given)
        finally:
            profiler.disable()

    job.Job._write = measured
    texture.save(folder / f"profile{FORMATS[form]}", format=form)
    job.Job._write = original
    out = io.StringIO()
    pstats.Stats(profiler, stream=out).sort_stats("tottime").print_stats(8)
    return "\n".join(line for line in out.getvalue().splitlines() if line.strip() and "/" not in line.split()[0])


def main() -> None:
    parser = argparse.ArgumentParser(description="Time height maps streamed to disk against bare writes.")
    parser.add_argument("--side", type=int, default=16384)
    parser.add_argument("--sites", type=int, default=3000)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--small", action="store_true", help="a small picture, once")
    parser.add_argument("--encoders", action="store_true", help="compare encoders, too")
    parser.add_argument("--profile", action="store_true", help="print the slowest functions, too")
    parser.add_argument("--alone", help=argparse.SUPPRESS)
    parser.add_argument("-o", dest="folder", type=Path, help="where to write the files and the table")
    given = parser.parse_args()
    if given.small:
        given.side, given.sites, given.repeats = 1024, 200, 1
    with tempfile.TemporaryDirectory() as scratch:
        folder = given.folder or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        if given.alone:
            alone(given.side, given.alone, given.sites, folder)
            return
        crack = cz.crack(n=given.sites, rng=1)
        heads = f"{'run':>8}{'drawing':>10}{'writing':>10}{'size':>8}{'peak MiB':>10}"
        table = [f"{'format':8}{'side':>7}{'plain s':>10}{heads}   ratios to the plain write"]
        print(table[0])
        for form in FORMATS:
            table.append(row(crack, given.side, form, given.repeats, given.sites, folder))
            print(table[-1], flush=True)
        if given.encoders or given.small:
            table += encoders(crack, min(given.side, 4096))
        if given.profile:
            table.append(profile(crack, min(given.side, 8192), "png16", folder))
        print("\n".join(table[1 + len(FORMATS) :]))
        for path in folder.glob("*.png"):
            path.unlink()
        (folder / "streaming.txt").write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
