"""Centrelines of polygons: closed forms, holes, forms of input, refusals."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz

BOX = [(0.0, 0.0), (8.0, 0.0), (8.0, 2.0), (0.0, 2.0)]


def circle(radius: float) -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    return radius * np.column_stack([np.cos(t), np.sin(t)])


def test_a_rectangle_has_a_segment_and_four_arms() -> None:
    line = cz.centerline(BOX, spacing=0.01)
    true = shapely.MultiLineString([[(1, 1), (7, 1)], [(0, 0), (1, 1), (0, 2)], [(8, 0), (7, 1), (8, 2)]])
    assert (line.components, line.leaves) == (1, 4)
    drawn = line.to_shapely()
    # The last vertex is half a step from the corner or nearer.
    assert drawn.hausdorff_distance(true) < 0.01
    assert max(true.distance(shapely.Point(p)) for p in line.vertices) < 0.02


def test_an_annulus_has_a_ring() -> None:
    line = cz.centerline((circle(3.0), [circle(1.0)]))
    np.testing.assert_allclose(np.hypot(*line.vertices.T), 2.0, atol=1e-3)
    assert (line.components, line.leaves, len(line.edges)) == (1, 0, len(line.vertices))


def test_a_neck_before_a_hole_is_no_hair() -> None:
    lobe = shapely.box(60.5, -0.7, 62, 0.7) - shapely.Point(61.2, 0).buffer(0.3)
    polygon = shapely.union_all([shapely.box(0, -30, 60, 30), shapely.box(59, -0.1, 61, 0.1), lobe])
    polygon = polygon - shapely.Point(61.2, 0).buffer(0.3)
    line = cz.centerline(polygon, spacing=0.05)
    assert shapely.Point(61.2, 0).within(shapely.convex_hull(line.to_shapely()))
    # The box has four arms; the lobe adds the ring round its hole.
    assert (line.components, line.leaves) == (1, 4)


def test_two_holes_are_walked_round() -> None:
    polygon = shapely.box(0, 0, 10, 4) - shapely.Point(3, 2).buffer(1) - shapely.Point(7, 2).buffer(1)
    line = cz.centerline(polygon)
    assert line.components == 1
    assert len(line.edges) - len(line.vertices) + 1 == 2
    assert polygon.buffer(1e-9).contains(line.to_shapely())


class Series:
    """What a GeoSeries of GeoPandas tells of itself."""

    def __init__(self, *shapes: Any) -> None:
        features = [{"type": "Feature", "geometry": s and s.__geo_interface__, "properties": {}} for s in shapes]
        self.__geo_interface__ = {"type": "FeatureCollection", "features": features}


def forms() -> dict[str, Any]:
    shape = shapely.Polygon(BOX)
    closed = [*BOX, BOX[0]]
    return {
        "shapely": shape,
        "mapping": shape.__geo_interface__,
        "feature": {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [closed]}},
        "heights": {"type": "Polygon", "coordinates": [[(x, y, 5.0) for x, y in closed]]},
        "multi": shapely.MultiPolygon([shape]),
        "shell and holes": (BOX, []),
        "clockwise": (shape.exterior.coords[::-1], []),
        "array": np.array(BOX),
        "closed list": closed,
        "collection": shapely.GeometryCollection([shape]),
        "series": Series(shape, None),
        "list of shapely": [shape],
        "array of shapely": np.array([shape]),
        "ring of shapely": shape.exterior,
        "list of rings": [BOX],
        "feature without geometry beside it": {
            "type": "FeatureCollection",
            "features": [{"type": "Feature", "geometry": None}, {"type": "Feature", "geometry": shape}],
        },
    }


@pytest.mark.parametrize("form", forms())
def test_every_form_of_a_polygon_is_taken(form: str) -> None:
    line = cz.centerline(forms()[form], spacing=0.1)
    assert line.length == pytest.approx(cz.centerline(BOX, spacing=0.1).length, rel=1e-9)


def test_what_mending_leaves_is_taken() -> None:
    # A spike out of the side of a box.
    spike = shapely.Polygon([(0, 0), (8, 0), (8, 1), (9, 1), (8, 1), (8, 2), (0, 2)])
    mended = shapely.make_valid(spike)
    assert {part.geom_type for part in mended.geoms} == {"Polygon", "LineString"}
    assert cz.centerline(mended, spacing=0.1).leaves == 4
    with pytest.raises(cz.DegenerateInputError, match="polygon is empty"):
        cz.centerline(shapely.GeometryCollection([shapely.Point(0, 0)]))


def test_a_thin_gap_is_resolved_whatever_the_spacing() -> None:
    polygon = shapely.box(0, 0, 10, 2) - shapely.box(1, 0.999, 9, 1.001)
    line = cz.centerline(polygon, spacing=1.0)
    assert line.components == 1
    assert len(line.edges) - len(line.vertices) + 1 == 1
    assert polygon.buffer(1e-6).contains(line.to_shapely())


@settings(max_examples=25, deadline=None)
@given(seed=st.integers(0, 10**6), corners=st.integers(3, 12))
def test_any_star_has_one_tree_inside(seed: int, corners: int) -> None:
    rng = np.random.default_rng(seed)
    turn = 2 * np.pi * (np.arange(corners) + 0.8 * rng.random(corners)) / corners
    shell = (rng.uniform(0.3, 1, corners) * [np.cos(turn), np.sin(turn)]).T
    polygon = shapely.Polygon(shell)
    line = cz.centerline(polygon)
    assert line.components == 1
    assert len(line.edges) == len(line.vertices) - 1
    assert polygon.buffer(1e-6).contains(line.to_shapely())


REFUSED: dict[str, tuple[Any, type[Exception], str]] = {
    "a bow": ([(0, 0), (4, 4), (4, 0), (0, 3)], cz.CrazingError, "boundary"),
    "an even bow": ([(0, 0), (4, 4), (4, 0), (0, 4)], cz.CrazingError, r"not plain: outline side .* crosses"),
    "overlapping parts": ([shapely.box(0, 0, 4, 1), shapely.box(2, 0, 6, 2)], cz.CrazingError, "not plain"),
    "a hole as large as the shell": ((BOX, [BOX]), cz.DegenerateInputError, "no area"),
    "no coordinates": ({"type": "Polygon"}, ValueError, "polygon is a Polygon whose coordinates are None"),
    "no ring": ({"type": "Polygon", "coordinates": [5]}, ValueError, "ring 0 of polygon is 5; a list of positions"),
    "no rings": ({"type": "MultiPolygon", "coordinates": [None]}, ValueError, "polygon 0 of polygon is None"),
    "a feature of nothing": ({"type": "Feature", "geometry": None}, cz.DegenerateInputError, "polygon is empty"),
    "a number": (7, TypeError, "polygon is 7; a polygon, a ring or a list"),
    "two points": ([(0, 0), (1, 1)], cz.DegenerateInputError, "ring 0 of polygon 0 has 2 distinct points; at least 3"),
    "one point": ([(1, 2)] * 5, cz.DegenerateInputError, "ring 0 of polygon 0 has 1 distinct point;"),
    "a flat hole": ((BOX, [[(1, 1), (2, 1)]]), cz.DegenerateInputError, "ring 1 of polygon 0 has 2 distinct points"),
    "a bad part": ([BOX, [(9, 9), (10, 9), (9, 9)]], cz.DegenerateInputError, "ring 0 of polygon 1 has 2 distinct"),
    "memory": (memoryview(np.zeros((3, 2))), TypeError, "polygon is <memory at"),
    "nothing": (shapely.Polygon(), cz.DegenerateInputError, "polygon is empty"),
    "flat": ([(0, 0), (1, 1), (2, 2)], cz.DegenerateInputError, "no area"),
    "nan": ([(0, 0), (1, 0), (float("nan"), 1)], cz.CrazingError, r"has \(nan, 1\.0\) in row 2; every .* finite"),
    "a line": (shapely.LineString(BOX), ValueError, "LineString"),
    "text": ("POLYGON", TypeError, "polygon is 'POLYGON'; a polygon, a ring or a list"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_polygon_is_refused(name: str) -> None:
    polygon, error, message = REFUSED[name]
    with pytest.raises(error, match=message):
        cz.centerline(polygon)


@pytest.mark.parametrize("spacing", [0, -1, float("nan"), 1e-12])
def test_spacings_that_cannot_be_are_refused(spacing: float) -> None:
    with pytest.raises(ValueError, match="spacing is"):
        cz.centerline(BOX, spacing=spacing)


def test_holes_are_holes_in_any_form() -> None:
    hole = [(3.0, 0.8), (5.0, 0.8), (5.0, 1.2), (3.0, 1.2)]
    expected = cz.centerline((BOX, [hole]), spacing=0.1)
    assert len(expected.edges) == len(expected.vertices)
    for form in ([BOX, hole], [hole, BOX], [[BOX, hole][::-1]][0], shapely.Polygon(BOX, [hole])):
        assert cz.centerline(form, spacing=0.1).length == pytest.approx(expected.length, rel=1e-6)


SQUARE = shapely.box(0, 0, 4, 4)
TOUCHING = {
    "a hole at a corner": shapely.Polygon(SQUARE.exterior, [[(0, 0), (2, 1), (1, 2)]]),
    "a hole at a side": shapely.Polygon(SQUARE.exterior, [[(2, 0), (3, 1), (1, 1)]]),
    "two holes": shapely.Polygon(
        shapely.box(0, 0, 9, 9).exterior, [[(2, 2), (4, 4), (2, 6)], [(4, 4), (6, 2), (6, 6)]]
    ),
    "two parts": shapely.MultiPolygon([SQUARE, shapely.box(4, 4, 8, 8)]),
}


@pytest.mark.parametrize("name", TOUCHING)
def test_rings_may_touch(name: str) -> None:
    polygon = TOUCHING[name]
    assert polygon.is_valid
    line = cz.centerline(polygon)
    # As many pieces as the inside has, and as many cycles as it has holes.
    inner = polygon.buffer(-1e-6)
    parts = list(getattr(inner, "geoms", [inner]))
    assert line.components == len(parts)
    assert len(line.edges) - len(line.vertices) + line.components == sum(len(part.interiors) for part in parts)
    assert polygon.buffer(1e-9).contains(line.to_shapely())


def test_neighbours_that_share_a_side_are_one() -> None:
    halves = cz.centerline(shapely.MultiPolygon([shapely.box(0, 0, 4, 2), shapely.box(4, 0, 8, 2)]), spacing=0.1)
    assert halves.length == pytest.approx(cz.centerline(BOX, spacing=0.1).length, rel=1e-6)


def test_a_spike_that_goes_and_comes_back_is_none() -> None:
    spiked = [(0, 0), (4, 0), (8, 0), (4, 0), (4, 4), (0, 4)]
    line, plain = (cz.centerline(ring, spacing=0.1).to_shapely() for ring in (spiked, SQUARE))
    assert line.hausdorff_distance(plain) < 0.2


def test_gaps_too_thin_to_be_told_apart_are_named() -> None:
    shape = [(0, 0), (1e6, 0), (1e6, 1), (0.1, 1e-9), (1e6, 1 + 1e-9), (1e6, 2), (0, 2)]
    with pytest.raises(cz.CrazingError, match="comes too near to itself"):
        cz.centerline(shape, spacing=1e5)


@pytest.mark.parametrize("exponent", [-1000, -400, 400, 1000])
@pytest.mark.filterwarnings("error")
def test_the_unit_of_length_does_not_matter(exponent: int) -> None:
    unit = 2.0**exponent
    line = cz.centerline(np.array(BOX) * unit, spacing=0.125 * unit)
    plain = cz.centerline(BOX, spacing=0.125)
    np.testing.assert_array_equal(line.vertices, plain.vertices * unit)
    np.testing.assert_array_equal(line.edges, plain.edges)


def test_points_far_from_the_origin_and_in_degrees() -> None:
    plain = cz.centerline(BOX, spacing=0.05).to_shapely()
    for scale, at in [(1.0, (5e5, 5e6)), (1e-5, (-71.05, 42.3))]:
        moved = cz.centerline(np.array(BOX) * scale + at, spacing=0.05 * scale).to_shapely()
        back = shapely.transform(moved, lambda places, scale=scale, at=at: (places - at) / scale)
        assert back.hausdorff_distance(plain) < 0.1


def test_small_polygons_have_points_of_their_own() -> None:
    parts = [shapely.box(0, 0, 4000, 400), *(shapely.Point(5000 + 40 * i, 0).buffer(3 + i, 3) for i in range(8))]
    shape = shapely.MultiPolygon(parts)
    line = cz.centerline(shape)
    assert line.components == len(parts)
    assert shape.buffer(1e-9).contains(line.to_shapely())


@pytest.mark.parametrize("spacing", [None, 0.1, 0.3])
def test_small_holes_along_the_shell_are_no_splinters_of_it(spacing: float | None) -> None:
    # A few points each, a few steps from a ring with ten times as many.
    side = 9
    places = [(x + 0.5, y + 0.5) for x in range(side) for y in range(side)]
    polygon = shapely.box(0, 0, side, side) - shapely.union_all(
        [shapely.box(x - 0.2, y - 0.2, x + 0.2, y + 0.2) for x, y in places]
    )
    line = cz.centerline(polygon, spacing=spacing)
    assert line.components == 1
    assert len(line.edges) - len(line.vertices) + 1 == side * side
    assert polygon.buffer(1e-9).contains(line.to_shapely())


def test_four_ends_just_as_wide_as_a_lobe_may_be_are_alike() -> None:
    # Every end spans a fortieth of the boundary, but for the last bit.
    cross = shapely.box(-5, -0.5, 5, 0.5) | shapely.box(-0.5, -5, 0.5, 5)
    for scale in (1, 3, 0.1):
        line = cz.centerline(shapely.affinity.scale(cross, scale, scale))
        assert (line.components, line.leaves) == (1, 4)


def in_polygon(line: cz.PlanarGraph, polygon: Any) -> bool:
    return bool(polygon.buffer(1e-9).contains(line.to_shapely()))


@pytest.mark.parametrize("gap", [1e-2, 1e-3, 1e-5, 1e-7])
def test_a_strait_far_narrower_than_points_are_apart_is_followed(gap: float) -> None:
    shell = [(0, 0), (9, 0), (9, 9), (0, 9)]
    square = shapely.Polygon(shell, [[(gap, 4), (2, 4), (2, 5), (gap, 5)]])
    askew = shapely.Polygon(shell, [[(gap, 4), (2, 4.3), (2, 5), (1, 4.7)]])
    for polygon in (square, askew):
        line = cz.centerline(polygon)
        assert in_polygon(line, polygon)
        assert (line.components, len(line.edges) - len(line.vertices) + 1) == (1, 1)
        # By a point opposite each that is there, not by points as near as the strait is wide.
        assert len(line.edges) < 1000


@pytest.mark.parametrize("width", [0.3, 1e-2, 1e-4])
def test_lakes_and_the_river_between_them_are_one(width: float) -> None:
    course = shapely.LineString([(0, 0), (30, 7), (41, -9), (80, 3)])
    lakes = [shapely.Point(place).buffer(9) for place in course.coords]
    polygon = shapely.union_all([*lakes, course.buffer(width / 2, cap_style="flat", join_style="mitre")])
    line = cz.centerline(polygon)
    assert in_polygon(line, polygon)
    assert (line.components, len(line.edges) - len(line.vertices)) == (1, -1)
    river = shapely.get_coordinates([course.interpolate(far) for far in np.linspace(10, 20, 99)])
    assert line.distances(river).max() < width
