"""Real outlines through every method: axes inside and outside, exact reconstructions, and how the skeletons compare.

The axes of a picture are also held to what scikit-image finds on its pixels: the thinned mask (`skeletonize`) and the
ridges of its distance transform (`medial_axis`). Neither is the truth, which for a mask of pixels there is none of; a
skeleton of pixels is off by up to a pixel, and keeps or drops hairs by rules of its own. So both directions are given:
how much of theirs is within a pixel and a half of ours, how much of ours within that of theirs, and the farthest off.

Give a folder with pictures (`*_mask.png`, `*_labels.png`: one integer a cell) and outlines (`*.npz`: `xy...` and
`offsets...`, consecutive rows of a ring being its true edges). Without one, scikit-image's horse and blobs and our own
leaf are taken.
"""

import argparse
from pathlib import Path

import numpy as np
from axes_grid import AXIS, CURVE
from leaf import outline
from matplotlib.figure import Figure
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from skimage import data
from skimage.morphology import medial_axis, skeletonize

import crazing as cz
from crazing.images import read_image

METHODS = ("initial", "poles", "edge-filter", "one-step")
#: Pixels between two samples: any finer they show the stairs of the pixels.
SPACING = 1.5
#: Pixels that two skeletons of one mask may be apart: half of one for the outline and one for thinning.
NEAR = 1.5
CRUSTS = ("two-pass", "one-step", "nn", "curve")


def pictures(folder: Path | None) -> dict[str, NDArray[np.bool_]]:
    """Masks; of a label picture the largest cell."""
    if folder is None:
        blobs = data.binary_blobs(length=128, blob_size_fraction=0.15, volume_fraction=0.4, rng=2)
        return {"horse": ~data.horse(), "blobs": np.asarray(blobs)}
    found = {}
    for path in sorted([*folder.glob("*_mask.png"), *folder.glob("*_labels.png")]):
        image = read_image(path)
        grey = image if image.ndim == 2 else image[..., 0]
        largest = np.bincount(grey[grey > 0].astype(np.int64)).argmax() if "labels" in path.stem else None
        found[path.stem] = grey > 0 if largest is None else grey == largest
    return found


def ring_sets(folder: Path | None) -> dict[str, list[NDArray[np.float64]]]:
    if folder is None:
        return {"leaf": [outline(steps) for steps in (6, 12, 24)]}
    found = {}
    for path in sorted(folder.glob("*.npz")):
        with np.load(path) as arrays:
            for name in (name for name in arrays.files if name.startswith("xy")):
                offsets = arrays[name.replace("xy", "offsets")]
                found[path.stem + name.removeprefix("xy")] = np.split(arrays[name], offsets[1:-1])
    return found


def exact(ring: NDArray[np.float64], method: str) -> bool:
    """Whether a crust joins exactly the samples that follow one another."""
    d = cz.diagram(ring)
    if not len(d.triangles):
        # All on a line, as along the edge of a map.
        return False
    graph = cz.curve(d) if method == "curve" else cz.crust(d, method=method)
    true, found = (
        {(min(a, b), max(a, b)) for a, b in pairs if a != b}
        for pairs in (zip(d.site_of.tolist(), np.roll(d.site_of, -1).tolist(), strict=True), graph.edges.tolist())
    )
    return true == found


def sides(s: cz.Skeleton) -> tuple[cz.PlanarGraph, cz.PlanarGraph]:
    """The axis within the curve and the one around it; dual edges tell their side, others take that of no edge."""
    inner = {(min(a, b), max(a, b)) for a, b in s.inner.edges.tolist()}
    within = np.array([(min(a, b), max(a, b)) in inner for a, b in s.axis.edges.tolist()], dtype=bool)
    return cz.PlanarGraph(s.axis.vertices, s.axis.edges[within]), cz.PlanarGraph(s.axis.vertices, s.axis.edges[~within])


