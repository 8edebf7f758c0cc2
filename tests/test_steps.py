"""The laws of the steps: nothing ever crosses, with Shapely as the witness."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

import crazing as cz
from crossings import crossings

PLACES = {
    "uniform": lambda seed: cz.sample.uniform(150, rng=seed),
    "grid": lambda seed: np.argwhere(np.ones((12, 12))) / 12.0,
    "nearly a grid": lambda seed: np.argwhere(np.ones((12, 12))) / 12.0 + cz.sample.normal(144, scale=1e-9, rng=seed),
    "clusters": lambda seed: np.concatenate(
        [
            cz.sample.normal(40, loc=(x, 0.5), scale=10.0**-k, rng=seed + k)
            for k, x in enumerate((0.5, 0.2, 0.7, 0.8), 1)
        ]
    ),
    "circle": lambda seed: 0.5 + 0.4 * np.exp(1j * np.arange(60) * np.pi / 30).view(float).reshape(-1, 2),
    "nearly a line": lambda seed: np.column_stack(
        [np.arange(80) / 80, 0.5 + cz.sample.normal(80, scale=1e-4, rng=seed)[:, 0]]
    ),
}


@pytest.mark.parametrize("period", [None, (1.0, 1.0), (1.0, 0.5)])
@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("opening", [0.0, 0.6, 1.0])
def test_straightening_never_makes_a_crossing(place: str, period, opening: float) -> None:
    hard = {"unbend": 12, "rounds": 12, "pull": 1.0, "slide": 1.0, "clamp": 0.02}
    for seed in range(2):
        points = PLACES[place](seed)
        before = cz.crack(points, opening=opening, period=period, rng=seed)
        after = cz.crack(points, opening=opening, period=period, rng=seed, **hard)
        assert np.array_equal(before.graph.edges, after.graph.edges)
        assert crossings(before) == 0
        assert crossings(after) == 0


def test_straightening_makes_t_junctions_and_short_ways() -> None:
    def largest_angles(c: cz.Crack) -> NDArray[np.float64]:
        ends = np.concatenate([c.segments, c.segments[:, ::-1]])
        vertex = c.graph.edges.T.ravel()
        step = ends[:, 1] - ends[:, 0]
        angle = np.arctan2(step[:, 1], step[:, 0])
        three = np.flatnonzero(c.graph.degrees == 3)
        order = np.lexsort([angle, vertex])
        rows = angle[order][np.isin(vertex[order], three)].reshape(-1, 3)
        return np.degrees(np.diff(rows, axis=1, append=rows[:, :1] + 2 * np.pi)).max(axis=1)

    plain = cz.crack(n=2000, opening=0.57, rng=3)
    straight = cz.crack(n=2000, opening=0.57, rounds=5, rng=3)
    share = [(largest_angles(c) >= 155).mean() for c in (plain, straight)]
    assert share[0] < 0.4 and share[1] > 0.6
    assert straight.graph.length < 0.97 * plain.graph.length


@pytest.mark.parametrize("period", [None, (1.0, 1.0)])
def test_unbending_pulls_where_nothing_meets_a_crack_and_nowhere_else(period) -> None:
    plain, unbent = (cz.crack(n=400, opening=0.7, unbend=n, period=period, rng=5) for n in (0, 6))
    moved = (plain.graph.vertices != unbent.graph.vertices).any(axis=1)
    bends = plain.graph.degrees == 2
    assert not moved[~bends].any() and moved[bends].mean() > 0.9
    before, after = (np.linalg.norm(c.segments[:, 1] - c.segments[:, 0], axis=1).sum() for c in (plain, unbent))
    assert after < 0.95 * before


def test_a_periodic_crack_is_closed_over_its_seams() -> None:
    c = cz.crack(n=400, opening=0.5, period=(2.0, 1.0), rng=5)
    assert (c.graph.vertices >= 0).all() and (c.graph.vertices < (2, 1)).all()
    assert c.shifts.any() and len(c.shifts) == len(c.graph.edges)
    walls = cz.maze(cz.sample.uniform(400, bounds=(0, 0, 2, 1), rng=np.random.default_rng(5)), period=(2, 1), rng=0)
    assert np.abs(c.segments[:, 1] - c.segments[:, 0]).max() < 0.5
    assert walls.bounds == c.bounds
    # No free tip at a seam: every end that is not a dead end goes on.
    assert (c.width[(c.graph.degrees == 1)[c.graph.edges]] == 0).all()


def topology(c: cz.Crack) -> tuple[int, int, int, int]:
    """Free ends, junctions, components and loops."""
    degrees, g = c.graph.degrees, c.graph
    return (
        int((degrees == 1).sum()),
        int((degrees > 2).sum()),
        g.components,
        len(g.edges) - len(g.vertices) + g.components,
    )


HARD = {"roughness": 0.8, "hurst": 0.4, "grain": 0.05, "warp": 0.5}
CURVED = {"rounding": 1.0, "grain": 0.004}


@pytest.mark.parametrize("period", [None, (1.0, 0.5)])
@pytest.mark.parametrize("generator", ["maze", "splitting", "impact"])
def test_rough_and_warped_cracks_keep_their_topology_and_never_cross(generator: str, period) -> None:
    for seed, moved in enumerate((HARD, CURVED, {**HARD, **CURVED})):
        where = {"period": period, "rng": seed, "n": 60, "generator": generator}
        where |= {"opening": 0.5} if generator == "maze" else {}
        plain, rough = cz.crack(**where), cz.crack(**where, **moved)
        assert len(rough.graph.edges) > 3 * len(plain.graph.edges)
        assert topology(rough) == topology(plain)
        assert crossings(plain) == crossings(rough) == 0
        nodes = np.flatnonzero(plain.graph.degrees != 2)
        assert set(np.unique(plain.strand)) == set(np.unique(rough.strand)), len(nodes)


def test_roughness_stays_put_at_nodes_and_grows_with_its_knob() -> None:
    drawing = cz.steps.split(40, rng=3)
    winding = []
    for roughness in (0.0, 0.02, 0.05, 0.1):
        rough = cz.steps.roughen(drawing, roughness=roughness, unit=0.15, rng=4)
        node = np.bincount(drawing.edges.ravel()) != 2
        np.testing.assert_array_equal(rough.vertices[: len(node)][node], drawing.vertices[node])
        winding.append(cz.PlanarGraph(rough.vertices, rough.edges).length)
    assert (np.diff(winding) > 0).all()
    assert winding[0] == pytest.approx(cz.PlanarGraph(drawing.vertices, drawing.edges).length)


@pytest.mark.parametrize("hurst", [0.3, 0.7, 1.0])
def test_displacement_grows_with_length_to_the_power_of_hurst(hurst: float) -> None:
    def middle(length: float) -> float:
        lines = cz.PlanarGraph(
            np.stack([[(0.0, 9.0 * i), (length, 9.0 * i)] for i in range(400)]).reshape(-1, 2),
            np.arange(800).reshape(-1, 2),
        )
        how = {"roughness": 0.05, "unit": 1.0, "hurst": hurst, "grain": length * 0.51}
        rough = cz.steps.roughen(cz.steps.draw(lines), rng=1, **how)
        return float((rough.vertices[800:, 1] - 9.0 * np.arange(400)).std())

    assert middle(1.0) == pytest.approx(0.05, rel=0.1)
    assert np.log2(middle(4.0) / middle(1.0)) / 2 == pytest.approx(hurst, abs=0.1)


@pytest.mark.parametrize("corners", [12, 20])
def test_a_rounded_ring_is_nearly_a_circle(corners: int) -> None:
    around = 2 * np.pi * np.arange(corners) / corners
    ring = np.column_stack([np.cos(around), np.sin(around)])
    drawing = cz.steps.draw(
        cz.PlanarGraph(ring, np.column_stack([np.arange(corners), np.roll(np.arange(corners), -1)]))
    )
    # A cubic with the slopes of the chords' neighbours rises so far, the circle hardly less.
    flat, rise = 1 - np.cos(np.pi / corners), np.sin(np.pi / corners) * np.tan(np.pi / corners) / 2
    for rounding in (0.5, 1.0):
        bent = cz.steps.roughen(drawing, roughness=0, unit=1, grain=0.05, rounding=rounding, rng=1)
        turned = np.arctan2(*bent.vertices.T[::-1]) * corners / np.pi % 2
        middle = np.hypot(*bent.vertices[np.isclose(turned, 1)].T)
        assert len(middle) == corners
        np.testing.assert_allclose(1 - middle, flat - rounding * rise, atol=1e-9)
    assert rise == pytest.approx(flat, rel=0.03)


@pytest.mark.parametrize("grain", [0.01, 0.02, 0.05])
def test_pieces_are_as_short_as_the_grain_or_next_to_straight(grain: float) -> None:
    walls, how = cz.steps.split(8, rng=2), {"roughness": 0, "unit": 1, "rounding": 1, "rng": 1}
    fine, coarse = (cz.steps.roughen(walls, grain=size, **how) for size in (1e-3, grain))
    start, end = np.moveaxis(coarse.vertices[coarse.edges], 1, 0)
    along, from_start = end - start, fine.vertices[:, None] - start
    part = np.clip((from_start * along).sum(axis=-1) / (along**2).sum(axis=-1), 0, 1)
    apart = np.linalg.norm(from_start - part[..., None] * along, axis=-1).min(axis=1).max()
    assert apart <= grain / 40
    assert (np.linalg.norm(along, axis=-1) > grain).any()
    # A free tip runs out in a curve: there no piece is longer.
    alone = cz.steps.draw(cz.PlanarGraph([(0, 0), (2, 0)], [(0, 1)]))
    tip = cz.steps.roughen(alone, roughness=1e-6, unit=1, grain=grain, rng=1)
    assert np.linalg.norm(np.diff(tip.vertices[tip.edges], axis=1), axis=-1).max() <= grain


def test_cracks_that_go_on_nowhere_stay_straight() -> None:
    # A long crack, one that abuts it, and one alone: no turn at any vertex, so that nothing is bent.
    places = [(0, 0), (1, 0), (2, 0), (1, 1), (3, 1), (4, 2)]
    drawing = cz.steps.draw(cz.PlanarGraph(places, [(0, 1), (1, 2), (1, 3), (4, 5)]))
    bent = cz.steps.roughen(drawing, roughness=0, unit=1, grain=0.1, rounding=1, rng=1)
    plain = cz.PlanarGraph(bent.vertices, bent.edges)
    assert plain.length == pytest.approx(2 + 1 + np.sqrt(2), abs=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_any_drawing_can_be_straightened_without_crossing(seed: int) -> None:
    d = cz.diagram(cz.sample.normal(80, rng=seed))
    kept = cz.sample.uniform(len(d.edges), rng=seed)[:, 0] < 0.4
    graph = cz.PlanarGraph(d.sites, d.edges[kept]).compact()
    drawing = cz.steps.straighten(cz.steps.draw(graph), rounds=20, pull=1, slide=1, clamp=0.01)
    rough = cz.steps.roughen(cz.steps.warp(drawing, amplitude=0.5, rng=1), roughness=0.5, unit=0.3, rng=1)
    for step in (drawing, rough):
        assert crossings(cz.steps.widen(step, width=0.01)) == 0
    assert not np.array_equal(drawing.vertices, graph.vertices)


def test_a_drawing_that_crosses_is_refused() -> None:
    with pytest.raises(cz.CrazingError, match="cross"):
        cz.steps.draw(cz.PlanarGraph([(0, 0), (1, 1), (0, 1), (1, 0)], [(0, 1), (2, 3)]))


@pytest.mark.parametrize("period", [None, (1.0, 1.0), (3.0, 1.0)])
def test_splitting_makes_right_angled_t_junctions_only(period) -> None:
    drawing = cz.steps.split(120, jitter=0.4, period=period, rng=2)
    c = cz.steps.widen(drawing, width=0.01, hierarchy=0, shrink=0.8, taper=0)
    degrees = c.graph.degrees
    assert degrees.max() == 3
    g = c.graph
    area = (c.bounds[2] - c.bounds[0]) * (c.bounds[3] - c.bounds[1])
    loops = len(g.edges) - len(g.vertices) + g.components
    if period is None:
        # Cells = loops once the outline is drawn: every cut end closes one more.
        assert loops + int((degrees == 1).sum()) == 120
    else:
        assert loops == 120 + 1  # Euler on a torus: e - v = cells.
        assert (degrees != 1).all()
    # Width of a generation, the oldest crack first.
    np.testing.assert_allclose(c.width.max(axis=1), 0.01 * 0.8 ** c.generation.astype(float))
    assert area > 0 and c.generation.max() > 3
    ends = np.concatenate([c.segments, c.segments[:, ::-1]])
    vertex, strand = c.graph.edges.T.ravel(), np.tile(c.strand, 2)
    step = ends[:, 1] - ends[:, 0]
    step /= np.hypot(*step.T)[:, None]
    turns = []
    for node in np.flatnonzero(degrees == 3):
        here = np.flatnonzero(vertex == node)
        alone = [k for k in here if (strand[here] == strand[k]).sum() == 1]
        if len(alone) == 1:
            through = [k for k in here if k != alone[0]]
            turns.append(min(abs(float(step[alone[0]] @ step[k])) for k in through))
    # Cosines against the older crack.
    assert len(turns) > 180 and np.median(turns) < 0.1


@pytest.mark.parametrize("n", [1, 2, 40])
@pytest.mark.parametrize("bend", [0.0, 0.5, 1.0])
def test_a_torus_has_its_cells_whatever_its_shape(n: int, bend: float) -> None:
    """Also where the first walls would join a crack to itself, one period on."""
    for seed, period in enumerate(((1, 1), (2, 1), (0.3, 1), (1, 1), (2, 1), (0.3, 1))):
        how = {"bend": bend, "anisotropy": (1, 4)[seed % 2], "angle": 30 * seed}
        c = cz.crack(n=n, generator="splitting", period=period, rng=seed, **how)
        assert len(c.graph.edges) - len(c.graph.vertices) == n
        assert crossings(c) == 0 and c.graph.degrees.max() == 3


def test_an_impact_on_its_own_fence_never_crosses_when_rough() -> None:
    for seed, period in enumerate((None, (1, 1), None, (2, 1))):
        drawing = cz.steps.impact(200, speed=480, source=(0.5, 0.5), arcs=1, period=period, rng=seed)
        rough = cz.steps.roughen(drawing, unit=0.06, rng=seed, roughness=0.8, hurst=0.4, grain=0.05)
        assert crossings(cz.steps.widen(drawing, width=0.001)) == 0
        assert crossings(cz.steps.widen(rough, width=0.001)) == 0


def test_spokes_follow_the_square_root_of_speed_and_are_straight() -> None:
    for speed, spokes in ((70, 4), (280, 8), (630, 12)):
        drawing = cz.steps.impact(80, speed=speed, source=(0.4, 0.6), rng=3)
        centre = np.flatnonzero((drawing.vertices == (0.4, 0.6)).all(axis=1))
        assert (drawing.edges == centre[0]).sum() == spokes
        first = drawing.edges[np.isin(drawing.age, np.arange(spokes))]
        away = drawing.vertices[first] - (0.4, 0.6)
        off = away[:, 0, 0] * away[:, 1, 1] - away[:, 0, 1] * away[:, 1, 0]
        assert np.abs(off).max() < 1e-12


def test_knobs_leave_seeds_of_other_steps_alone() -> None:
    base = {"n": 80, "opening": 0.6, "rounds": 3, "rng": 4}
    plain = cz.crack(**base)
    assert np.array_equal(cz.crack(**base, unevenness=0.4).graph.vertices, plain.graph.vertices)
    assert np.array_equal(cz.crack(**base, fade=2, source=(0.1, 0.1)).graph.edges, plain.graph.edges)
    near = np.hypot(*(plain.segments.mean(axis=1) - (0.1, 0.1)).T) < 0.3
    ratio = cz.crack(**base, fade=2, source=(0.1, 0.1)).width.sum(axis=1) / plain.width.sum(axis=1)
    assert ratio[near].min() > ratio[~near].max()
    rough = cz.crack(**base, roughness=0.05)
    assert set(map(tuple, plain.graph.vertices[plain.graph.degrees != 2])) <= set(map(tuple, rough.graph.vertices))
    assert np.array_equal(cz.crack(**base, roughness=0.05, unevenness=0.3).graph.vertices, rough.graph.vertices)


def test_anisotropy_lays_cracks_along_its_angle() -> None:
    def along(c: cz.Crack, angle: float) -> float:
        step = c.segments[:, 1] - c.segments[:, 0]
        turn = np.arctan2(*step.T[::-1]) - np.radians(angle)
        return float((np.hypot(*step.T) * np.cos(2 * turn)).sum() / np.hypot(*step.T).sum())

    for generator in ("maze", "splitting"):
        for angle, period in ((0, None), (30, None), (90, (1, 1)), (0, (2, 1))):
            how = {"n": 300, "generator": generator, "angle": angle, "period": period, "rng": 1}
            orders = [along(cz.crack(anisotropy=a, **how), angle) for a in (1.0, 2.0, 4.0)]
            assert abs(orders[0]) < 0.25 and orders[0] + 0.1 < orders[1] < orders[2]


@pytest.mark.parametrize("generator", ["maze", "splitting"])
def test_density_makes_plates_finer(generator: str) -> None:
    image = np.array([[1.0, 8.0]])
    for density in (image, lambda x, y: np.where(x > 0.5, 8.0, 1.0)):
        how = {"opening": 0} if generator == "maze" else {}
        c = cz.crack(generator=generator, n=300, density=density, rng=2, **how)
        right = c.graph.vertices[:, 0] > 0.5
        assert 0.75 < right.mean() < 0.95
    central = cz.crack(generator=generator, n=300, falloff=1.0, source=(0.2, 0.7), rng=2).graph.vertices
    assert np.hypot(*(np.median(central, axis=0) - (0.2, 0.7))) < 0.15
