"""Names of the files of a texture, as the programs and libraries that read them expect."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from crazing.arguments import choice, found

#: Words of pictures that no library of materials has, in the style of each layout.
_OWN = ("mask", "wear", "distance", "direction", "cell", "strand", "generation")


@dataclass(frozen=True)
class Layout:
    """How a picture's file is called."""

    pattern: str
    """With name, size, word and the format's own word."""
    words: dict[str, str] = field(default_factory=dict)
    """What each picture is called; one that is missing keeps its own name."""
    normals: tuple[str, ...] = ("normal_gl",)
    """What the map "normal" is written as."""
    lower: bool = True
    """Whether the size is spelt 4k or 4K."""

    def file(self, name: str, picture: str, pixels: int, word: str, ending: str) -> str:
        """The name of a picture's file."""
        size = resolution(pixels)
        size = size.lower() if self.lower else size
        called = self.words.get(picture, picture)
        return self.pattern.format(name=name, size=size, map=called, format=word) + ending


LAYOUTS = {
    "plain": Layout("{map}"),
    "ambientcg": Layout(
        "{name}_{size}-{format}_{map}",
        {
            "color": "Color",
            "normal_gl": "NormalGL",
            "normal_dx": "NormalDX",
            "height": "Displacement",
            "roughness": "Roughness",
            "ao": "AmbientOcclusion",
            "orm": "ORM",
            **{word: word.capitalize() for word in _OWN},
        },
        ("normal_gl", "normal_dx"),
        lower=False,
    ),
    "polyhaven": Layout(
        "{name}_{map}_{size}",
        {
            "color": "diff",
            "normal_gl": "nor_gl",
            "normal_dx": "nor_dx",
            "height": "disp",
            "roughness": "rough",
            "orm": "arm",
        },
        ("normal_gl", "normal_dx"),
    ),
    "unreal": Layout(
        "T_{name}_{map}",
        {
            "color": "D",
            "normal_gl": "NGL",
            "normal_dx": "N",
            "height": "H",
            "roughness": "R",
            "ao": "AO",
            "orm": "ORM",
            **{word: word.capitalize() for word in _OWN},
        },
        ("normal_dx",),
    ),
}


def named(name: str) -> Layout:
    """The layout of that name."""
    return LAYOUTS[choice(name, "layout", LAYOUTS)]


def resolution(pixels: int) -> str:
    """The longer side as libraries of materials spell it: 8K for 8192, else the number itself."""
    return f"{pixels // 1024}K" if pixels % 1024 == 0 else str(pixels)


def checked_name(name: str) -> str:
    """A name of a material that is safe in a file's name and in XML."""
    if not isinstance(name, str):
        raise TypeError(f"name is {found(name)}; text is wanted")
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9._-]{0,63}", name):
        raise ValueError(f"name is {name!r}; up to 64 letters, digits, dots, dashes and underscores are wanted")
    return name


def chosen(maps: tuple[str, ...], layout: Layout) -> tuple[str, ...]:
    """The pictures of maps and pictures by name: "normal" becomes what the layout has for it."""
    named = [picture for word in maps for picture in (layout.normals if word == "normal" else (word,))]
    return tuple(dict.fromkeys(named))