def pixels(skeleton: NDArray[np.bool_]) -> NDArray[np.float64]:
    """The middles of the marked pixels, y up."""
    rows, columns = np.nonzero(skeleton)
    return np.column_stack([columns + 0.5, len(skeleton) - rows - 0.5])


def spread(graph: cz.PlanarGraph, step: float = 0.25) -> NDArray[np.float64]:
    """Points along the edges, evenly: long edges have as many more as they are longer."""
    parts = np.maximum(np.ceil(graph.lengths / step).astype(int), 1)
    edge = np.repeat(np.arange(len(parts)), parts)
    share = (np.arange(len(edge)) - np.repeat(np.cumsum(parts) - parts, parts) + 0.5) / parts[edge]
    a, b = graph.segments[edge, 0], graph.segments[edge, 1]
    return np.asarray(a + share[:, None] * (b - a))


def beside(inner: cz.PlanarGraph, theirs: NDArray[np.float64]) -> str:
    """Shares within a pixel and a half of the other, theirs and ours, and the farthest off."""
    if not len(inner.edges):
        return "none"
    there, here = inner.distances(theirs), cKDTree(theirs).query(spread(inner))[0]
    return f"{(there <= NEAR).mean():4.0%} {(here <= NEAR).mean():4.0%} {max(there.max(), here.max()):6.1f}"


def draw(masks: dict[str, NDArray[np.bool_]], n: int | None) -> Figure:
    figure = Figure(figsize=(3.4 * (len(METHODS) + 1), 3.7 * len(masks)), layout="constrained")
    grid = figure.subplots(len(masks), len(METHODS) + 1, squeeze=False)
    head = f"{'picture':28} {'method':18} {'in: edges, pieces, ends':>24} {'out: edges, pieces':>20}"
    print(head + f" {'thinned: theirs ours off':>26} {'ridges: theirs ours off':>26}")
    for row, (name, mask) in zip(grid, masks.items(), strict=True):
        padded = np.pad(mask, 2)
        points = cz.sample.from_image(padded, spacing=SPACING) if n is None else cz.sample.from_image(padded, n=n)
        d = cz.diagram(points)
        theirs = [pixels(skeletonize(padded)), pixels(medial_axis(padded, rng=0))]
        found = [(method, cz.medial_axis(d, method=method)) for method in METHODS]
        found.append(("one-step, pruned", found[-1][1].prune()))
        for ax, (method, s) in zip(row, found, strict=True):
            inner, outer = sides(s)
            counts = f"{len(inner.edges)}, {inner.components}, {inner.leaves}"
            near = " ".join(f"{beside(inner, points):>26}" for points in theirs)
            print(f"{name:28} {method:18} {counts:>24} {f'{len(outer.edges)}, {outer.components}':>20} {near}")
            outer.plot(ax, color="#c8c8c8", linewidth=0.5)
            inner.plot(ax, color=AXIS, linewidth=0.6)
            s.crust.plot(ax, color=CURVE, linewidth=0.5)
            ax.set(title=f"{name}, {method}", xlim=(0, mask.shape[1] + 4), ylim=(0, mask.shape[0] + 4))
            ax.title.set_fontsize("small")
            ax.set_axis_off()
    return figure


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=Path, nargs="?", help="pictures and outlines")
    parser.add_argument("--small", action="store_true", help="few samples, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNG is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    masks = pictures(given.folder)
    draw(masks, 300 if given.small else None).savefig(given.output / "real_data.png", dpi=60 if given.small else 130)
    print(f"\n{'outlines':28} {'rings':>6} " + " ".join(f"{method:>9}" for method in CRUSTS))
    for name, rings in ring_sets(given.folder).items():
        whole = [ring for ring in rings if len(np.unique(ring, axis=0)) > 3]
        share = [sum(exact(ring, method) for ring in whole) / len(whole) for method in CRUSTS]
        print(f"{name:28} {len(whole):6} " + " ".join(f"{part:9.0%}" for part in share))


if __name__ == "__main__":
    main()
