"""The pictures of the README: presets in light, a strip of crack patterns, and two skeleton methods on a leaf.

The strip shows three patterns of one seed: cracks as trees, as the thesis has them; cracks that close their plates, as
in a glaze; and cracks around an impact.
"""

import argparse
from pathlib import Path

import numpy as np
from figure_5_8_one_step_against_edge_filter import draw
from gallery import MAPS, pattern
from leaf import picture
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

import crazing as cz


def strip(side: int) -> NDArray[np.uint8]:
    """Three squares side by side with a gap, (side, 3 side + 2 gaps, 4), clear between them."""
    unit, impact = (0, 0, 1, 1), (-2.5, -2.5, 2.5, 2.5)
    cracks = (
        cz.crack(n=120, bounds=unit, rng=21),
        cz.crack(n=220, opening=0.65, bounds=unit, rng=21),
        cz.crack(cz.sample.laplace(500, rng=21), bounds=impact, rng=21),
    )
    styles = (
        cz.Style(ink="#2b2622", ground="#f4f0e6"),
        cz.Style(ink="#4a3b2a", ground="#dfe6dc"),
        cz.Style(ink="#f2efe8", ground="#26292b"),
    )
    gap = np.zeros((side, side // 32, 4), dtype=np.uint8)
    parts = [cz.render(c, side, style=style) for c, style in zip(cracks, styles, strict=True)]
    return np.concatenate([parts[0], gap, parts[1], gap, parts[2]], axis=1)


#: Two rows of presets.
SHOWN = (
    ("mud-mature", "bark", "glaze", "old-varnish"),
    ("ice", "painting-italian", "rock", "mud-fresh"),
)


def presets(side: int) -> NDArray[np.uint8]:
    """Lit textures of some presets, drawn twice as fine and scaled down."""

    def lit(name: str) -> NDArray[np.uint8]:
        large = Image.fromarray(cz.texture(pattern(name), 2 * side, maps=MAPS, material=name).lit())
        return np.asarray(large.resize((side, side), Image.Resampling.LANCZOS))

    return np.concatenate([np.concatenate([lit(name) for name in row], axis=1) for row in SHOWN])


def skeletons(n: int) -> Figure:
    return draw(cz.compare(cz.sample.from_image(picture(), n=n)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="quick pictures, for checks")
    parser.add_argument(
        "-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where the PNGs are written"
    )
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    cz.save_png(given.output / "crack.png", strip(64 if given.small else 352))
    Image.fromarray(presets(48 if given.small else 300)).save(given.output / "presets.jpg", quality=85)
    skeletons(150 if given.small else 600).savefig(given.output / "skeletons.png", dpi=50 if given.small else 110)


if __name__ == "__main__":
    main()
