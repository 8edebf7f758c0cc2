"""How many outlines each method reconstructs exactly, by density of the samples and by how evenly they stand.

``python python/benchmarks/curves.py SILHOUETTES.npz [RINGS.npz ...]`` prints a table. Silhouettes are arrays
``xy_N_MODE`` and ``offsets_N_MODE``, rings ``xy`` and ``offsets``: consecutive rows of a ring are its true edges. Of
more than a thousand rings every other one was looked at when the costs of ``curve`` were set: the rest are given apart
as well, as ``NAME, unseen``.
Without files, stars with acute corners are sampled instead.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import crazing as cz

METHODS = ("two-pass", "one-step", "nn", "curve")
Ring = NDArray[np.float64]


def stars(count: int) -> list[Ring]:
    """Outlines of stars with five to nine points, the more acute the more there are, evenly sampled."""
    rings = []
    for points in range(5, 10):
        turn = np.arange(2 * points) * np.pi / points
        corners = np.where(np.arange(2 * points) % 2, 0.4, 1.0)[:, None] * np.column_stack([np.cos(turn), np.sin(turn)])
        part = np.linspace(0, 1, max(count // (2 * points), 2), endpoint=False)[None, :, None]
        sides = corners[:, None] + part * (np.roll(corners, -1, axis=0) - corners)[:, None]
        rings.append(sides.reshape(-1, 2))
    return rings


def sets(paths: list[Path]) -> Iterator[tuple[str, list[Ring]]]:
    """Named lists of rings."""
    if not paths:
        yield from ((f"stars {count}", stars(count)) for count in (100, 300))
    for path in paths:
        with np.load(path) as arrays:
            for name in (name for name in arrays.files if name.startswith("xy")):
                offsets = arrays[name.replace("xy", "offsets")]
                rings = np.split(arrays[name], offsets[1:-1])
                yield f"{path.stem}{name.removeprefix('xy')}", rings
                if len(rings) > 1000:
                    yield f"{path.stem}{name.removeprefix('xy')}, unseen", rings[1::2]


def keys(edges: NDArray[np.int32]) -> NDArray[np.int64]:
    """One number an edge, the same in both directions."""
    ends = np.sort(edges, axis=1).astype(np.int64)
    return np.unique(ends[ends[:, 0] != ends[:, 1]] @ np.array([1 << 31, 1]))


def scores(rings: list[Ring], method: str) -> tuple[int, int, float, float]:
    """Rings, those found exactly, recall and precision of all their edges."""
    counts = []
    for ring in rings:
        try:
            d = cz.diagram(ring)
            graph = cz.curve(d) if method == "curve" else cz.crust(d, method=method)
        except cz.DegenerateInputError:
            continue
        true = keys(np.column_stack([d.site_of, np.roll(d.site_of, -1)]))
        found = keys(graph.edges)
        counts.append((len(true), len(found), len(np.intersect1d(true, found))))
    true, found, both = np.array(counts).T
    exact = int(((true == both) & (found == both)).sum())
    return len(counts), exact, both.sum() / true.sum(), both.sum() / found.sum()


def table(paths: list[Path]) -> str:
    """Rows of every set and method."""
    lines = [f"{'outlines':24} {'method':10} {'rings':>5} {'exact':>6} {'recall':>7} {'precision':>9}"]
    for name, rings in sets(paths):
        for method in METHODS:
            count, exact, recall, precision = scores(rings, method)
            lines.append(f"{name:24} {method:10} {count:5} {exact / count:6.0%} {recall:7.4f} {precision:9.4f}")
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("paths", type=Path, nargs="*", help="npz files of outlines")
    parser.add_argument("--small", action="store_true", help="no files: shapes of the script's own")
    parser.add_argument("-o", "--output", type=Path, help="also write the table here")
    arguments = parser.parse_args()
    text = table([] if arguments.small else arguments.paths)
    print(text)
    if arguments.output is not None:
        arguments.output.write_text(text + "\n")


if __name__ == "__main__":
    main()
