"""Arms of centrelines: how far they run, and which dead ends have one."""

from __future__ import annotations

from typing import Any

import networkx as nx
import numpy as np
import pytest
import shapely
import shapely.affinity
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz


def tips(line: cz.PlanarGraph) -> np.ndarray:
    """The free ends, from left to right."""
    ends = line.vertices[line.degrees == 1]
    return np.asarray(ends[np.argsort(ends[:, 0])])


def cycles(line: cz.PlanarGraph) -> int:
    return len(line.edges) - len(line.vertices) + line.components


def astray(line: cz.PlanarGraph, true: Any) -> float:
    """How far a line leaves the true one."""
    return float(shapely.distance(shapely.points(line.vertices), true).max())


def missed(line: cz.PlanarGraph, true: Any) -> float:
    """How far the true line leaves a line."""
    return float(line.distances(shapely.get_coordinates(shapely.segmentize(true, true.length / 999))).max())


@pytest.mark.parametrize("length", [20, 40, 100, 1000])
@pytest.mark.parametrize("turn", [0.0, 33.0])
@pytest.mark.parametrize("unit", [1.0, 1e-4])
def test_a_corridor_is_followed_to_where_the_ways_into_its_corners_part(length: int, turn: float, unit: float) -> None:
    def placed(shape: Any) -> Any:
        return shapely.affinity.scale(shapely.affinity.rotate(shape, turn, origin=(0, 0)), unit, unit, origin=(0, 0))

    line = cz.centerline(placed(shapely.box(0, 0, length, 1)))
    true = placed(shapely.LineString([(0.5, 0.5), (length - 0.5, 0.5)]))
    assert (line.components, line.leaves) == (1, 2)
    # A step of the boundary is an eighth of a width or more.
    assert max(astray(line, true), missed(line, true)) < 0.15 * unit
    assert line.length == pytest.approx(true.length, abs=0.2 * unit)


@pytest.mark.parametrize("length", [4, 20, 100, 1000])
def test_a_round_end_is_followed_to_its_middle(length: int) -> None:
    course = shapely.LineString([(0, 0), (length, 0)])
    line = cz.centerline(course.buffer(0.5))
    np.testing.assert_allclose(tips(line), course.coords, atol=1e-3)
    assert line.length == pytest.approx(length, abs=2e-3)


@pytest.mark.parametrize("angle", [2, 10, 45, 90, 110])
def test_a_single_corner_is_run_into(angle: float) -> None:
    # A wedge that ends in an arc about its corner.
    turn = np.radians(np.linspace(-angle / 2, angle / 2, 200))
    wedge = shapely.Polygon([(0, 0), *np.column_stack([10 * np.cos(turn), 10 * np.sin(turn)])])
    line = cz.centerline(wedge)
    assert wedge.buffer(1e-9).contains(line.to_shapely())
    spacing = wedge.length / 400
    assert np.hypot(*tips(line).T).min() < 2 * spacing


@pytest.mark.parametrize(("wide", "deep"), [(0.5, 0.3), (0.3, 0.1), (0.2, 0.2)])
def test_niches_hold_no_tip_up(wide: float, deep: float) -> None:
    corridor = shapely.box(0, 0, 200, 1)
    niches = [shapely.box(x, -deep, x + wide, 0.5) for x in np.arange(2, 198, 3.3)]
    niches += [shapely.box(x, 0.5, x + wide, 1 + deep) for x in np.arange(3, 198, 4.1)]
    line = cz.centerline(shapely.union_all([corridor, *niches]))
    assert line.leaves == 2
    np.testing.assert_allclose(tips(line), [(0.5, 0.5), (199.5, 0.5)], atol=0.15)


@pytest.mark.parametrize("angle", [58, 70, 80, 90])
def test_an_end_that_is_cut_askew_is_an_end(angle: float) -> None:
    askew = 1 / np.tan(np.radians(angle))
    polygon = shapely.Polygon([(0, 0), (100 + askew, 0), (100, 1), (-askew, 1)])
    line = cz.centerline(polygon)
    assert line.leaves == 2
    # Where the disc touches both sides and the end; in a corner it would be smaller.
    np.testing.assert_allclose(polygon.exterior.distance(shapely.points(tips(line))), 0.5, atol=0.05)


