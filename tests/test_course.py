"""Recipes go through all steps in one call: the same bits as step after step."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.typing import NDArray

import crazing as cz

#: As recipes have them: where hooks are looked for, in spacings, and the reach of the source, in sides.
HOOK, REACH = 1.5, 0.25


def by_hand(r: cz.Recipe, points: NDArray[np.float64], where: dict, rng: int) -> cz.Crack:
    """What a recipe makes, step after step, each through its public function."""
    seed = np.random.default_rng(rng)
    if r.generator == "maze":
        even = {"thickness": 1.0, "hierarchy": 0.0, "abutting": 1.0, "taper": 0.0}
        unit = float(cz.Recipe(opening=r.opening, **even).crack(points, rng=1, **where).width.max())
        drawing = cz.steps.walls(cz.maze(points, tree=r.tree, opening=r.opening, rng=seed, **where))
    else:
        drawing = cz.steps.split(r.n, jitter=r.jitter, bend=r.bend, rng=seed, **where)
        unit = float(np.sqrt((drawing.bounds[2] - drawing.bounds[0]) * (drawing.bounds[3] - drawing.bounds[1]) / r.n))
    if r.rounds or r.unbend:
        how = {"rounds": r.rounds, "pull": r.pull, "slide": r.slide, "clamp": r.clamp, "unbend": r.unbend}
        drawing = cz.steps.straighten(drawing, **how)
    seeds = [np.random.default_rng([int(word) for word in seed.bit_generator.random_raw(2)]) for _ in range(3)]
    if r.warp:
        drawing = cz.steps.warp(drawing, amplitude=r.warp * unit, rng=seeds[0])
    if r.turn < 180 and r.generator == "maze":
        drawing = cz.steps.follow(drawing, turn=r.turn)
    if r.hairpin < 180 and r.generator == "maze":
        drawing = cz.steps.part(drawing, hairpin=r.hairpin, reach=HOOK * unit)
    if r.stubs:
        how = {"rate": r.stubs, "length": r.stub_length, "spread": r.stub_spread}
        drawing = cz.steps.stubs(drawing, unit=unit, rng=seed, **how)
    if r.roughness or r.rounding:
        how = {"roughness": r.roughness, "hurst": r.hurst, "grain": r.grain, "rounding": r.rounding}
        drawing = cz.steps.roughen(drawing, unit=unit, rng=seeds[1], **how)
    xmin, ymin, xmax, ymax = drawing.bounds
    return cz.steps.widen(
        drawing,
        width=r.thickness * unit,
        hierarchy=r.hierarchy,
        shrink=r.shrink,
        taper=r.taper,
        abutting=r.abutting,
        unevenness=r.unevenness,
        unit=unit,
        source=(xmin / 2 + xmax / 2, ymin / 2 + ymax / 2),
        reach=REACH * min(xmax - xmin, ymax - ymin),
        fade=r.fade,
        rng=seeds[2],
    )


@pytest.mark.parametrize("where", [{"bounds": (0, 0, 1, 1)}, {"period": (1.0, 1.0)}], ids=["plane", "torus"])
@pytest.mark.parametrize("generator", ["maze", "splitting"])
def test_a_recipe_is_its_steps_bit_for_bit(generator: str, where: dict) -> None:
    points = cz.sample.uniform(150, rng=6)
    steps = {
        "rounds": 3,
        "hairpin": 100.0,
        "turn": 50.0,
        "warp": 0.05,
        "stubs": 1.5,
        "roughness": 0.03,
        "rounding": 0.6,
    }
    looks = {"opening": 0.5, "n": 60, "unevenness": 0.3, "shrink": 0.9, "fade": 0.7}
    # None, all together, and each left out.
    chosen = [{}, steps]
    chosen += [{other: steps[other] for other in steps if other != name} for name in steps]
    for some in chosen:
        recipe = cz.Recipe(generator=generator, **looks, **some)
        made = recipe.crack(points if generator == "maze" else None, rng=5, **where)
        assert made == by_hand(recipe, points, where, rng=5), some


def test_widths_do_not_ask_how_edges_are_numbered() -> None:
    drawing = cz.steps.roughen(cz.steps.split(30, rng=1), roughness=0.05, unit=0.2, rng=1)
    # In another order every piece is an edge of its own.
    drawing = dataclasses.replace(drawing, origin=drawing.origin[:0])
    order = np.argsort(cz.sample.uniform(len(drawing.edges), rng=2)[:, 0])
    number = np.argsort(order)
    ends = drawing.partner.reshape(-1, 2)[order]
    mixed = dataclasses.replace(
        drawing,
        edges=drawing.edges[order],
        fence=(drawing.fence[0], drawing.fence[1][order], drawing.fence[2]),
        partner=np.where(ends < 0, -1, 2 * number[ends // 2] + ends % 2).astype(np.int32).ravel(),
        age=drawing.age[order],
    )
    how = {"width": 0.01, "fade": 0.5, "source": (0.2, 0.3)}
    one, other = cz.steps.widen(drawing, **how), cz.steps.widen(mixed, **how)
    assert np.array_equal(one.strand[order], other.strand)
    assert np.array_equal(one.generation[order], other.generation)
    assert np.array_equal(one.parent[order], other.parent)
    # Strands may be gone along from their other end: lengths are summed up in another order.
    np.testing.assert_allclose(one.width[order], other.width, rtol=1e-6, atol=1e-12)


def test_threads_change_no_bit(by_threads) -> None:
    program = (
        "import hashlib, crazing as cz\n"
        "c = cz.preset('painting-italian').replace(n=20_000).crack(rng=3)\n"
        "arrays = c.graph.vertices, c.graph.edges, c.width, c.strand, c.generation, c.parent\n"
        "print(len(c.graph.edges), hashlib.sha256(b''.join(array.tobytes() for array in arrays)).hexdigest())\n"
    )
    found = by_threads(program)
    assert len(found) == 1
    assert int(found.pop().split()[0]) > 1 << 15  # Fewer would not be given to threads.
