"""How fast textures are drawn, as ratios to drawing libraries in the same run.

``python python/benchmarks/texture.py`` prints, for every size and number of tapered edges, the time of the coverage
mask and of six maps together (mask, height, normal, distance, cell, strand; also into arrays that have been used
before) on one and on two threads, each over the time of every peer that is installed: tapered polygons, and plain
lines of one width, anti-aliased, in one 8-bit channel where the library has one. Below 1 means that the texture is
faster. Beside these: how much two threads gain, and how much where as many bytes are only written; how the six maps
compare with writing as many bytes, what a picture without cracks takes over that, and the time a pixel at many sizes.
What each of the six maps costs alone, over all six together, is printed for the first number of edges from 100k on. A
library that is not installed is named as such.
"""

from __future__ import annotations

import argparse
import importlib
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from types import ModuleType

import numpy as np
from numpy.typing import NDArray

import crazing as cz

SIX = ("mask", "height", "normal", "distance", "cell", "strand")


class Drawing:
    """One pattern as every library wants it, in pixels."""

    def __init__(self, crack: cz.Crack, side: int, thickness: int) -> None:
        self.crack, self.side, self.thickness = crack, side, thickness
        ends = crack.graph.segments * [1, -1] * side + [0, side]
        step = ends[:, 1] - ends[:, 0]
        length = np.maximum(np.hypot(*step.T), 1e-9)[:, None]
        across = np.stack([-step[:, 1], step[:, 0]], axis=1) / length
        first, second = (across * crack.width[:, [end]] * side / 2 for end in (0, 1))
        corners = [ends[:, 0] + first, ends[:, 1] + second, ends[:, 1] - second, ends[:, 0] - first]
        self.ends = ends.astype(np.float32)
        beside = across * thickness / 2
        bars = [ends[:, 0] + beside, ends[:, 1] + beside, ends[:, 1] - beside, ends[:, 0] - beside]
        self.bars = np.stack(bars, axis=1).astype(np.float32)
        self.polygons = np.stack(corners, axis=1).astype(np.float32)


