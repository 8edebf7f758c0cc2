"""Points and arguments of stranger kinds: geometries, frames, things without a shape or an end."""

from __future__ import annotations

import copy
import math
import multiprocessing
import pickle
from collections.abc import Callable
from dataclasses import replace
from itertools import count
from typing import Any

import numpy as np
import pytest
import shapely

import crazing as cz

NAN = float("nan")
SQUARE = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0], [3.0, 2.5]]


@pytest.mark.parametrize("geometry", ["MultiPoint", "LineString", "GeometryCollection"])
def test_geometries_are_points(geometry: str) -> None:
    made = {
        "MultiPoint": shapely.MultiPoint(SQUARE),
        "LineString": shapely.LineString([(x, y, 7.0) for x, y in SQUARE]),
        "GeometryCollection": shapely.GeometryCollection(list(shapely.points(SQUARE))),
    }[geometry]
    assert cz.diagram(made) == cz.diagram(SQUARE)


class Frame:
    """As much of a data frame as NumPy sees."""

    ndim = 2

    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return np.array(SQUARE, dtype)

    def __float__(self) -> float:
        return 0.5

    def __eq__(self, other: object) -> Any:
        return np.array(SQUARE) == other

    __hash__ = None  # type: ignore[assignment]


def test_frames_of_two_columns_are_points() -> None:
    assert cz.diagram(Frame()) == cz.diagram(SQUARE)


def itself() -> list[Any]:
    ring: list[Any] = []
    ring.append(ring)
    return ring


SEEDS: dict[str, Any] = {
    "a list of itself": itself(),
    "a fraction": 1.5,
    "True": True,
    "text": "seven",
    "lists": [[1, 2], [3]],
    "an array of no dimension": np.array(0.5),
}


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_no_seed_is_named(seed: str) -> None:
    for call in (lambda rng: cz.sample.uniform(3, rng=rng), lambda rng: cz.crack(SQUARE, rng=rng)):
        with pytest.raises((TypeError, ValueError), match=r"^rng is .*; an int >= 0, a numpy.random.Generator or None"):
            call(SEEDS[seed])


