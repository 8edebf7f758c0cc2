"""What a crack pattern is made of: the shape of its cracks and plates in depth, and its colours."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from importlib import resources
from typing import Any

from crazing import arguments
from crazing.render import Color, rgba

#: Fields that hold colours.
_COLORS = ("crack", "dirt", "worn")

#: The ranges of the fields that hold numbers, where they are not from 0 to 1.
_RANGES = {
    "relief": (0.0, 10.0),
    "rim_width": (0.0, 100.0),
    "chip": (0.0, 100.0),
    "chip_size": (0.0, 100.0),
    "curl": (-1.0, 1.0),
    "curl_width": (0.0, 10.0),
    "grain_size": (0.0, 100.0),
    "mottle_size": (0.0, 100.0),
    "stretch": (0.01, 100.0),
    "dirt_width": (0.0, 10.0),
    "wear_width": (0.0, 10.0),
}


@dataclass(frozen=True, kw_only=True)
class Material:
    """The profile and the colours of a texture.

    Heights are parts of the range from the deepest to the highest place. Lengths "in widths" count in widths of the
    pattern's wide cracks (95 of 100 are narrower), lengths "in plates" in the size of its plates (twice the area
    over the length of all cracks), so that one material suits patterns of any scale.

    Parameters
    ----------
    relief : float
        What the whole range of heights is, in plates: how steep normals and occlusion are.
    depth : float
        How deep the widest cracks are, at most what curl, tilt, level and grain leave of the range; narrower ones are
        shallower, by the root of their width.
    roundness : float
        0 for a V-shaped crack, 1 for a U with steep walls and a flat floor.
    rim, rim_width : float
        How far the rim is rounded off, and how far from the crack that begins, in widths.
    chip, chip_size : float
        How far, in widths, chips have broken out of the rims, and their size, in plates.
    fray : float
        How far the sides of cracks are broken, at most, in half their own width: where the grain is high, so that no
        side is like the other, and down to two pixels. Mask and distance stay those of the geometry.
    curl, curl_width, curl_spread : float
        How far plates rise towards their edges (negative: fall), over which width, in plates, and how much plates
        differ in that.
    tilt, level : float
        How far the corners of a plate may rise by tilting, and whole plates by lying higher than others.
    grain, grain_size : float
        Height of a fine grain of plates and cracks, and the size of its largest grains, in plates. As chips and
        patches, it has ever finer parts down to two pixels: a larger picture shows more of it.
    plate : sequence of colours
        A ramp of colours of the plates.
    tint, mottle, speckle : float
        How far along the ramp plates differ from each other, large patches do, and the grain does.
    mottle_size : float
        Size of the largest patches, in plates.
    stretch : float
        Grains and patches are so many times as long, along y, as their size, which is that across: fibres of bark or
        wood. Below 1 along x.
    crack : colour
        Inside the cracks.
    dirt, dirt_amount, dirt_width : colour, float, float
        What has settled beside the cracks, how much, and over which width, in plates.
    dirt_taper : float
        How far that width follows the crack's own: 0 along all cracks alike, 1 in proportion to their width; as given
        along the pattern's wide ones.
    debris : float
        How much of it lies inside the cracks, here and there.
    worn, wear, wear_width : colour, float, float
        What worn edges of plates look like, how worn they are, and over which width, in plates.
    roughness, roughness_spread, crack_roughness : float
        Of the plates (0 is a mirror), how much grain and patches change it, and inside the cracks.

    Examples
    --------
    >>> from crazing.material import Material
    >>> Material(plate=["#886644", "#aa8866"], depth=0.8).plate
    ((136, 102, 68), (170, 136, 102))
    """

    relief: float = 0.25
    depth: float = 0.7
    roundness: float = 0.4
    rim: float = 0.06
    rim_width: float = 0.8
    chip: float = 0.0
    chip_size: float = 0.05
    fray: float = 0.0
    curl: float = 0.0
    curl_width: float = 0.3
    curl_spread: float = 0.5
    tilt: float = 0.0
    level: float = 0.0
    grain: float = 0.0
    grain_size: float = 0.02
    plate: Sequence[Color] = ("#c9bfae", "#e6dfd0")
    tint: float = 0.4
    mottle: float = 0.4
    mottle_size: float = 1.5
    speckle: float = 0.15
    stretch: float = 1.0
    crack: Color = "#2b2622"
    dirt: Color = "#6f6455"
    dirt_amount: float = 0.4
    dirt_width: float = 0.12
    dirt_taper: float = 0.0
    debris: float = 0.0
    worn: Color = "#f4f0e6"
    wear: float = 0.2
    wear_width: float = 0.04
    roughness: float = 0.6
    roughness_spread: float = 0.15
    crack_roughness: float = 0.95

    def __post_init__(self) -> None:
        if isinstance(self.plate, str) or not hasattr(self.plate, "__len__") or not len(self.plate):
            raise ValueError(f"plate is {self.plate!r}; a sequence of one colour or more is wanted")
        ramp = tuple(_rgb(color, f"plate[{i}]") for i, color in enumerate(self.plate))
        object.__setattr__(self, "plate", ramp)
        for name in _COLORS:
            object.__setattr__(self, name, _rgb(getattr(self, name), name))
        for field in fields(self):
            if field.name != "plate" and field.name not in _COLORS:
                low, high = _RANGES.get(field.name, (0.0, 1.0))
                value = arguments.number(getattr(self, field.name), field.name, low=low, high=high)
                object.__setattr__(self, field.name, value)

    @property
    def middle(self) -> tuple[int, int, int]:
        """The colour in the middle of the ramp of the plates."""
        first, second = (_rgb(self.plate[(len(self.plate) - up) // 2], "plate") for up in (1, 0))
        red, green, blue = ((a + b) // 2 for a, b in zip(first, second, strict=True))
        return red, green, blue

    @classmethod
    def from_table(cls, table: Mapping[str, Any]) -> Material:
        """The material of a TOML table.

        Parameters
        ----------
        table : mapping
            Some of the fields by name; the others keep their defaults.

        Returns
        -------
        Material

        Raises
        ------
        ValueError
            For a name that is no field, or a value out of its range.
        """
        known = [field.name for field in fields(cls)]
        unknown = sorted(set(arguments.of_kind(table, "table", dict)) - set(known), key=str)
        if unknown:
            asked = arguments.meant(unknown[0], known)
            raise ValueError(f"the material has no {unknown[0]!r}{asked}; it may have {', '.join(known)}")
        return cls(**table)


def preset_material(name: str) -> Material:
    """The material of a preset: the table `[material]` of its file, or the default where that has none.

    Parameters
    ----------
    name : str
        Name of a preset.

    Returns
    -------
    Material

    Raises
    ------
    ValueError
        If there is no such preset.
    """
    folder = resources.files("crazing") / "presets"
    names = sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir()) if folder.is_dir() else []
    arguments.choice(name, "material", names)
    table = tomllib.loads((folder / f"{name}.toml").read_text(encoding="utf-8"))
    return Material.from_table(table.get("material", {}))


def _rgb(color: Any, name: str) -> tuple[int, int, int]:
    red, green, blue, alpha = rgba(color, name)
    if alpha != 255:
        raise ValueError(f"{name} is {color!r}; a colour without alpha is wanted")
    return red, green, blue


def in_data_units(
    material: Material, extent: tuple[float, float], bounds: tuple[float, float, float, float]
) -> dict[str, Any]:
    """The fields with all lengths in data units, for cracks of such a length in all and such a width."""
    length, widest = extent
    xmin, ymin, xmax, ymax = bounds
    plate = 2.0 * (xmax - xmin) * (ymax - ymin) / length if length > 0.0 else max(xmax - xmin, ymax - ymin)
    scaled = {name: getattr(material, name) for name in material.__dataclass_fields__}
    for name in ("relief", "chip_size", "curl_width", "grain_size", "mottle_size", "dirt_width", "wear_width"):
        scaled[name] = scaled[name] * plate
    for name in ("rim_width", "chip"):
        scaled[name] = scaled[name] * widest
    return {**scaled, "widest": widest}
