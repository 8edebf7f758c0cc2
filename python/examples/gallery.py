"""Every preset as a lit texture that tiles: a sheet of all, and one picture of each where asked.

Pattern and material come from the preset alone; the light is `Texture.lit`. Patterns that cannot repeat are drawn as
they are.
"""

import argparse
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

import crazing as cz

MAPS = ("color", "mask", "height", "normal", "ao", "roughness")
COLUMNS = 4
CAPTION = 22
SEED = 11
#: Rough cracks are cut as finely as in a picture of 1024 pixels.
DETAIL = 3 / 1024


def pattern(name: str) -> cz.Crack:
    """The preset's crack, on a torus where its recipe can be laid on one.

    Each has a seed of its own.
    """
    recipe, seed = cz.preset(name), SEED + cz.presets().index(name)
    try:
        return recipe.crack(rng=seed, period=(1.0, 1.0), detail=DETAIL)
    except ValueError:
        return recipe.crack(rng=seed, detail=DETAIL)


def sheet(pictures: dict[str, np.ndarray], side: int) -> Image.Image:
    """The pictures, scaled to one size, with their names under them."""
    rows = -(-len(pictures) // COLUMNS)
    page = Image.new("RGB", (COLUMNS * side, rows * (side + CAPTION)), "#181818")
    draw = ImageDraw.Draw(page)
    for place, (name, picture) in enumerate(pictures.items()):
        left, top = place % COLUMNS * side, place // COLUMNS * (side + CAPTION)
        page.paste(Image.fromarray(picture).resize((side, side), Image.Resampling.LANCZOS), (left, top))
        draw.text((left + 6, top + side + 4), name, fill="#dddddd")
    return page


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--small", action="store_true", help="quick pictures, for checks")
    parser.add_argument("--each", action="store_true", help="also write every preset's own picture")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="FOLDER", help="where PNGs are written")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    size = 96 if given.small else 1024
    pictures = {name: cz.texture(pattern(name), size, maps=MAPS, material=name).lit() for name in cz.presets()}
    sheet(pictures, size // 2).save(given.output / "gallery.png")
    if given.each:
        for name, picture in pictures.items():
            Image.fromarray(picture).save(given.output / f"{name}.png")


if __name__ == "__main__":
    main()