SHAPELESS: dict[str, tuple[Callable[[], Any], type[Exception], str]] = {
    "bounds without end": (lambda: cz.maze(SQUARE, bounds=count()), ValueError, "bounds has 5 entries"),
    "a frame as a word": (lambda: cz.crust(SQUARE, method=Frame()), ValueError, "method is "),
    "a row as a number": (lambda: cz.maze(SQUARE, opening=Frame()), TypeError, "opening is <"),
    "a number of one dimension": (lambda: cz.maze(SQUARE, opening=np.array([0.5])), TypeError, "opening is array"),
    "constraints by name": (lambda: cz.diagram(SQUARE, constraints={"a": 1}), ValueError, "constraints is {'a': 1}"),
    "constraints of themselves": (lambda: cz.diagram(SQUARE, constraints=itself()), ValueError, "constraints"),
    "a ragged place": (lambda: cz.sample.normal(3, loc=[[1, 2], [3]]), TypeError, r"loc\[0\] is \[1, 2\]"),
    "a picture of nothing": (lambda: cz.sample.from_image(np.zeros((3, 0))), ValueError, "image has 3 x 0 pixels"),
    "a ragged picture": (lambda: cz.sample.from_image([[1.0, 2.0], [3.0]]), ValueError, "image is ragged"),
    "a shape of no pixels": (lambda: cz.maze(SQUARE, within=np.zeros((3, 0))), ValueError, "within has 3 x 0 pixels"),
    "a number as a shape": (lambda: cz.maze(SQUARE, within=7), TypeError, "within is 7; a polygon"),
    "a far shape": (lambda: cz.maze(SQUARE, within=[(0, 0), (1e200, 0), (0, 1)]), ValueError, "less than 1e150"),
    "one size": (lambda: cz.compare_sizes(np.eye(9), 7), TypeError, "sizes is 7; a list"),
    "an axis of no number": (lambda: cz.compare(SQUARE, axis=np.full((1, 2, 2), NAN)), ValueError, "axis has an end"),
    "a way of no integers": (lambda: maze().save("o.svg", solution=[1.5]), TypeError, r"solution is \[1.5\]"),
    "a way of no cells": (lambda: maze().save("o.svg", solution=[2**63]), ValueError, "solution goes by cell"),
    "a way of none": (lambda: maze().plot(solution=None), TypeError, "solution is None"),
    "a page of too many pixels": (
        lambda: maze().save("o.png", page=(3000, 3000)),
        ValueError,
        r"page is \(3000.0, 3000.0\); at most 268435456 pixels are drawn",
    ),
    "a spacing of nothing": (lambda: cz.sample.from_polygon(SQUARE[:4], spacing=-0.0), ValueError, "spacing is 0"),
    "a plate of no colour": (lambda: cz.Material(plate=None), ValueError, "plate is None; a sequence"),
    "a title of no text": (lambda: maze().walls.to_svg(title=3), TypeError, "title is 3; a string"),
    "a colour of no text": (lambda: maze().walls.to_svg(stroke=None), TypeError, "stroke is None; a string"),
    "a maze that is measured": (
        lambda: cz.measure(maze()),
        TypeError,
        r"source is Maze\(.*; a Crack, a PlanarGraph or",
    ),
    "maps that are measured": (lambda: cz.measure(cz.texture(cz.crack(SQUARE), 8)), TypeError, "source is Texture"),
    "lines that are measured": (lambda: cz.measure(shapely.LineString(SQUARE)), TypeError, "source is <LINESTRING"),
    "a light on nothing": (lambda: cz.shade(None), TypeError, "texture is None"),
    "maps of no name": (lambda: cz.texture(cz.crack(SQUARE, rng=1), 8, maps=5), TypeError, "maps is 5"),
    "words of a picture": (
        lambda: cz.save_png("o.png", np.eye(3, dtype=np.uint8), text=5),
        TypeError,
        "text is 5; a mapping",
    ),
    "labels of no name": (lambda: cz.dataset(2, labels=None), TypeError, "labels is None; one name or more"),
    "bounds without an area": (
        lambda: cz.crack(n=9, bounds=(0, 0, 5e-324, 5e-324), rng=1),
        ValueError,
        r"bounds is \(0.0, 0.0, 5e-324, 5e-324\); coordinates of at most 1e\+60 and sides of at least 1e-60",
    ),
    "a density for points": (lambda: cz.crack(SQUARE, density=np.eye(3)), ValueError, "density is given, and points"),
    "a density of an impact": (
        lambda: cz.crack(preset="glass-impact", density=np.eye(3)),
        ValueError,
        "density is given, and the generator is 'impact'",
    ),
    "a density of another shape": (
        lambda: cz.crack(n=9, density=lambda x, y: np.ones(3)),
        ValueError,
        r"density gave shape \(3,\) for x and y of shape \(192, 192\)",
    ),
    "a density of no number": (
        lambda: cz.crack(n=9, density=lambda x, y: np.where(x < 0.5, NAN, y)),
        cz.CrazingError,
        r"density is nan at \(0\.0026.*, 0\.997.*\); a finite number of at least 0",
    ),
    "a density below 0": (
        lambda: cz.crack(n=9, density=lambda x, y: x - 0.5),
        cz.CrazingError,
        r"density is -0\.49.* at \(0\.0026.*, 0\.997",
    ),
    "pixels below 0": (
        lambda: cz.sample.from_density([[1.0, 2.0], [0.0, -3.0]], 5),
        cz.CrazingError,
        r"image\[1, 1\] is -3\.0; no pixel may be negative",
    ),
    "a picture of density below 0": (
        lambda: cz.crack(n=9, density=[[1.0, 2.0], [-1.0, 3.0]]),
        cz.CrazingError,
        r"density\[1, 0\] is -1\.0; no pixel may be negative",
    ),
    "a path of one point": (lambda: cz.sample.from_svg("M0 0"), ValueError, "the outline is empty"),
    "a path of no text": (lambda: cz.sample.from_svg(5), TypeError, "source is 5; the name of a file"),
    "rings on one another": (
        lambda: cz.maze(SQUARE, within=[SQUARE[:3], SQUARE[:3]]),
        cz.CrazingError,
        "within has nothing inside: its rings lie on one another",
    ),
    "a recipe without a name": (lambda: cz.Recipe().save(None), TypeError, "path is None; the name of a file"),
    "a page without a name": (lambda: maze().save(None), TypeError, "path is None; the name of a file"),
    "maps without a name": (
        lambda: cz.texture(cz.crack(SQUARE), 8).save(5),
        TypeError,
        "path is 5; the name of a file",
    ),
    "a start beyond": (lambda: cz.maze(SQUARE, start=6), ValueError, "start is 6; the cell of one of 6"),
    "points by the milliard": (lambda: cz.sample.from_polygon(SQUARE[:4], n=10**9), ValueError, "n is 1000000000"),
    "steps of next to nothing": (
        lambda: cz.sample.from_polygon(SQUARE[:4], spacing=1e-300),
        ValueError,
        "spacing is 1e-300",
    ),
}


