"""Mazes within a shape, with Shapely as the witness."""

from __future__ import annotations

from typing import Any

import networkx as nx
import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

import crazing as cz


def star(corners: int, low: float, high: float, at: tuple[float, float] = (0.5, 0.5)) -> np.ndarray:
    turn = np.linspace(0, 2 * np.pi, 2 * corners, endpoint=False) + 0.1
    radius = np.where(np.arange(2 * corners) % 2, low, high)
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn)]) + at


HOLED = [star(7, 0.25, 0.5), star(5, 0.04, 0.1)]


def polygon(rings: list[np.ndarray]) -> Any:
    return shapely.Polygon(rings[0], rings[1:])


@settings(max_examples=40, deadline=None)
@given(n=st.integers(3, 400), corners=st.integers(3, 60), seed=st.integers(0, 10**6), hole=st.booleans())
def test_walls_and_doors_are_shapelys_intersection(n: int, corners: int, seed: int, hole: bool) -> None:
    rings = [star(corners, 0.2, 0.48), *([star(4, 0.05, 0.1)] if hole else [])]
    shape = polygon(rings)
    d = cz.diagram(cz.sample.uniform(n, rng=seed))
    m = cz.maze(d, within=rings, rng=seed)
    whole = d.voronoi((-9, -9, 9, 9))
    everything = cz.maze(d, within=rings, opening=0, rng=seed)
    inner = everything.walls.length - shape.length if not everything.ends else None
    expected = shapely.intersection(shapely.linestrings(whole.segments), shape)
    assert inner == pytest.approx(shapely.length(expected).sum(), rel=1e-9, abs=1e-9)
    shut = shapely.union_all(shapely.linestrings(m.walls.segments))
    assert shape.buffer(1e-9).covers(shut)
    assert not m.open[(shapely.distance(shapely.points(d.sites[d.edges[:, 0]]), shape) > 1.5)].any()


def test_every_piece_of_a_large_maze_is_reached() -> None:
    shape = polygon(HOLED)
    m = cz.maze(cz.sample.uniform(3000, rng=1), within=shape, rng=1)
    inside = np.flatnonzero(shapely.contains_xy(shape, *m.diagram.sites.T))
    assert (m.distances()[inside] >= 0).all()
    entrance, exit_ = m.ends
    assert {entrance, exit_} <= set(m.rim.tolist())
    away = m.distances(entrance)
    assert away[exit_] == max(m.distances(cell)[m.rim].max() for cell in m.rim.tolist())
    assert len(m.solve(entrance, exit_)) == away[exit_] + 1


@pytest.mark.parametrize("opening", [0.5, 0.8, 0.9])
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_ways_through_parted_mazes_cross_the_part_with_most_of_the_outline(opening: float, seed: int) -> None:
    m = cz.maze(cz.sample.uniform(600, rng=seed), within=polygon(HOLED), opening=opening, rng=seed)
    graph = nx.Graph(m.sides[m.plan.open if m.plan else m.open].tolist())
    shares = [part & set(m.rim.tolist()) for part in nx.connected_components(graph)]
    largest = max(len(share) for share in shares)
    entrance, exit_ = m.ends
    assert any({entrance, exit_} <= share and len(share) == largest for share in shares)
    assert nx.shortest_path_length(graph, entrance, exit_) == len(m.solve(entrance, exit_)) - 1
    assert m.statistics.solution > 1


def test_the_outline_has_a_gap_at_entrance_and_exit() -> None:
    ring = star(200, 0.45, 0.5)
    m = cz.maze(cz.sample.uniform(800, rng=2), within=ring, rng=2)
    shut = shapely.union_all(shapely.linestrings(m.walls.segments))
    outline = shapely.Polygon(ring).exterior
    gap = shapely.difference(outline, shut.buffer(1e-9))
    cells = [
        int(np.linalg.norm(m.diagram.sites - (part.centroid.x, part.centroid.y), axis=1).argmin()) for part in gap.geoms
    ]
    # A cell that the outline cuts has further parts, of the same site.
    site = [*range(len(m.diagram.sites)), *m.plan.parts.tolist()]
    assert set(cells) == {site[end] for end in m.ends}


