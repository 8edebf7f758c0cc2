"""Outlines of strands beside unions of convex hulls of discs, which is what pictures draw; both by Shapely."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from numpy.typing import NDArray
from shapely.ops import polygonize

import crazing as cz
from crazing.strokes import outlines, strands


def hulls(segments: NDArray[np.float64], width: NDArray[np.float64]) -> shapely.Geometry:
    """Edges as the convex hulls of the discs at their ends."""
    points = shapely.points(segments)
    discs = np.where(width > 0, shapely.buffer(points, width / 2, quad_segs=32), points)
    return shapely.union_all([shapely.union(*pair).convex_hull for pair in discs]).buffer(0)


def winding(ring: NDArray[np.float64], x: float, y: float) -> int:
    """How often a ring runs counter-clockwise about a point, by the sides that a ray to the right meets."""
    (x0, y0), (x1, y1) = ring.T, np.roll(ring, -1, axis=0).T
    turn = (x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)
    return int(((y0 <= y) & (y1 > y) & (turn > 0)).sum()) - int(((y0 > y) & (y1 <= y) & (turn < 0)).sum())


def filled(rings: list[NDArray[np.float64]]) -> shapely.Geometry:
    """What the nonzero rule of SVG fills."""
    closed = [shapely.LineString(np.vstack([ring, ring[:1]])) for ring in rings]
    faces = list(polygonize(shapely.union_all(closed)))
    places = [face.representative_point().coords[0] for face in faces]
    inside = [sum(winding(ring, *place) for ring in rings) != 0 for place in places]
    return shapely.union_all([face for face, is_in in zip(faces, inside, strict=True) if is_in])


def drawn(c: cz.Crack) -> shapely.Geometry:
    return shapely.union_all([filled(outlines(strand)) for strand in strands(c)])


def line(points: Any, width: Any, *, closed: bool = False) -> cz.Crack:
    """One strand through the points; widths are one for all, or one a point, or two an edge."""
    points = np.asarray(points, dtype=float)
    rows = np.arange(len(points), dtype=np.int32)
    edges = np.column_stack([rows, np.roll(rows, -1)])[: None if closed else -1]
    width = np.asarray(width, dtype=float)
    if width.ndim == 1:
        width = width[edges]
    strand = np.zeros(len(edges), dtype=np.int32)
    return cz.Crack(
        cz.PlanarGraph(points, edges), np.broadcast_to(width, edges.shape), strand, strand, (0.0, 0.0, 1.0, 1.0)
    )


TURNS = np.linspace(0, 2 * np.pi, 25)[:-1]
ROUND = np.column_stack([np.cos(TURNS), np.sin(TURNS)])
WALK = np.cumsum(np.random.default_rng(0).normal(size=(40, 2)), axis=0) * 0.03 + 0.5

DRAWINGS = {
    "edges shorter than wide": line([(0.1 + 0.02 * i, 0.5 + 0.009 * (i % 2)) for i in range(40)], 0.2),
    "a disc within a disc": line([(0.2, 0.5), (0.25, 0.5)], [0.4, 0.1]),
    "a steep tip": line([(0.2, 0.5), (0.5, 0.5)], [0.4, 0.0]),
    "widths that step": line([(0.1, 0.5), (0.5, 0.5), (0.9, 0.5)], [(0.2, 0.2), (0.02, 0.02)]),
    "a ring": line(0.5 + 0.3 * ROUND, 0.1, closed=True),
    "a ring narrower than its line": line(0.5 + 0.05 * ROUND, 0.16, closed=True),
    "a hairpin": line([(0.1, 0.2), (0.9, 0.2), (0.1, 0.3)], 0.08),
    "there and back": line([(0.1, 0.2), (0.9, 0.2), (0.1, 0.2)], [0.1, 0.05, 0.1]),
    "a pinch": line([(0.1, 0.5), (0.5, 0.5), (0.9, 0.6)], [0.1, 0.0, 0.1]),
    "an edge without length": line([(0.1, 0.5), (0.5, 0.5), (0.5, 0.5), (0.9, 0.5)], [0.02, 0.02, 0.1, 0.05]),
    "a dot": line([(0.5, 0.5), (0.5, 0.5)], 0.1),
    "a walk": line(WALK, np.random.default_rng(1).random(40) * 0.1),
}


@pytest.mark.parametrize("name", DRAWINGS)
@pytest.mark.parametrize("scale", [1.0, 1e-9, 1e6])
def test_outlines_fill_the_hulls_of_discs(name: str, scale: float) -> None:
    given = DRAWINGS[name]
    graph = cz.PlanarGraph(given.graph.vertices * scale, given.graph.edges)
    c = cz.Crack(graph, given.width * scale, given.strand, given.generation, (0.0, 0.0, scale, scale))
    wanted, found = hulls(c.segments, c.width), drawn(c)
    assert shapely.symmetric_difference(wanted, found).area < 0.015 * wanted.area
    # Never farther off than a polygon of 24 sides is from its circle.
    assert shapely.hausdorff_distance(found.boundary, wanted.boundary) < 0.02 * c.width.max()


@pytest.mark.parametrize("name", ["mud-mature", "bark", "asphalt-alligator", "glaze"])
def test_outlines_of_rough_cracks_are_those_of_pictures(name: str) -> None:
    c = cz.crack(preset=name, n=6, rng=3, detail=0.01)
    wanted, found = hulls(c.segments, c.width), drawn(c)
    assert shapely.symmetric_difference(wanted, found).area < 0.006 * wanted.area


def test_nothing_is_drawn_where_there_is_no_width() -> None:
    assert all(not len(outlines(strand)) for strand in strands(line([(0.5, 0.5), (0.5, 0.5)], 0.0)))
    assert drawn(line([(0.1, 0.5), (0.5, 0.5)], 0.0)).area == 0


@pytest.mark.parametrize("seed", range(4))
def test_a_crack_that_abuts_itself_keeps_its_widths(tmp_path: Path, seed: int) -> None:
    # On a torus a crack may go around and meet its own side, where it is not as wide as what it meets.
    c = cz.crack(preset="bark", n=80, period=(1, 1), rng=seed)
    ends = np.column_stack([np.repeat(c.strand, 2), c.graph.edges.ravel()])
    assert (np.unique(ends, axis=0, return_counts=True)[1] > 2).any()
    c.save(tmp_path / "crack.geojson")
    found = []
    for feature in json.loads((tmp_path / "crack.geojson").read_text())["features"]:
        places, widths = feature["geometry"]["coordinates"], feature["properties"]["widths"]
        long = np.hypot(*np.diff(places, axis=0).T)
        found += [sorted([round(float(a), 9), *pair]) for a, *pair in zip(long, widths[:-1], widths[1:], strict=True)]
    long = np.hypot(*(c.segments[:, 1] - c.segments[:, 0]).T)
    wanted = [sorted([round(float(a), 9), *pair]) for a, pair in zip(long, c.width.tolist(), strict=True)]
    np.testing.assert_allclose(sorted(found), sorted(wanted), atol=2e-9)