def maze() -> cz.Maze:
    return cz.maze(SQUARE, rng=1)


def big(unit: float) -> cz.PlanarGraph:
    return cz.PlanarGraph(unit * np.array(SQUARE), [(0, 1), (1, 2)])


# Where areas are computed. Bounds in which nothing is but cut, and points, may be as large as floats are.
AREAS: dict[str, Callable[[float], Any]] = {
    "poisson_disk": lambda unit: cz.sample.poisson_disk(unit / 5, bounds=(0, 0, unit, unit), rng=1),
    "poisson_disk, torus": lambda unit: cz.sample.poisson_disk(unit / 5, period=(unit, unit), rng=1),
    "relax": lambda unit: cz.sample.relax(unit * np.array(SQUARE), iterations=1, bounds=(0, 0, unit, unit)),
    "relax, torus": lambda unit: cz.sample.relax(
        unit * np.array(SQUARE) / 8, iterations=1, bounds=(0, 0, unit, unit), period=(unit, unit)
    ),
    "crack": lambda unit: cz.crack(n=20, bounds=(-unit, 0, unit, unit), rng=1),
    "crack, torus": lambda unit: cz.crack(n=20, period=(unit, unit), rng=1),
    "crack, points": lambda unit: cz.crack(unit * np.array(SQUARE), rng=1),
    "preset": lambda unit: cz.crack(preset="glaze", bounds=(0, 0, unit, unit), rng=1),
    "impact": lambda unit: cz.crack(preset="glass-impact", period=(unit, unit), rng=1),
    "split": lambda unit: cz.steps.split(9, bounds=(0, 0, unit, unit), rng=1),
    "draw": lambda unit: cz.steps.draw(big(unit)),
    "measure": lambda unit: cz.measure(big(unit)),
    "measure, bounds": lambda unit: cz.measure(big(unit), bounds=(0, 0, unit, unit)),
    "texture": lambda unit: cz.texture(cz.crack(n=20, rng=1), 8, bounds=(0, 0, unit, unit)),
    "texture, crack": lambda unit: cz.texture(cz.Crack(big(unit), unit / 9, 0, 0, (0, 0, unit, unit)), 8, maps="mask"),
}


@pytest.mark.parametrize("unit", [1e200, 1e300, 1e-200, 1e-300])
@pytest.mark.parametrize("name", AREAS)
@pytest.mark.filterwarnings("error")
def test_too_wide_and_too_narrow_is_said_in_one_way(name: str, unit: float) -> None:
    limits = r"1e\+30 and sides of at least 1e-30" if "texture" in name else r"1e\+60 and sides of at least 1e-60"
    with pytest.raises(ValueError, match=rf"(bounds|period|points|edges) is \(.*e[-+].*\); coordinates of .* {limits}"):
        AREAS[name](unit)


@pytest.mark.parametrize("name", [name for name in AREAS if name != "texture"])
@pytest.mark.filterwarnings("error")
def test_far_from_one_is_not_too_far(name: str) -> None:
    limit = 1e29 if "texture" in name else 1e59
    assert AREAS[name](limit) is not None
    assert AREAS[name](1 / limit) is not None