FORMS = {
    "rings": HOLED,
    "shapely": polygon(HOLED),
    "GeoJSON": shapely.geometry.mapping(polygon(HOLED)),
    "feature": {"type": "Feature", "geometry": shapely.geometry.mapping(polygon(HOLED))},
    "several": shapely.MultiPolygon([polygon(HOLED)]),
}


@pytest.mark.parametrize("form", FORMS)
def test_every_form_of_a_shape_is_the_same(form: str) -> None:
    d = cz.diagram(cz.sample.uniform(300, rng=4))
    walls = cz.maze(d, within=FORMS[form], rng=4).walls
    assert walls.length == pytest.approx(cz.maze(d, within=HOLED, rng=4).walls.length)


def test_pictures_are_shapes() -> None:
    y, x = np.mgrid[:60, :80]
    disc = (x - 40) ** 2 + (y - 30) ** 2 < 25**2
    points = cz.sample.uniform(300, bounds=(0, 0, 80, 60), rng=1)
    mask = cz.maze(points, within=disc, rng=1)
    dark = cz.maze(points, within=np.where(disc, 0, 255).astype(np.uint8), rng=1)
    bright = cz.maze(points, within=disc.astype(float), rng=1)
    assert mask == dark == bright
    assert mask.bounds == pytest.approx((15.5, 4.5, 65.5, 54.5), abs=1)
    everything = cz.maze(points, within=np.ones((60, 80), dtype=bool), rng=1)
    assert everything.bounds == pytest.approx((0, 0, 80, 60), abs=0.5)


def test_corners_on_the_sides_of_a_grid() -> None:
    # Every wall of the squares ends on the outline, or runs along it.
    points = [(x + 0.5, y + 0.5) for x in range(6) for y in range(6)]
    m = cz.maze(points, within=[(0, 0), (6, 0), (6, 6), (0, 6)], rng=1)
    assert len(m.passages) == 35
    inner = cz.maze(points, within=[(1, 1), (5, 1), (5, 5), (1, 5)], rng=1)
    assert (inner.distances() >= 0).sum() >= 16


def test_bad_shapes_are_named() -> None:
    points = cz.sample.uniform(9, rng=1)
    for shape, message in [
        ([(0, 0), (1, 1)], r"within\[0\] has 2 corners"),
        ([(0, 0), (1, 1), (2, 2)], "outline side .* crosses or overlaps outline side"),
        ([(0, 0), (2, 2), (2, 0), (0, 2)], r"outline side \(0, 1\) crosses or overlaps outline side \(2, 3\)"),
        ([], "within"),
        ({"type": "Point", "coordinates": (0, 0)}, "geometry of type 'Point'"),
        ([(0, 0), (1, 0), (float("nan"), 1)], "nan|finite"),
        ([(0, 0), (1, 0), (1, 0), (0, 0)], "extent"),
    ]:
        with pytest.raises(ValueError, match=message):
            cz.maze(points, within=shape, rng=1)
    with pytest.raises(ValueError, match="within goes without bounds and period"):
        cz.maze(points, within=HOLED, bounds=(0, 0, 1, 1))
    with pytest.raises(TypeError):
        cz.maze(points, within=7)


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
def test_shapes_as_small_as_a_pixel_and_as_thin_as_a_hair(cells: str) -> None:
    """Whose area the coordinates nearly hide, and whose sides would be cut into pieces without number."""
    points = cz.sample.uniform(50, bounds=(0, 0, 4, 4), rng=1)
    for shape in (shapely.box(1, 1, 1 + 1e-9, 1 + 1e-9), shapely.box(0, 1, 4, 1 + 1e-15), shapely.box(0, 0, 4, 1e-30)):
        m = cz.maze(points, within=shape, cells=cells, rng=1)
        assert m.region is not None and len(m.region.coords) == 4
        assert len(m.diagram.sites) < 1000


def test_masks_of_single_pixels_are_shapes() -> None:
    mask = np.zeros((5, 7), dtype=bool)
    mask[3, 2] = True
    m = cz.maze(cz.sample.uniform(50, bounds=(0, 0, 7, 5), rng=1), within=mask, rng=1)
    assert m.region is not None
    assert m.region.contains(np.array([[2.5, 1.5], [4.5, 1.5]])).tolist() == [True, False]
