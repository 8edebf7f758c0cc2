"""How fast pictures are drawn and saved, as ratios to Pillow and to a bare memory write in the same run.

``python python/benchmarks/render.py`` prints a table; a ratio below 1 means faster than Pillow. Pillow's lines are
one pixel wide or a whole number of pixels and not anti-aliased, so it does less.
"""

from __future__ import annotations

import argparse
import io
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw

import crazing as cz


@dataclass(frozen=True)
class Segments:
    """A graph of separate segments."""

    vertices: NDArray[np.float64]
    edges: NDArray[np.int32]


@dataclass(frozen=True)
class Cracks:
    """The segments with a width at both ends."""

    graph: Segments
    width: NDArray[np.float64]
    bounds: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)


def cracks(count: int, width: float) -> Cracks:
    """`count` segments as long as the edges of a net of as many cells, up to `width` wide."""
    rng = np.random.default_rng(1)
    start = rng.random((count, 2))
    end = start + rng.normal(size=(count, 2)) * 0.5 / np.sqrt(count)
    rows = np.arange(count, dtype=np.int32)
    graph = Segments(np.concatenate([start, end]), np.stack([rows, rows + count], axis=1))
    return Cracks(graph, rng.random((count, 2)) * width)


def seconds(work: Callable[[], object], repeats: int) -> float:
    """The least wall time of some runs, in seconds."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def draw_with_pillow(net: Cracks, side: int, width: int) -> Image.Image:
    """The same segments by Pillow."""
    image = Image.new("RGBA", (side, side), (255, 255, 255, 255))
    draw = ImageDraw.Draw(image)
    for segment in (net.graph.vertices[net.graph.edges] * side).reshape(-1, 4).tolist():
        draw.line(segment, fill=(0, 0, 0, 255), width=width)
    return image


def row(side: int, count: int, repeats: int) -> str:
    """One line of the table."""
    width = max(1, side // 2048)
    net = cracks(count, 2 * width / side)
    ours = seconds(lambda: cz.render(net, side), repeats)
    alone = seconds(lambda: cz.render(net, side, threads=1), repeats)
    pillow = seconds(lambda: draw_with_pillow(net, side, width), repeats)
    memory = seconds(lambda: np.full((side, side, 4), 7, dtype=np.uint8), repeats)
    picture = cz.render(net, side)
    image = Image.fromarray(picture)
    save = seconds(lambda: cz.save_png(io.BytesIO(), picture), repeats)
    save_pillow = seconds(lambda: image.save(io.BytesIO(), format="PNG", compress_level=1), repeats)
    ratios = ours / pillow, alone / pillow, ours / memory, save / save_pillow
    cells = "".join(f"{ratio:12.2f}" for ratio in ratios)
    return f"{side:6d}{count:9d}{cells}{1000 * ours:12.0f}{1000 * save:12.0f}"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Time drawing and saving against Pillow.")
    parser.add_argument("--sides", type=int, nargs="+", default=[2048, 4096, 8192])
    parser.add_argument("--counts", type=int, nargs="+", default=[10_000, 100_000])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--small", action="store_true", help="one small picture, once")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the table to a file in this folder")
    given = parser.parse_args()
    if given.small:
        given.sides, given.counts, given.repeats = [256], [1000], 1
    heads = "to Pillow", "1 thread", "to memory", "save", "draw ms", "save ms"
    table = [f"{'side':>6}{'edges':>9}" + "".join(f"{head:>12}" for head in heads)]
    print(table[0])
    for side in given.sides:
        for count in given.counts:
            table.append(row(side, count, given.repeats))
            print(table[-1], flush=True)
    if given.folder:
        given.folder.mkdir(parents=True, exist_ok=True)
        (given.folder / "render.txt").write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
