"""What splitting leaves to the steps after it: room about every wall, and walls in an order of place."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import crazing as cz

PERIODS = [None, (1, 1), (1, 0.1)]


def places(drawing, corner):
    """Where a corner of each kite is, on a torus beside its edge."""
    anchors, kites, shifts = drawing.fence
    found = np.concatenate([drawing.vertices, anchors])[kites[:, corner]]
    if len(shifts) and corner:
        found = found + shifts[:, 2 * corner - 2 : 2 * corner] * np.array(drawing.period)
    return found


@pytest.mark.parametrize("period", PERIODS)
def test_walls_have_room_on_both_sides(period):
    """Where the centroid of a cell does not see all walls, another place does: walls without room are not rough."""
    for seed in range(3):
        drawing = cz.steps.split(2000, jitter=0.45, bend=0.85, period=period, rng=seed)
        kites = drawing.fence[1]
        assert (kites < 0).any(axis=1).mean() < 6e-3
        a, b, left, right = (places(drawing, corner)[(kites >= 0).all(axis=1)] for corner in range(4))
        for third, side in ((left, 1), (right, -1)):
            ring = np.stack([a, b, third], axis=1)[:, ::side]
            assert shapely.is_ccw(shapely.linearrings(ring)).all()


def test_a_cell_whose_centroid_does_not_see_all_walls_has_a_middle_that_does():
    count, off = 0, 0
    for seed in range(3):
        drawing = cz.steps.split(2000, jitter=0.45, bend=0.85, rng=seed)
        lines = shapely.linestrings(drawing.vertices[drawing.edges])
        outline = shapely.box(0, 0, 1, 1).exterior
        cells = shapely.get_parts(shapely.polygonize(shapely.get_parts(shapely.union_all([*lines, outline]))))
        anchors = shapely.points(drawing.fence[0])
        inner, number = shapely.STRtree(cells).query(anchors, predicate="within")
        count += len(inner)
        off += (shapely.distance(anchors[inner], shapely.centroid(cells[number])) > 1e-9).sum()
    # Cells at the corners of the bounds are not closed by their cracks alone.
    assert count > 5800 and 30 < off < 600


@pytest.mark.parametrize("period", PERIODS)
def test_walls_that_follow_one_another_are_near(period):
    """Cells are split in no order of place: what comes after would look up every wall in far memory."""
    drawing = cz.steps.split(4000, period=period, rng=1)
    middles = (places(drawing, 0) + places(drawing, 1)) / 2
    steps = np.diff(middles, axis=0)
    box = np.array(period or (np.inf, np.inf))
    steps -= np.round(steps / box) * np.where(np.isfinite(box), box, 0)
    spacing = np.sqrt(np.prod(period or (1, 1)) / 4000)
    assert np.linalg.norm(steps, axis=1).mean() < spacing
    # Vertices are numbered as walls come to them.
    assert np.all(np.diff(np.unique(drawing.edges.ravel(), return_index=True)[1]) > 0)


def test_an_order_of_place_changes_no_crack():
    """Cracks are as old as they were split: each abuts older ones only."""
    drawing = cz.steps.split(500, rng=4)
    ends, ages = drawing.edges.ravel(), np.repeat(drawing.age, 2)
    tips = np.flatnonzero((drawing.partner < 0) & ~drawing.cut[ends])
    for tip in tips:
        others = ages[(ends == ends[tip]) & (ages != ages[tip])]
        assert len(others) == 2 and (others < ages[tip]).all()
    through = drawing.partner >= 0
    np.testing.assert_array_equal(ages[through], ages[drawing.partner[through]])
    np.testing.assert_array_equal(ends[through], ends[drawing.partner[through]])
    np.testing.assert_array_equal(drawing.partner[drawing.partner[through]], np.flatnonzero(through))
