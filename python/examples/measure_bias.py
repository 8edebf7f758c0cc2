"""What a raster does to every statistic: patterns measured exactly as graphs, and as masks drawn from them.

Lengths of the graph are given in pixels of the mask, so that both columns have one unit.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import numpy as np

import crazing as cz

PATTERNS = {
    "Voronoi": {"opening": 0.0},
    "opening .6": {"opening": 0.6},
    "thesis": {"opening": 1.0},
}
SHOWN = (
    "i_nodes",
    "x_nodes",
    "mean_degree",
    "t_share",
    "near_right",
    "near_even",
    "angle_sd",
    "mosaic_n",
    "mosaic_v",
    "loops_per_junction",
    "dead_end_length",
    "bridge_length",
    "segment_length",
    "segment_cv",
    "tortuosity",
    "cell_cv",
    "orientation",
    "roughness",
    "box_dimension",
    "width",
    "width_ratio",
    "area_fraction",
)
LENGTHS = ("segment_length", "width")


def means(found: list[cz.CrackStatistics], scale: float) -> dict[str, float]:
    rows = {name: np.array([getattr(each, name) for each in found]) for name in SHOWN}
    kept = {name: values[np.isfinite(values)] for name, values in rows.items()}
    return {
        name: float(values.mean()) * (scale if name in LENGTHS else 1.0) if len(values) else math.nan
        for name, values in kept.items()
    }


def text(value: float) -> str:
    return "-" if math.isnan(value) else f"{value:.3g}" if value >= 10 else f"{value:.3f}"


def table(seeds: int, plates: int, pixels: int) -> str:
    columns = []
    for options in PATTERNS.values():
        cracks = [cz.crack(n=plates, rng=seed, **options) for seed in range(seeds)]
        columns.append((means([cz.measure(crack) for crack in cracks], pixels), 1))
        columns.append((means([cz.measure(crack, raster=pixels) for crack in cracks], 1.0), 1))
    head = " ".join(f"{name:>15}" for name in PATTERNS)
    lines = [f"{'statistic':20}{head}", f"{'':20}" + " ".join(f"{'graph':>8}{'mask':>7}" for _ in PATTERNS)]
    for name in SHOWN:
        pairs = [(columns[2 * i][0][name], columns[2 * i + 1][0][name]) for i in range(len(PATTERNS))]
        lines.append(f"{name:20}" + " ".join(f"{text(graph):>8}{text(mask):>7}" for graph, mask in pairs))
    return "\n".join(lines)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="few patterns on few pixels")
    parser.add_argument("-o", "--output", type=Path, help="also write the table here")
    arguments = parser.parse_args()
    found = table(2, 60, 300) if arguments.small else table(20, 300, 800)
    print(found)
    if arguments.output is not None:
        arguments.output.write_text(found + "\n")


if __name__ == "__main__":
    main()
