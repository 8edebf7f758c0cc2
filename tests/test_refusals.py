"""What is no argument is refused in our own words: by steps, constructors and methods that are seldom called."""

from __future__ import annotations

import dataclasses
import inspect
import re
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest

import crazing as cz

VALUES: dict[str, Any] = {
    "nan": float("nan"),
    "infinite": float("inf"),
    "negative": -1,
    "huge": 2**200,
    "empty": [],
    "no rows": np.zeros((0, 2)),
    "three dimensions": np.zeros((2, 2, 2)),
    "text": "x",
    "None": None,
    "True": True,
    "objects": np.array([object()]),
    "ragged": [[1, 2], [3]],
    "complex": 1j,
    "date": np.array(["2020-01-01"], dtype="M8[D]"),
    "masked": np.ma.masked_all(3),
    "a dictionary": {"a": 1},
    "a class": object,
}

# What NumPy and Python say of things inside, which tells a caller nothing.
INTERNAL = re.compile(
    r"truth value|' object has no|unsupported operand|unpack|not iterable|not subscriptable|has no len|be real number"
    r"|broadcast|setting an array|could not convert|cannot convert|ufunc|cannot be interpreted|not supported between"
    r"|inhomogeneous|scalar index|[Cc]annot cast|invalid literal|unhashable|bytes-like|large to convert|expected str"
)

SITES = cz.diagram(cz.sample.uniform(20, rng=0))
MAZE = cz.maze(SITES, rng=0)
WALLS = cz.steps.walls(MAZE)
CRACK = cz.steps.widen(WALLS, width=0.01)
COMPARISON = cz.compare(cz.sample.uniform(12, rng=0))
TARGETS = cz.targets("painting-italian")
SHOWN = cz.texture(CRACK, 4, maps="all")
PLAN = cz.texture_plan(CRACK, 32)


def given(result: Any) -> dict[str, Any]:
    """What would make a result again."""
    return {field.name: getattr(result, field.name) for field in dataclasses.fields(result) if field.init}


STEP = {"drawing": WALLS}
CALLS: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {
    "steps.draw": (cz.steps.draw, {"graph": CRACK.graph}),
    "steps.walls": (cz.steps.walls, {"maze": MAZE}),
    "steps.split": (cz.steps.split, {"n": 5}),
    "steps.impact": (cz.steps.impact, {"n": 5}),
    "steps.follow": (cz.steps.follow, STEP | {"turn": 20}),
    "steps.part": (cz.steps.part, STEP | {"hairpin": 120, "reach": 2}),
    "steps.straighten": (cz.steps.straighten, STEP | {"rounds": 1}),
    "steps.stubs": (cz.steps.stubs, STEP | {"rate": 1, "length": 0.2, "unit": 0.2}),
    "steps.roughen": (cz.steps.roughen, STEP | {"roughness": 0.05, "unit": 0.2}),
    "steps.warp": (cz.steps.warp, STEP | {"amplitude": 0.01}),
    "steps.widen": (cz.steps.widen, STEP | {"width": 0.01}),
    "Crack": (cz.Crack, given(CRACK)),
    "PlanarGraph": (cz.PlanarGraph, given(CRACK.graph)),
    "Diagram": (cz.Diagram, given(SITES)),
    "Recipe": (cz.Recipe, {}),
    "Material": (cz.Material, {}),
    "Style": (cz.Style, {}),
    "Material.from_table": (cz.Material.from_table, {}),
    "Recipe.load": (cz.Recipe.load, {}),
    "TexturePlan.window": (PLAN.window, {"top": 0, "left": 0, "height": 4, "width": 4}),
    "Targets.limits": (TARGETS.limits, {}),
    "Targets.within": (TARGETS.within, {}),
    "Targets.measure": (TARGETS.measure, {}),
    "Comparison.plot": (COMPARISON.plot, {}),
    "PlanarGraph.plot": (CRACK.graph.plot, {}),
    "PlanarGraph.distances": (CRACK.graph.distances, {}),
    "QuadEdge.rot": (SITES.quad_edge.rot, {}),
    "Crack.shifted": (CRACK.shifted, {"dx": 0, "dy": 0}),
    "Maze.solve": (MAZE.solve, {"source": 0, "target": 3}),
    "save_png": (cz.save_png, {"path": "no folder/of this name.png", "image": np.zeros((2, 2), np.uint8)}),
    "Texture": (cz.Texture, given(SHOWN)),
    "Texture.save": (SHOWN.save, {"path": "maps"}),
    "write_texture": (cz.write_texture, {"crack": CRACK, "path": "mask.png", "size": 4, "maps": "mask"}),
    "shade": (cz.shade, {"texture": SHOWN}),
    "Dataset.write": (cz.dataset(1, size=4).write, {"folder": "pictures"}),
    "measure": (cz.measure, {"source": np.eye(9)}),
    "rerun": (cz.rerun, {"source": "no file of this name.png", "path": "nor this.png"}),
}


