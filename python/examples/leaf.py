"""A maple leaf of our own, the shape that the figures of leaves share: its corners, and a picture of it.

The outline has the sharp tips and the deep notches that crust algorithms stumble over.
"""

import argparse
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from skimage.draw import polygon2mask
from skimage.filters import gaussian

import crazing as cz

# Right half from the tip to the stem, drawn by eye; y up, the leaf is about 2 high.
HALF = (
    (0.00, 1.00), (0.13, 0.74), (0.25, 0.79), (0.17, 0.33), (0.38, 0.56), (0.44, 0.44), (0.66, 0.50), (0.59, 0.28),
    (0.68, 0.20), (0.92, 0.16), (0.70, 0.00), (0.52, -0.14), (0.56, -0.26), (0.30, -0.24), (0.035, -0.26),
    (0.045, -0.70),
)  # fmt: skip

#: How far the middle of a side hangs inwards, as a part of its length; on a leaf no side is straight.
SAG = 0.06


def outline(steps: int = 12) -> NDArray[np.float64]:
    """The closed outline, clockwise, (n, 2), with `steps` points a side."""
    right = np.array(HALF)
    corners = np.concatenate([right, right[::-1] * (-1, 1)])[:-1]
    ahead = np.roll(corners, -1, axis=0) - corners
    t = np.linspace(0, 1, steps, endpoint=False)[:, None]
    inward = np.stack([ahead[:, 1], -ahead[:, 0]], axis=1)[:, None]
    return (corners[:, None] + t * ahead[:, None] + 4 * SAG * t * (1 - t) * inward).reshape(-1, 2)


def picture(side: int = 600, blur: float = 1.5) -> NDArray[np.uint8]:
    """The leaf in white on black, (side, side), its edge blurred over some pixels as in a photograph."""
    x, y = (0.5 + outline().T * 0.46 - [[0], [0.46 * 0.15]]) * side
    mask = polygon2mask((side, side), np.stack([side - y, x], axis=1))
    return np.round(255 * gaussian(mask.astype(float), blur)).astype(np.uint8)


def main() -> None:
    parser = argparse.ArgumentParser(description="Draws the leaf.")
    parser.add_argument("--small", action="store_true", help="a quick picture, for checks")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where leaf.png is written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    cz.save_png(given.output / "leaf.png", 255 - picture(100 if given.small else 600))


if __name__ == "__main__":
    main()