def opencv(cv2: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    fixed = np.round((drawing.polygons if tapered else drawing.ends) * 16).astype(np.int32)
    parts = list(fixed)

    def draw() -> NDArray[np.uint8]:
        picture = np.zeros((drawing.side, drawing.side), dtype=np.uint8)
        if tapered:
            for part in parts:
                cv2.fillConvexPoly(picture, part, 255, cv2.LINE_AA, 4)
        else:
            cv2.polylines(picture, parts, False, 255, drawing.thickness, cv2.LINE_AA, 4)
        return picture

    return draw


def cairo(cairo: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    parts = (drawing.polygons if tapered else drawing.ends).tolist()

    def draw() -> object:
        surface = cairo.ImageSurface(cairo.FORMAT_A8, drawing.side, drawing.side)
        context = cairo.Context(surface)
        context.set_line_width(drawing.thickness)
        for first, *rest in parts:
            context.move_to(*first)
            for corner in rest:
                context.line_to(*corner)
            if tapered:
                context.fill()
            else:
                context.stroke()
        return surface

    return draw


def skia(skia: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    parts = (drawing.polygons if tapered else drawing.ends).tolist()
    style = skia.Paint.kFill_Style if tapered else skia.Paint.kStroke_Style
    paint = skia.Paint(AntiAlias=True, Color=skia.ColorBLACK, StrokeWidth=drawing.thickness, Style=style)

    def draw() -> object:
        # The surface does not keep its pixels alive.
        picture = np.zeros((drawing.side, drawing.side, 4), dtype=np.uint8)
        surface = skia.Surface(picture)
        canvas = surface.getCanvas()
        for part in parts:
            if tapered:
                canvas.drawPath(skia.Path.Polygon([skia.Point(*corner) for corner in part], True), paint)
            else:
                canvas.drawLine(*part[0], *part[1], paint)
        return picture

    return draw


def aggdraw(aggdraw: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    parts = (drawing.polygons if tapered else drawing.ends).reshape(len(drawing.ends), -1).tolist()
    pen, brush = aggdraw.Pen(255, drawing.thickness), aggdraw.Brush(255)

    def draw() -> object:
        canvas = aggdraw.Draw("L", (drawing.side, drawing.side), 0)
        for part in parts:
            if tapered:
                canvas.polygon(part, brush)
            else:
                canvas.line(part, pen)
        return canvas

    return draw


def blend2d(blend2d: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    """Its binding fills paths and has no strokes: lines are bars. The paths are made beforehand."""

    def path(corners: list[list[float]]) -> object:
        made = blend2d.Path()
        made.move_to(*corners[0])
        for corner in corners[1:]:
            made.line_to(*corner)
        made.close()
        return made

    paths = [path(corners) for corners in (drawing.polygons if tapered else drawing.bars).tolist()]

    def draw() -> object:
        picture = blend2d.Image(drawing.side, drawing.side)
        context = blend2d.Context(picture)
        context.set_fill_style_rgba(255, 255, 255)
        for part in paths:
            context.fill_path(part)
        context.end()
        return picture

    return draw


def pillow(image: ModuleType, drawing: Drawing, tapered: bool) -> Callable[[], object]:
    """Not anti-aliased: it does less."""
    from PIL import ImageDraw

    parts = (drawing.polygons if tapered else drawing.ends).reshape(len(drawing.ends), -1).tolist()

    def draw() -> object:
        picture = image.new("L", (drawing.side, drawing.side))
        canvas = ImageDraw.Draw(picture)
        for part in parts:
            if tapered:
                canvas.polygon(part, fill=255)
            else:
                canvas.line(part, fill=255, width=drawing.thickness)
        return picture

    return draw


PEERS = {
    "OpenCV": ("cv2", opencv),
    "Cairo": ("cairo", cairo),
    "Skia": ("skia", skia),
    "aggdraw": ("aggdraw", aggdraw),
    "Blend2D": ("blend2d", blend2d),
    "Pillow, no AA": ("PIL.Image", pillow),
}


def seconds(work: Callable[[], object], repeats: int) -> float:
    """The least wall time of some runs."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter()
        work()
        times.append(time.perf_counter() - start)
    return min(times)


def pattern(edges: int, width: float) -> cz.Crack:
    """A crack pattern of about that many edges, some closing plates."""
    return cz.crack(n=max(edges * 10 // 24, 3), opening=0.6, width=width, rng=1)


def written(side: int, maps: tuple[str, ...] = SIX) -> list[np.ndarray]:
    """Arrays like those of some maps, each element written once."""
    like = cz.texture(
        cz.Crack(cz.PlanarGraph([[0, 0], [1, 1]], [[0, 1]]), [[0, 0]], [0], [0], (0, 0, 1, 1)), 1, maps=maps
    )
    return [np.full((side, side, *like[name].shape[2:]), 1, dtype=like[name].dtype) for name in maps]


def written_by_two(side: int, maps: tuple[str, ...] = SIX) -> None:
    """The same on two threads, each its half of every array."""
    found = [np.empty((side, side, *array.shape[2:]), dtype=array.dtype) for array in written(1, maps)]

    def fill(half: slice) -> None:
        for array in found:
            array[half] = 1

    with ThreadPoolExecutor(2) as pool:
        list(pool.map(fill, (slice(side // 2), slice(side // 2, None))))


def emptiness(side: int, repeats: int) -> str:
    """What maps without cracks cost: one edge in a corner."""
    corner = cz.PlanarGraph([[0.0, 0.0], [0.01, 0.01]], [[0, 1]])
    crack = cz.Crack(corner, [[0.001, 0.001]], [0], [0], (0, 0, 1, 1))
    cells = []
    for maps in (("mask",), ("height",), ("mask", "height", "normal", "strand"), SIX):
        ours = seconds(lambda maps=maps: cz.texture(crack, side, maps=maps, threads=1), repeats)
        cells.append(f"{'+'.join(maps)} {ours / seconds(lambda maps=maps: written(side, maps), repeats):.2f}")
    return f"{side} px without cracks / writing as many bytes: {', '.join(cells)}"


def alone(side: int, edges: int, repeats: int) -> str:
    """What each map costs on one thread, over all six together, and how much of that is writing as many bytes."""
    crack = pattern(edges, 2 * max(1, side // 2048) / side)
    together = seconds(lambda: cz.texture(crack, side, maps=SIX, threads=1), repeats)
    cells = []
    for name in SIX:
        own = seconds(lambda name=name: cz.texture(crack, side, maps=name, threads=1), repeats)
        bare = seconds(lambda name=name: written(side, (name,)), repeats)
        cells.append(f"{name} {own / together:.2f} ({bare / together:.2f})")
    plan = seconds(lambda: cz.texture_plan(crack, side, maps=SIX), repeats)
    bare = seconds(lambda: written(side), repeats)
    return (
        f"{side} px, {edges} edges, alone / six together (writing as many bytes): {', '.join(cells)}; "
        f"plates and lengths {plan / together:.2f}, writing all {bare / together:.2f}"
    )


def rows(side: int, edges: int, repeats: int) -> list[str]:
    """The lines of the table for one size and number of edges."""
    thickness = max(1, side // 2048)
    crack = pattern(edges, 2 * thickness / side)
    drawing = Drawing(crack, side, thickness)
    jobs = {}
    for threads in (1, 2):
        for name, maps in (("mask", ("mask",)), ("six", SIX)):
            jobs[name, threads] = lambda maps=maps, threads=threads: cz.texture(crack, side, maps=maps, threads=threads)
    held = cz.texture_plan(crack, side, maps=SIX).window(0, 0, side, side)
    for threads in (1, 2):
        jobs["refilled", threads] = lambda threads=threads: cz.texture_plan(
            crack, side, maps=SIX, threads=threads
        ).window(0, 0, side, side, out=held)
    ours = {job: seconds(work, repeats) for job, work in jobs.items()}
    head = f"{side} px, {len(crack.graph.edges)} edges: "
    head += ", ".join(f"{name} on {threads}: {1000 * time:.0f} ms" for (name, threads), time in ours.items())
    gain = {name: ours[name, 1] / ours[name, 2] for name in ("mask", "six")}
    memory = seconds(lambda: written(side), repeats)
    lines = [head, f"  two threads gain: mask {gain['mask']:.2f}, six {gain['six']:.2f}"]
    lines[1] += f", writing as many bytes as six {memory / seconds(lambda: written_by_two(side), repeats):.2f}"
    lines[1] += f"; six / writing as many bytes {ours['six', 1] / memory:.2f} {ours['six', 2] / memory:.2f}"
    peers = {"tiny-skia, cz.render": (lambda: cz.render(crack, side, threads=1), None)}
    for name, (module, make) in PEERS.items():
        try:
            library = importlib.import_module(module)
        except ImportError:
            lines.append(f"  {name}: not installed")
            continue
        peers[name] = make(library, drawing, True), make(library, drawing, False)
    for name, (tapered, plain) in peers.items():
        polygons = seconds(tapered, repeats)
        cells = [ours["mask", threads] / polygons for threads in (1, 2)]
        text = f"  mask / {name} tapers {cells[0]:.2f} {cells[1]:.2f} ({1000 * polygons:.0f} ms)"
        if plain is not None:
            strokes = seconds(plain, repeats)
            for job in ("mask", "six", "refilled"):
                text += f"; {job} / lines {ours[job, 1] / strokes:.2f} {ours[job, 2] / strokes:.2f}"
            text += f" ({1000 * strokes:.0f} ms)"
        lines.append(text)
        if plain is not None:
            lines[-1] += f", writing the bytes of six / lines {memory / strokes:.2f}"
    return lines


def preview(repeats: int) -> str:
    """A preview of 300 sites against Matplotlib drawing the same segments to a PNG."""
    import io

    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

    recipe = cz.Recipe(n=300)

    def theirs() -> None:
        figure = Figure(figsize=(5.12, 5.12), dpi=100)
        axes = figure.add_axes((0, 0, 1, 1))
        axes.add_collection(LineCollection(list(segments)))
        axes.set(xlim=(0, 1), ylim=(0, 1))
        figure.savefig(io.BytesIO(), format="png")

    segments = recipe.crack(rng=1).graph.segments
    ours = seconds(lambda: cz.preview(recipe, 512, rng=1), repeats)
    other = seconds(theirs, repeats)
    return (
        f"preview of 300 sites at 512: {1000 * ours:.1f} ms, Matplotlib {1000 * other:.1f} ms, ratio {ours / other:.2f}"
    )


def flatness(sides: list[int], repeats: int) -> str:
    """Nanoseconds a pixel of a height map of one pattern at several sizes."""
    crack = pattern(3000, 0.002)
    each = {side: seconds(lambda s=side: cz.texture(crack, s, maps=["height"]), repeats) for side in sides}
    return "height, ns a pixel: " + ", ".join(f"{side} {1e9 * time / side**2:.1f}" for side, time in each.items())


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description="Time textures against drawing libraries.")
    parser.add_argument("--sides", type=int, nargs="+", default=[2048, 4096, 8192])
    parser.add_argument("--edges", type=int, nargs="+", default=[10_000, 100_000, 300_000])
    parser.add_argument("--flat", type=int, nargs="+", default=[2048, 4096, 8192, 16384])
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--small", action="store_true", help="one small picture, once")
    parser.add_argument("-o", dest="folder", type=Path, help="also write the table to a file in this folder")
    given = parser.parse_args()
    if given.small:
        given.sides, given.edges, given.flat, given.repeats = [256], [1000], [128, 256], 1
    table = []

    def show(*lines: str) -> None:
        table.extend(lines)
        print(*lines, sep="\n", flush=True)

    show(preview(given.repeats), flatness(given.flat, given.repeats), emptiness(given.sides[-1] // 2, given.repeats))
    for side in given.sides:
        for edges in given.edges:
            show(*rows(side, edges, given.repeats))
        show(alone(side, next((edges for edges in given.edges if edges >= 100_000), given.edges[0]), given.repeats))
    if given.folder:
        given.folder.mkdir(parents=True, exist_ok=True)
        (given.folder / "texture.txt").write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