def test_a_flat_corner_is_none() -> None:
    # The ends are as wide as the middle, but for a gable of 150 degrees.
    high = 0.5 / np.tan(np.radians(75))
    gabled = shapely.Polygon([(-high, 0.5), (0, 0), (60, 0), (60 + high, 0.5), (60, 1), (0, 1)])
    x, y = tips(cz.centerline(gabled)).T
    np.testing.assert_allclose(y, 0.5, atol=0.02)
    assert 0.3 < x[0] < 0.7
    assert 59.3 < x[1] < 59.7


@pytest.mark.parametrize("corners", [3, 4, 5, 6, 8, 12])
def test_ends_that_are_alike_have_arms_alike(corners: int) -> None:
    turn = 2 * np.pi * np.arange(corners) / corners
    line = cz.centerline(np.column_stack([np.cos(turn), np.sin(turn)]), spacing=2.001 * np.sin(np.pi / corners) / 64)
    far = np.hypot(*tips(line).T)
    assert len(far) == corners
    np.testing.assert_allclose(far, far[0], rtol=1e-6)


def even(outline: np.ndarray, count: int) -> np.ndarray:
    ring = shapely.LinearRing(outline)
    return np.asarray(shapely.get_coordinates(ring.interpolate(np.arange(count) / count, normalized=True)))


@pytest.mark.parametrize("flat", [0.5, 0.3, 0.2])
@pytest.mark.parametrize("seed", range(3))
def test_noise_leads_no_tip_astray(flat: float, seed: int) -> None:
    turn = np.linspace(0, 2 * np.pi, 5000)
    points = even(np.column_stack([np.cos(turn), flat * np.sin(turn)]), 2000)
    spacing = float(np.hypot(*(points[1] - points[0])))
    points += 0.25 * spacing * np.random.default_rng(seed).uniform(-1, 1, points.shape)
    line = cz.centerline(points, spacing=1.0)
    # The axis of an ellipse ends at the centres of curvature of its ends.
    true = shapely.LineString([(flat**2 - 1, 0), (1 - flat**2, 0)])
    assert line.leaves == 2
    assert astray(line, true) < spacing
    assert missed(line, true) < 8 * spacing


def star(seed: int) -> np.ndarray:
    rng = np.random.default_rng(seed)
    corners = int(rng.integers(3, 12))
    turn = 2 * np.pi * (np.arange(corners) + 0.8 * rng.random(corners)) / corners
    return np.asarray((rng.uniform(0.2, 1, corners) * [np.cos(turn), np.sin(turn)]).T)


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10**6), first=st.integers(0, 11), turn=st.floats(0, 360), exponent=st.integers(-60, 60))
def test_neither_start_nor_direction_nor_place_matters(seed: int, first: int, turn: float, exponent: int) -> None:
    corners, unit = star(seed), 2.0**exponent
    plain = cz.centerline(corners, elongation=1.0)
    turned = shapely.affinity.rotate(shapely.Polygon(np.roll(corners, first, axis=0)[::-1]), turn, origin=(0, 0))
    other = cz.centerline(shapely.affinity.scale(turned, unit, unit, origin=(0, 0)), elongation=1.0)
    assert (other.components, other.leaves) == (plain.components, plain.leaves)
    back = shapely.affinity.scale(other.to_shapely(), 1 / unit, 1 / unit, origin=(0, 0))
    back = shapely.affinity.rotate(back, -turn, origin=(0, 0))
    # No more than a few steps of the boundary, by the last bit.
    assert back.hausdorff_distance(plain.to_shapely()) < 0.05


def test_what_touches_grows_as_well() -> None:
    # A hole that touches a side, near one end of a corridor.
    polygon = shapely.Polygon(shapely.box(0, 0, 100, 1).exterior, [[(2, 0), (2.4, 0.5), (1.6, 0.5)]])
    assert polygon.is_valid
    line = cz.centerline(polygon)
    assert tips(line)[-1] == pytest.approx((99.5, 0.5), abs=0.1)