def parameters() -> Iterator[tuple[str, str]]:
    for name, (call, _) in CALLS.items():
        for parameter in inspect.signature(call).parameters.values():
            if parameter.kind not in (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL):
                yield name, parameter.name


@pytest.mark.parametrize(("name", "parameter"), list(parameters()))
def test_what_is_no_argument_is_refused_in_our_words(
    name: str, parameter: str, tmp_path: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    call, arguments = CALLS[name]
    # A generator is used up by the first that reads it.
    for value in (*VALUES.values(), (i for i in range(3))):
        try:
            call(**arguments | {parameter: value})
        except (TypeError, ValueError, OSError, cz.CrazingError) as error:
            assert str(error), type(error)
            assert not INTERNAL.search(str(error)), error


HANDMADE = {
    "a width for no edge": (cz.Crack, CRACK, {"width": np.zeros(3)}, ValueError, "width has shape"),
    "a width of text": (cz.Crack, CRACK, {"width": "x"}, TypeError, "width is 'x'; an array of float64"),
    "a strand of halves": (cz.Crack, CRACK, {"strand": 0.5}, TypeError, "strand is 0.5; an array of int32"),
    "no graph": (cz.Crack, CRACK, {"graph": None}, TypeError, "graph is None; a PlanarGraph"),
    "edges beyond 32 bits": (cz.Diagram, SITES, {"edges": [[0, 2**40]]}, ValueError, "entries that int32 holds"),
    "sites that are ragged": (cz.Diagram, SITES, {"sites": [[0, 1], [2]]}, ValueError, "sites is ragged"),
}


@pytest.mark.parametrize("case", HANDMADE)
def test_results_made_by_hand_are_checked(case: str) -> None:
    kind, result, change, error, message = HANDMADE[case]
    with pytest.raises(error, match=message):
        kind(**given(result) | change)


@pytest.mark.parametrize(
    "call",
    [
        lambda hide: cz.Crack(**given(CRACK) | {"width": hide(CRACK.width)}),
        lambda hide: cz.Crack(**given(CRACK) | {"strand": hide(CRACK.strand)}),
        lambda hide: cz.PlanarGraph(CRACK.graph.vertices, hide(CRACK.graph.edges)),
        lambda hide: cz.measure(hide(np.eye(9, dtype=bool))),
        lambda hide: cz.save_png("masked.png", hide(np.zeros((4, 4), np.uint8))),
        lambda hide: cz.sample.from_density(hide(np.ones((4, 4))), 5),
    ],
)
def test_what_lies_under_a_mask_is_not_read(call: Callable[[Any], Any]) -> None:
    with pytest.raises(ValueError, match="has masked entries; drop or fill them"):
        call(lambda array: np.ma.array(array, mask=np.arange(array.size).reshape(array.shape) == 1))


def test_a_width_that_is_not_a_number_is_named() -> None:
    width = CRACK.width.copy()
    width[3, 1] = np.nan
    broken = dataclasses.replace(CRACK, width=width)
    for show in (cz.render, cz.texture):
        with pytest.raises(cz.CrazingError, match=r"widths\[3\] holds NaN|width holds nan"):
            show(broken, 16)
