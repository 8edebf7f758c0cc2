"""Impacts on glass, with Shapely as the witness: no crack crosses another, nor one of a copy."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import crazing as cz
from crazing.fence import fenced_torus

PERIODS = [(1.0, 1.0), (2.0, 0.7), (0.1, 1.0)]


def impact(n: int, seed: int, period: tuple[float, float] | None, speed: float = 480) -> cz.steps.Drawing:
    source = (0.5, 0.4) if period is None else (0.3 * period[0], 0.9 * period[1])
    return cz.steps.impact(n, speed=speed, source=source, arcs=1, period=period, rng=seed)


def copies(shapes: np.ndarray, period: tuple[float, float]) -> np.ndarray:
    """Those of the period and of the copies about it, as long as a crack may be away."""
    away = [int(np.ceil(max(period) / side)) + 1 for side in period]
    turns = np.stack(np.meshgrid(*(np.arange(-k, k + 1) for k in away)), axis=-1).reshape(-1, 2)
    moved = shapes[None] + (turns * np.array(period))[:, None, None]
    # The period itself first.
    order = np.argsort(np.abs(turns).sum(axis=1), kind="stable")
    return moved[order].reshape(-1, *shapes.shape[1:])


def segments(drawing: cz.steps.Drawing) -> np.ndarray:
    found = drawing.vertices[drawing.edges]
    if len(drawing.shifts):
        found[:, 1] += drawing.shifts * np.array(drawing.period)
    return found


def crossings(drawing: cz.steps.Drawing) -> int:
    """Edges that meet another one anywhere but at an end of both."""
    own = segments(drawing)
    every = copies(own, drawing.period) if len(drawing.shifts) else own
    i, j = shapely.STRtree(shapely.linestrings(every)).query(shapely.linestrings(own), predicate="intersects")
    apart = i != j
    i, j = i[apart], j[apart]
    gap = np.abs(own[i][:, :, None] - every[j][:, None]).max(axis=-1).min(axis=(1, 2))
    return int((gap > 1e-12).sum())


def kites(drawing: cz.steps.Drawing) -> np.ndarray:
    """The four corners of the room about each edge, counter-clockwise."""
    anchors, rows, shifts = drawing.fence
    places = np.concatenate([drawing.vertices, anchors])[rows]
    if len(shifts):
        places[:, 1:] += shifts.reshape(-1, 3, 2) * np.array(drawing.period)
    return places[:, [0, 3, 1, 2]]


def loops(graph: cz.PlanarGraph) -> int:
    return len(graph.edges) - int((graph.degrees > 0).sum()) + graph.components


@pytest.mark.parametrize("n", [30, 500, 5000, 100_000])
@pytest.mark.parametrize("speed", [70, 480, 2000])
def test_no_crack_crosses_another(n: int, speed: float) -> None:
    for seed in range(20):
        assert crossings(impact(n, seed, None, speed)) == 0, seed


@pytest.mark.parametrize("n", [30, 500, 20_000])
@pytest.mark.parametrize("period", PERIODS)
def test_no_crack_crosses_one_of_a_copy(n: int, period: tuple[float, float]) -> None:
    for seed in range(6):
        assert crossings(impact(n, seed, period)) == 0, seed


@pytest.mark.parametrize("period", [None, *PERIODS])
def test_rooms_of_edges_have_nothing_in_common(period: tuple[float, float] | None) -> None:
    for n, seed in ((60, 0), (500, 1), (500, 2), (5000, 3)):
        drawing = impact(n, seed, period)
        own = kites(drawing)
        every = copies(own, period) if period else own
        mine, others = shapely.polygons(own), shapely.polygons(every)
        assert (shapely.area(mine) > 0).all()
        i, j = shapely.STRtree(others).query(mine, predicate="intersects")
        common = shapely.area(shapely.intersection(mine[i], others[j]))[i != j]
        assert common.max(initial=0) < 1e-9 * shapely.area(mine).max()


@pytest.mark.parametrize("period", PERIODS)
def test_spokes_go_on_until_they_meet_copies(period: tuple[float, float]) -> None:
    for seed in range(6):
        drawing = impact(300, seed, period)
        graph = cz.PlanarGraph(drawing.vertices, drawing.edges)
        passing = (drawing.shifts != 0).any(axis=1)
        assert passing.sum() >= 6
        # From side to side the pieces hang together: more loops than one star could close.
        inner = cz.PlanarGraph(drawing.vertices, drawing.edges[~passing])
        assert loops(graph) > loops(inner) + 3
        low = (0.3 * period[0] - period[0] / 2, 0.9 * period[1] - period[1] / 2)
        assert (drawing.vertices >= low).all() and (drawing.vertices < np.add(low, period)).all()


@pytest.mark.parametrize("period", PERIODS)
def test_no_spoke_runs_along_the_sides_to_the_next_copy(period: tuple[float, float]) -> None:
    """Four of them were a cross in every fourth picture, and its tiles a grid."""
    least = []
    for seed in range(60):
        drawing = impact(500, seed, period)
        leaves = drawing.edges == 0
        beyond = (drawing.shifts != 0).any(axis=1)
        step = np.diff(segments(drawing)[leaves.any(axis=1) | beyond], axis=1)[:, 0]
        off = np.degrees(np.arctan2(step[:, 1], step[:, 0])) % 90
        least.append(np.minimum(off, 90 - off).min())
    # Ten first spokes leave a gap of nine degrees at least.
    assert min(least) > 4 and np.mean(least) < 15


@pytest.mark.parametrize("period", PERIODS)
def test_the_fence_paves_the_torus(period: tuple[float, float]) -> None:
    for n, seed in ((30, 0), (500, 1), (5000, 2)):
        drawing = impact(n, seed, period)
        low = (0.3 * period[0] - period[0] / 2, 0.9 * period[1] - period[1] / 2)
        anchors, rows, shifts = fenced_torus(drawing.net, low)
        assert (rows[: len(drawing.edges), :2] == drawing.edges).all()
        assert (shifts[: len(drawing.edges), :2] == drawing.shifts).all()
        places = np.concatenate([drawing.vertices, anchors])[rows]
        places[:, 1:] += shifts.reshape(-1, 3, 2) * np.array(period)
        triangles = np.concatenate([places[:, [0, 1, 2]], places[:, [1, 0, 3]]])
        areas = shapely.area(shapely.polygons(triangles))
        assert shapely.is_ccw(shapely.linearrings(triangles)).all()
        # Every triangle is at three edges.
        assert areas.sum() / 3 == pytest.approx(period[0] * period[1], rel=1e-12)
        assert len(rows) == 3 * (len(drawing.vertices) + 1)


def test_a_vertex_in_the_corner_leaves_no_room() -> None:
    vertices = np.array([(0.0, 0.0), (0.5, 0.5)])
    net = (
        vertices,
        np.array([[0, 1]], dtype=np.int32),
        np.zeros((1, 2), dtype=np.int8),
        (1.0, 1.0),
        np.zeros(2, dtype=bool),
    )
    anchors, rows, shifts = fenced_torus(net, (0.0, 0.0))
    assert rows.tolist() == [[0, 1, -1, -1]]
    assert (len(anchors), shifts.tolist()) == (0, [[0] * 6])
