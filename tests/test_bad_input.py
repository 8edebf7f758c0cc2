"""What the public functions make of every kind of points: faults, harmless forms, flat and odd places."""

from __future__ import annotations

import contextlib
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

import crazing as cz

CALLS: dict[str, Callable[[Any], Any]] = {
    "diagram": cz.diagram,
    "diagram periodic": lambda points: cz.diagram(points, period=(7.0, 5.0)),
    "maze periodic": lambda points: cz.maze(points, period=(7.0, 5.0), rng=1),
    "crust": cz.crust,
    "crust one-step": lambda points: cz.crust(points, method="one-step"),
    "crust gabriel": lambda points: cz.crust(points, method="gabriel"),
    "crust nn": lambda points: cz.crust(points, method="nn"),
    "medial_axis initial": lambda points: cz.medial_axis(points, method="initial"),
    "medial_axis edge-filter": lambda points: cz.medial_axis(points, method="edge-filter"),
    "medial_axis one-step": lambda points: cz.medial_axis(points, method="one-step"),
    "medial_axis poles": lambda points: cz.medial_axis(points, method="poles"),
    "curve": cz.curve,
    "prune": lambda points: cz.medial_axis(points, method="one-step").prune(),
    "poles": cz.poles,
    "nested": lambda points: cz.nested(points, iterations=2, method="one-step"),
    "compare": cz.compare,
    "maze voronoi": lambda points: cz.maze(points, cells="voronoi", rng=1),
    "maze delaunay": lambda points: cz.maze(points, cells="delaunay", rng=1),
    "maze within": lambda points: cz.maze(points, within=[(0, 0), (3.5, 0.5), (4, 4), (0.5, 3)], rng=1),
    "maze of triangles within": lambda points: cz.maze(
        points, cells="delaunay", within=[(0, 0), (3.5, 0.5), (4, 4), (0.5, 3)], rng=1
    ),
    "crack": lambda points: cz.crack(points, rng=1),
}
# Those that have an answer whatever the number of sites and their places.
LENIENT = ["diagram", "maze voronoi"]
STRICT = [
    name for name in CALLS if name.startswith(("crust", "curve", "prune", "medial_axis", "poles", "nested", "compare"))
]

NAN, INF = float("nan"), float("inf")
SQUARE = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0], [1.0, 2.0], [3.0, 2.5]]

