"""The maps of a texture from the command line: of a preset or a recipe, in files of any size."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import click

import crazing
from crazing import _core, provenance
from crazing.arguments import meant
from crazing.cli.progress import rows
from crazing.material import preset_material
from crazing.pictures.output import Wanted, is_file, pictures_of, words
from crazing.recipe import SEEN, read_toml

#: What a folder gets when no maps are named; a single file gets the colour.
USUAL = ("color", "normal", "height", "ao", "roughness")

#: Fields of a recipe by the options that set them, and those that only walls of a maze have.
_OPTIONS = {"n": "--sites", "sampler": "--distribution", "opening": "--opening"}
_MAZE = ("sampler", "opening")


@dataclass(frozen=True, kw_only=True)
class Order:
    """What was asked for on the command line."""

    seed: int
    size: tuple[int, int]
    """Width and height, pixels."""
    output: str
    preset: str | None
    recipe: str | None
    material: str | None
    seamless: bool
    maps: str | None
    format: str | None
    layout: str
    name: str | None
    metres: float
    frames: int | None
    threads: int | None
    changes: dict[str, Any]
    """Fields of the recipe that are given on their own."""
    width: float | None

    def make(self) -> dict[str, Any]:
        """Makes the files; a report of them."""
        # Before any work, and before a folder is made for frames.
        pictures_of(self.output, Wanted(self._maps(), self.format, self.layout, self._name(), self.metres))
        recipe, material = self._recipe()
        frame = self._frame()
        crack = recipe.crack(**frame, width=self.width, rng=self.seed)
        made: list[Path] = []
        for age, path in self._stages():
            origin = provenance.of_recipe(
                recipe, seed=self.seed, preset=self.preset, width=self.width, age=age, **frame
            )
            grown = crack if age is None else crack.at(age)
            with rows() as progress:
                made += crazing.write_texture(
                    grown,
                    path,
                    (self.size[1], self.size[0]),
                    maps=self._maps(),
                    material=material,
                    # The frame of the whole pattern, however little of it has grown.
                    bounds=crack.bounds,
                    seed=self.seed,
                    format=self.format,
                    layout=self.layout,
                    name=self._name(),
                    metres=self.metres,
                    origin=origin,
                    threads=self.threads,
                    progress=progress,
                )
        return {
            "algorithm_version": crazing.algorithm_version,
            "version": _core.__version__,
            "command": "texture",
            "parameters": {name: value for name, value in dataclasses.asdict(self).items() if value is not None},
            "edges": len(crack.graph.edges),
            "files": [str(path) for path in made],
        }

    def _recipe(self) -> tuple[crazing.Recipe, crazing.Material | None]:
        """The recipe with its changes, and the material that stands beside it."""
        if self.preset is not None:
            recipe = crazing.preset(self.preset)
            material: crazing.Material | None = preset_material(self.preset)
        elif self.recipe is not None:
            recipe, material = crazing.Recipe.load(self.recipe), _material_beside(self.recipe)
        else:
            recipe, material = crazing.Recipe(), None
        if recipe.generator != "maze":
            idle = [_OPTIONS[name] for name in self.changes if name in _MAZE]
            if idle:
                kind = self.preset or self.recipe
                raise click.UsageError(f"{idle[0]} does nothing for {kind}, whose cracks are not the walls of a maze.")
        if self.material is not None:
            material = preset_material(self.material)
        return recipe.replace(**self.changes), material

    def _frame(self) -> dict[str, Any]:
        """The picture has a height of 1 in the data."""
        aspect, detail = self.size[0] / self.size[1], SEEN / self.size[1]
        if self.seamless:
            return {"bounds": None, "period": (aspect, 1.0), "detail": detail}
        return {"bounds": (0.0, 0.0, aspect, 1.0), "period": None, "detail": detail}

    def _maps(self) -> tuple[str, ...]:
        if self.maps is None:
            return ("color",) if is_file(self.output) else USUAL
        return words("all") if self.maps == "all" else tuple(part.strip() for part in self.maps.split(","))

    def _name(self) -> str:
        if self.name is not None:
            return self.name
        if self.preset is not None:
            return self.preset
        if self.recipe is None:
            return "texture"
        # Of a file's name what names of pictures may hold.
        return re.sub(r"[^A-Za-z0-9._-]+", "-", Path(self.recipe).stem).lstrip("._-")[:64] or "texture"

    def _stages(self) -> Iterator[tuple[float | None, Path]]:
        """The age of each frame and where it goes: a folder of its own, or a numbered file."""
        output = Path(self.output)
        if self.frames is None:
            yield None, output
            return
        for frame in range(1, self.frames + 1):
            number = f"{frame:0{max(4, len(str(self.frames)))}d}"
            if is_file(output):
                yield frame / self.frames, output.with_name(f"{output.stem}_{number}{output.suffix}")
            else:
                output.mkdir(exist_ok=True)
                yield frame / self.frames, output / number


def _material_beside(path: str) -> crazing.Material | None:
    """The table `[material]` of a recipe's file, if there is one."""
    tables = read_toml(path)
    # Of preset files, which this may be a copy of.
    known = ("title", "citation", "recipe", "targets", "material")
    for name in tables:
        if name not in known:
            raise ValueError(f"{path} has a table or key {name!r}{meant(name, known)}; {', '.join(known)} are read")
    table = tables.get("material")
    if table is None:
        return None
    if not isinstance(table, dict):
        raise click.BadParameter(f"{path}: material is no table.")
    try:
        return crazing.Material.from_table(table)
    except (TypeError, ValueError) as error:
        raise type(error)(f"{path}: {error}") from None