@pytest.mark.parametrize("radius", [1e-200, 1e200])
def test_a_radius_without_a_square_is_named(radius: float) -> None:
    with pytest.raises(cz.CrazingError, match=r"radius is 1e-?200; a positive number whose square is a float"):
        cz.sample.poisson_disk(radius)


def test_a_radius_too_small_for_the_bounds_is_told_why() -> None:
    with pytest.raises(
        cz.CrazingError, match=r"radius is 1e-6; so near .* more than 90 million points have room; a larger"
    ):
        cz.sample.poisson_disk(1e-6)


@pytest.mark.parametrize("name", SHAPELESS)
@pytest.mark.filterwarnings("error")
def test_what_has_no_shape_is_named(name: str) -> None:
    call, error, message = SHAPELESS[name]
    with pytest.raises(error, match=message):
        call()


def test_what_grows_is_stopped_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("crazing.skeleton.MOST", 1000)
    with pytest.raises(cz.CrazingError, match=r"skeleton 3 would have [0-9]+ points; at most 1000"):
        cz.nested(cz.sample.uniform(60, rng=1), iterations=10**9)


def test_nothing_is_left_to_go_back() -> None:
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    skeleton = cz.medial_axis(np.column_stack([2 * np.cos(t), np.sin(t)]), method="one-step")
    assert skeleton.prune(retract=10**9) == skeleton.prune(retract=1000)


@pytest.mark.parametrize("size", [1, 2, 3, 4, 5, 7, 8, 9, (9, 1), (1, 9), (3, 40), (40, 3)])
def test_textures_of_few_pixels(size: int | tuple[int, int]) -> None:
    crack = cz.crack(cz.sample.uniform(40, rng=3), bounds=(0, 0, 1, 1), rng=1)
    mask = cz.texture(crack, size, maps="mask")["mask"]
    assert mask.shape == (size if isinstance(size, tuple) else (size, size))
    # A window of the large picture whose pixels are these would show the same ink, about.
    assert 0 < mask.mean() < 255


def test_endless_statistics_are_written_and_not_measured() -> None:
    found = cz.measure(np.random.default_rng(0).random((20, 20)))
    assert math.isnan(found.box_dimension)
    assert "inf" in repr(replace(found, box_dimension=math.inf))


def results() -> list[Any]:
    points = cz.sample.uniform(30, rng=1)
    crack, m = cz.crack(points, rng=1), cz.maze(points, rng=1)
    made = [m, m.diagram, m.walls, m.statistics, m.diagram.quad_edge, cz.medial_axis(points), cz.compare(points), crack]
    made += [
        cz.maze(points, within=[(0, 0), (1, 0), (0.5, 1)], rng=1),
        cz.preset("mud-mature"),
        cz.Style(),
        cz.Material(),
    ]
    made += [cz.texture(crack, 8), cz.texture_plan(crack, 8), cz.dataset(3, size=32), cz.targets("asphalt-crack")]
    return [*made, cz.measure(crack), cz.steps.split(5, rng=1)]


def test_results_are_equal_to_their_copies() -> None:
    for result in results():
        for made in (copy.copy(result), copy.deepcopy(result), pickle.loads(pickle.dumps(result))):
            assert (made == result) is True
            assert (made != result) is False
        assert (result == 5) is False
        assert repr(result)


def test_copies_of_textures_are_read_only() -> None:
    shown = cz.texture(cz.crack(SQUARE, rng=1), 8, maps="all")
    for made in (copy.copy(shown), copy.deepcopy(shown), pickle.loads(pickle.dumps(shown))):
        assert not any(array.flags.writeable for array in made.values())


def test_textures_that_differ_are_not_equal() -> None:
    crack = cz.crack(SQUARE, rng=1)
    assert cz.texture(crack, 8, seed=1) != cz.texture(crack, 8, seed=2)
    assert cz.texture(crack, 8, maps="mask") != cz.texture(crack, 8, maps="height")


def test_what_was_forked_goes_on() -> None:
    cz.maze(cz.sample.uniform(40_000, rng=1), rng=1)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        found = pool.map(forked, [1, 1])
    assert found[0] == found[1] == forked(1)


def forked(seed: int) -> float:
    return cz.maze(cz.sample.uniform(40_000, rng=seed), rng=seed).walls.length