FAULTS: dict[str, tuple[Any, type[Exception], str]] = {
    "nan": (
        [*SQUARE, [NAN, 2.0]],
        ValueError,
        r"points\[6\] is \(nan, 2\.0\); every coordinate must be finite",
    ),
    "inf": (
        [[0.0, INF], *SQUARE],
        ValueError,
        r"points\[0\] is \(0\.0, inf\); every coordinate must be finite",
    ),
    "-inf": ([*SQUARE, [-INF, 1.0]], ValueError, r"points\[6\] is \(-inf"),
    "flat": ([1.0, 2.0, 3.0], ValueError, r"points has shape \(3,\); \(n, 2\) is wanted"),
    "scalar": (1.0, ValueError, r"points has shape \(\); \(n, 2\) is wanted"),
    "three columns": (np.zeros((4, 3)), ValueError, r"points has shape \(4, 3\); \(n, 2\) is wanted"),
    "transposed": (np.zeros((2, 9)), ValueError, r"points has shape \(2, 9\)"),
    "cube": (np.zeros((4, 2, 2)), ValueError, r"points has shape \(4, 2, 2\)"),
    "empty cube": (np.zeros((0, 2, 2)), ValueError, r"points has shape \(0, 2, 2\)"),
    "ragged": ([[0.0, 0.0], [1.0]], ValueError, "points is ragged"),
    "text": ([["0", "1"], ["2", "3"]], TypeError, "points has dtype <U1; real numbers are wanted"),
    "bytes": (np.zeros((3, 2), dtype="S1"), TypeError, r"points has dtype \|S1; real numbers"),
    "a string": ("points", TypeError, "points (has dtype|is .points.; coordinates are wanted)"),
    "complex": (np.zeros((3, 2), dtype=complex), TypeError, "points has dtype complex128; real numbers"),
    "dates": (np.zeros((3, 2), dtype="M8[s]"), TypeError, "points has dtype datetime64"),
    "structured": (np.zeros(3, dtype=[("x", float), ("y", float)]), TypeError, "points has dtype"),
    "objects": (np.array([[object(), 1.0]]), TypeError, "points holds <object"),
    "text among objects": (
        np.array([["1", 2.0]], dtype=object),
        TypeError,
        "points holds '1'; a real number",
    ),
    "a dictionary": ({"x": 1}, TypeError, "points holds"),
    "a huge integer": ([[10**400, 0]], ValueError, "points holds an integer too large for a float"),
    "masked": (np.ma.masked_greater(SQUARE, 3.5), ValueError, "points has masked entries"),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("fault", FAULTS)
def test_faults_are_named(call: str, fault: str) -> None:
    points, error, message = FAULTS[fault]
    with pytest.raises(error, match=message):
        CALLS[call](points)


@pytest.mark.parametrize("call", [name for name in CALLS if name != "crack"])  # which may make its own points
@pytest.mark.parametrize("points", [None, [[None, 1.0], [2.0, 3.0]]])
def test_none_is_no_number(call: str, points: Any) -> None:
    with pytest.raises(TypeError, match="points holds None; a real number is wanted"):
        CALLS[call](points)


def read_only() -> np.ndarray:
    array = np.array(SQUARE)
    array.flags.writeable = False
    return array


@pytest.mark.parametrize("call", [*CALLS, "relax", "diagram with constraints"], ids=lambda name: name.replace(" ", "-"))
def test_a_diagram_is_as_good_as_its_points(call: str) -> None:
    calls = CALLS | {
        "relax": lambda points: cz.sample.relax(points, iterations=2, bounds=(0, 0, 4, 4)),
        "diagram with constraints": lambda points: cz.diagram(points, constraints=[(0, 2)]),
    }
    period = (7.0, 5.0) if "periodic" in call else None
    one, other = (calls[call](points) for points in (SQUARE, cz.diagram(SQUARE, period=period)))
    assert np.array_equal(one, other) if isinstance(one, np.ndarray) else one == other


FORMS: dict[str, Any] = {
    "list of tuples": [tuple(row) for row in SQUARE],
    "float32": np.array(SQUARE, dtype=np.float32),
    "float16": np.array(SQUARE, dtype=np.float16),
    "long double": np.array(SQUARE, dtype=np.longdouble),
    "objects": np.array(SQUARE, dtype=object),
    "big-endian": np.array(SQUARE, dtype=">f8"),
    "big-endian float32": np.array(SQUARE, dtype=">f4"),
    "Fortran order": np.asfortranarray(SQUARE),
    "strided": np.repeat(np.array(SQUARE), 3, axis=1)[:, ::3],
    "every second row": np.repeat(np.array(SQUARE), 2, axis=0)[::2],
    "reversed twice": np.array(SQUARE)[::-1].copy()[::-1],
    "unaligned": np.frombuffer(b"\0" + np.array(SQUARE).tobytes(), dtype="u1")[1:].view("f8").reshape(-1, 2),
    "read-only": read_only(),
    "mask without entries": np.ma.array(SQUARE, mask=False),
    "matrix of a subclass": np.array(SQUARE).view(type("Sub", (np.ndarray,), {})),
}


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_the_same_numbers_gives_the_same_diagram(form: str) -> None:
    before = np.array(FORMS[form], dtype=float)
    assert cz.diagram(FORMS[form]) == cz.diagram(SQUARE)
    assert np.array_equal(np.array(FORMS[form], dtype=float), before)


@pytest.mark.parametrize("dtype", ["i1", "u1", ">i2", "i4", "i8", "u8"])
def test_integers_are_numbers(dtype: str) -> None:
    rows = (2 * np.array(SQUARE)).astype(dtype)
    assert cz.diagram(rows) == cz.diagram(rows.astype(float))


def test_minus_zero_is_zero() -> None:
    d = cz.diagram([[-0.0, 0.0], [0.0, -0.0], [1.0, -0.0], [-0.0, 1.0]])
    assert d.site_of.tolist() == [0, 0, 1, 2]
    assert len(d.triangles) == 1


FLAT: dict[str, tuple[Any, int]] = {
    "empty list": ([], 0),
    "empty array": (np.empty((0, 2)), 0),
    "one": ([[3.0, 4.0]], 1),
    "two": ([[0.0, 0.0], [1.0, 1.0]], 2),
    "two and their copies": ([[0.0, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 1.0]], 2),
    "all equal": (np.ones((50, 2)), 1),
    "on a row": (np.column_stack([np.arange(9.0), np.zeros(9)]), 9),
    "on a column": (np.column_stack([np.zeros(9), np.arange(9.0)]), 9),
    "on a slope": (np.column_stack([np.arange(9.0), 3 * np.arange(9.0)]), 9),
    "on a far line": (np.column_stack([1e9 + np.arange(9.0), 1e9 + 2 * np.arange(9.0)]), 9),
}


@pytest.mark.parametrize("name", FLAT)
def test_sites_on_one_line_have_a_diagram_without_triangles(name: str) -> None:
    points, sites = FLAT[name]
    d = cz.diagram(points)
    assert (len(d.sites), len(d.site_of)) == (sites, len(points))
    assert d.triangles.shape == (0, 3)
    assert d.vertices.shape == (0, 2)
    assert d.edges.shape == (max(sites - 1, 0), 2)
    assert (d.dual_edges == -1).all()


@pytest.mark.parametrize("call", STRICT)
@pytest.mark.parametrize("name", FLAT)
def test_sites_on_one_line_have_no_crust_and_no_axis(call: str, name: str) -> None:
    message = "distinct sites?; at least 3 are needed|distinct sites lie on one line"
    with pytest.raises(cz.DegenerateInputError, match=message):
        CALLS[call](FLAT[name][0])


@pytest.mark.parametrize("name", [name for name, (_, sites) in FLAT.items() if sites])
def test_sites_on_one_line_have_a_maze(name: str) -> None:
    points, sites = FLAT[name]
    m = cz.maze(points, cells="voronoi", rng=1)
    assert m.passages.shape == (sites - 1, 2)
    assert m.open.all()


grid = np.array([[x, y] for x in range(5) for y in range(4)], dtype=float)
PLACES: dict[str, np.ndarray] = {
    "huge": grid * 1e300,
    "largest": grid / 4 * np.finfo(float).max,
    "subnormal": grid * 5e-324,
    "tiny": grid * 2.0**-900,
    "far away": grid + 2.0**40,
    "mixed magnitudes": np.array([[0, 0], [1e300, 0], [0, 1e-300], [1e-320, 1.0], [1.0, 1e20], [-1e200, -1e-200]]),
    "one far site": np.vstack([grid, [[1e300, 1e300]]]),
    "nearly on a line": np.column_stack([np.arange(20.0), np.arange(20) % 2 * 5e-324]),
}


@pytest.mark.parametrize("call", CALLS)
@pytest.mark.parametrize("place", PLACES)
def test_odd_places_give_an_answer_or_a_named_refusal(call: str, place: str) -> None:
    # Any other exception, InternalError among them, fails the test.
    with contextlib.suppress(cz.CrazingError):
        CALLS[call](PLACES[place])


@pytest.mark.parametrize("place", ["huge", "subnormal", "tiny", "far away"])
def test_a_moved_grid_keeps_its_triangles(place: str) -> None:
    try:
        d = cz.diagram(PLACES[place])
    except cz.CrazingError:
        pytest.skip("refused by name, which is allowed")
    assert len(d.triangles) == len(cz.diagram(grid).triangles)
    assert len(d.edges) == len(cz.diagram(grid).edges)


@cache
def crack() -> cz.Crack:
    return cz.crack(SQUARE, rng=1)


ABSURD: dict[str, tuple[Callable[[], Any], tuple[type[Exception], ...], str]] = {
    "render nothing": (lambda: cz.render(crack(), 0), (ValueError,), "size"),
    "render less than nothing": (lambda: cz.render(crack(), -5), (ValueError,), "size"),
    "render half a pixel": (lambda: cz.render(crack(), 0.5), (TypeError,), "size"),
    "render True": (lambda: cz.render(crack(), True), (TypeError,), "size"),
    "render 2^40": (lambda: cz.render(crack(), 2**40), (ValueError, MemoryError), "size"),
    "render 2^100": (lambda: cz.render(crack(), (8, 2**100)), (ValueError, MemoryError), "size"),
    "render three sizes": (lambda: cz.render(crack(), (8, 8, 8)), (ValueError,), "size has 3 entries"),
    "render on no thread": (lambda: cz.render(crack(), 8, threads=0), (ValueError,), "threads"),
    "render empty bounds": (lambda: cz.render(crack(), 8, bounds=(0, 0, 0, 1)), (ValueError,), "bounds"),
    "render nan bounds": (
        lambda: cz.render(crack(), 8, bounds=(0, 0, NAN, 1)),
        (ValueError,),
        r"bounds\[2\]",
    ),
    "minus one sample": (lambda: cz.sample.uniform(-1), (ValueError,), "n is -1"),
    "half a sample": (lambda: cz.sample.normal(0.5), (TypeError,), "n is 0.5; an integer is wanted"),
    "2^62 samples": (lambda: cz.sample.laplace(2**62), (ValueError, MemoryError), "n is"),
    "no scale": (lambda: cz.sample.normal(5, scale=NAN), (ValueError,), r"scale\[0\] is nan"),
    "a negative seed": (lambda: cz.sample.uniform(5, rng=-1), (ValueError,), "rng is -1"),
    "a seed of text": (lambda: cz.sample.uniform(5, rng="seven"), (TypeError, ValueError), "rng is 'seven'"),
    "no such first": (lambda: cz.compare(SQUARE, "best"), (ValueError,), "first is 'best'; one of"),
    "no such second": (
        lambda: cz.compare(SQUARE, "one-step", "two-pass"),
        (ValueError,),
        "second is 'two-pass'; one of",
    ),
    "no such method": (lambda: cz.crust(SQUARE, method="best"), (ValueError,), "method is 'best'; one of"),
    "no such cells": (lambda: cz.maze(SQUARE, cells="round"), (ValueError,), "cells is 'round'; one of"),
    "a period of nothing": (lambda: cz.diagram(SQUARE, period=(0, 1)), (ValueError,), "period is"),
    "half a period": (lambda: cz.diagram(SQUARE, period=(1,)), (ValueError,), "period has 1 entries"),
    "a period in one number": (lambda: cz.maze(SQUARE, period=1.0), (TypeError,), "period is 1.0"),
    "an endless period": (lambda: cz.maze(SQUARE, period=(1.0, INF)), (ValueError,), r"period\[1\]"),
    "an oblong period": (lambda: cz.diagram(SQUARE, period=(1e-9, 1e9)), (ValueError,), "side of the period"),
    "a period and bounds": (lambda: cz.maze(SQUARE, period=(9, 9), bounds=(0, 0, 1, 1)), (ValueError,), "bounds"),
    "another period": (
        lambda: cz.maze(cz.diagram(SQUARE, period=(9, 9)), period=(8, 8)),
        (ValueError,),
        r"period is \(8.0, 8.0\), that of the diagram",
    ),
    "a crust on a torus": (lambda: cz.crust(cz.diagram(SQUARE, period=(9, 9))), (ValueError,), "periodic"),
    "no such tree": (lambda: cz.maze(SQUARE, tree="oak"), (ValueError,), "tree is 'oak'; one of"),
    "no such source": (lambda: cz.maze(SQUARE, rng=1).distances(6), (ValueError,), "source"),
    "no such start": (lambda: cz.maze(SQUARE, start=99), (ValueError,), "start"),
    "an opening of less than nothing": (lambda: cz.crack(SQUARE, opening=-1.0), (ValueError,), "opening"),
    "an endless opening": (lambda: cz.crack(SQUARE, opening=INF), (ValueError,), "opening"),
}


@pytest.mark.parametrize("name", ABSURD)
def test_absurd_arguments_are_named(name: str) -> None:
    call, errors, message = ABSURD[name]
    with pytest.raises(errors, match=message):
        call()


def test_more_rows_than_indices_are_refused_before_memory_is_taken() -> None:
    # A view of one row: these 64 GiB exist only for who copies them.
    rows = np.broadcast_to(np.zeros((1, 2)), (2**32, 2))
    with pytest.raises(ValueError, match="points has 4294967296 rows"):
        cz.diagram(rows)


def test_bounds_too_wide_for_a_float_are_said_to_be() -> None:
    with pytest.raises(ValueError, match="a width and height that are floats are wanted"):
        cz.sample.uniform(3, bounds=(-1e308, 0, 1e308, 1))
