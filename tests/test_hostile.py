"""Points and arguments of stranger kinds: geometries, frames, things without a shape or an end."""

from __future__ import annotations

from collections.abc import Callable
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
    "a start beyond": (lambda: cz.maze(SQUARE, start=6), ValueError, "start is 6; the cell of one of 6"),
    "points by the milliard": (lambda: cz.sample.from_polygon(SQUARE[:4], n=10**9), ValueError, "n is 1000000000"),
    "steps of next to nothing": (
        lambda: cz.sample.from_polygon(SQUARE[:4], spacing=1e-300),
        ValueError,
        "spacing is 1e-300",
    ),
}


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