@pytest.mark.parametrize("width", [2.0, 5.0])
@pytest.mark.parametrize("elongation", [0.5, 1.0, 2.0, 7.5])
def test_an_alley_stays_from_the_length_asked_for(width: float, elongation: float) -> None:
    for by, leaves in [(0.99, 2), (1.0, 3), (1.01, 3)]:
        # Off a street so long that the alley spans next to nothing of its outline.
        polygon = shapely.box(-3000, -8, 3000, 0) | shapely.box(0, 0, width, by * elongation * width)
        line = cz.centerline(polygon, spacing=width / 8, elongation=elongation)
        assert line.leaves == leaves
        if leaves == 3:
            # On along the alley, to where its two corners part.
            tip = tips(line)[1]
            assert tip == pytest.approx((width / 2, by * elongation * width - width / 2), abs=0.1 * width)
    assert cz.centerline(polygon).leaves == 2


def town(seed: int, cap: str) -> tuple[nx.Graph, list[Any], Any]:
    """Streets of a town as a graph, its dead ends as lines from the mouth on, and its polygon."""
    rng = np.random.default_rng(seed)
    side, width, count = 100.0, 6.0, 20
    streets = nx.grid_2d_graph(4, 4)
    at = {node: side * np.array(node) + rng.uniform(-12, 12, 2) for node in streets}
    lines = [shapely.LineString([at[a], at[b]]) for a, b in streets.edges]
    dead: list[Any] = []
    while len(dead) < count:
        street = lines[rng.integers(len(streets.edges))]
        foot = shapely.get_coordinates(street.interpolate(rng.uniform(0.25, 0.75), normalized=True))[0]
        turn, length = rng.uniform(0, 2 * np.pi), rng.uniform(15, 60)
        way = np.array([np.cos(turn), np.sin(turn)])
        along = np.diff(shapely.get_coordinates(street), axis=0)[0]
        far = shapely.LineString([foot + 9 * way, foot + (length + width) * way])
        if abs(along @ way) < 0.5 * np.hypot(*along) and far.distance(shapely.union_all(lines)) > 1.2 * width:
            dead.append(shapely.LineString([foot, foot + length * way]))
            lines.append(dead[-1])
    crossings = [shapely.Point(place).buffer(width / 2) for place in at.values()]
    return streets, dead, shapely.union_all([*crossings, *(line.buffer(width / 2, cap_style=cap) for line in lines)])


@pytest.mark.parametrize("cap", ["flat", "square", "round"])
@pytest.mark.parametrize("seed", range(2))
def test_every_dead_end_of_a_town_is_found_and_none_else(seed: int, cap: str) -> None:
    streets, dead, polygon = town(seed, cap)
    plain, line = (cz.centerline(polygon, residual=0.2, elongation=least) for least in (None, 1.0))
    assert plain.leaves < len(dead) == line.leaves
    loops = len(streets.edges) - len(streets) + 1
    assert (line.components, cycles(line), len(polygon.interiors)) == (1, loops, loops)
    ends = shapely.MultiPoint([alley.coords[1] for alley in dead])
    assert shapely.MultiPoint(tips(line)).hausdorff_distance(ends) < 5
    assert polygon.buffer(1e-9).contains(line.to_shapely())


def test_a_larger_part_of_the_ring_leaves_less() -> None:
    whole, *less = (cz.centerline(star(3), residual=part) for part in (0, 0.01, 0.1, 0.3))
    # Everything inside: an arm at every point of the boundary that is a corner, and no more is possible.
    assert whole.length > less[0].length > less[1].length > less[2].length > 0
    assert cz.centerline(star(3), residual=0.3, elongation=0) == whole


@pytest.mark.parametrize("name", ["residual", "elongation"])
@pytest.mark.parametrize("value", [-0.1, float("nan"), float("inf")])
def test_limits_that_cannot_be_are_refused(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"{name} is"):
        cz.centerline(star(0), **{name: value})


def test_half_a_ring_is_spanned_by_nothing() -> None:
    with pytest.raises(ValueError, match=r"residual is 0.5; a part of a ring below 0.5 is wanted"):
        cz.centerline(star(0), residual=0.5)
    with pytest.raises(TypeError, match="elongation is True"):
        cz.centerline(star(0), elongation=True)
