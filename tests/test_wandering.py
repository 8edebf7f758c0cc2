"""Warped and rough cracks near others: all move, and all are as rough."""

from __future__ import annotations

import numpy as np
import pytest

import crazing as cz
from test_hooks import ahead


def test_a_crack_with_room_on_one_side_only_is_as_rough_as_others() -> None:
    """Kept at the thin side it would run straight along it, half of its length."""
    # Two lines side by side, with all the room above and below them.
    lines = cz.PlanarGraph(
        [(0, 0), (1, 0), (0, -0.004), (1, -0.004), (0, 1), (1, 1), (0, -1), (1, -1)], [(0, 1), (2, 3), (4, 5), (6, 7)]
    )
    drawing, off = cz.steps.draw(lines), []
    for seed in range(20):
        rough = cz.steps.roughen(drawing, roughness=0.05, unit=1.0, grain=0.02, rng=seed)
        inner = rough.vertices[len(drawing.vertices) :][:63]
        assert ((inner[:, 0] > 0) & (inner[:, 0] < 1) & (inner[:, 1] > -0.004)).all()
        off.append(inner[:, 1])
    assert np.std(np.stack(off)[:, 31]) > 0.015
    assert (np.abs(off) < 0.002).mean() < 0.1


def test_a_warp_leaves_few_kinks() -> None:
    """Vertices that neighbours held back stayed where they were when these had gone."""
    kinks, unit = [], 130**-0.5
    for seed in range(3):
        plain = cz.steps.split(130, jitter=0.45, bend=0.85, rng=seed)
        moved = cz.steps.warp(plain, amplitude=0.05 * unit, rng=seed).vertices - plain.vertices
        ends, other = plain.edges.ravel(), plain.edges[:, ::-1].ravel()
        degrees = np.bincount(ends)
        near = np.column_stack([np.bincount(ends, part) for part in moved[other].T]) / degrees[:, None]
        apart = np.linalg.norm(moved - near, axis=1) / (0.05 * unit)
        kinks.extend(apart[~plain.cut & (degrees > 1)] > 0.3)
    assert len(kinks) > 3000 and np.mean(kinks) < 0.15


@pytest.mark.parametrize("period", [None, (1, 1)], ids=["plane", "torus"])
@pytest.mark.parametrize(("name", "most"), [("ice", 0.0012), ("glaze", 0.004), ("rock", 0.12), ("bark", 0.24)])
def test_a_warp_takes_along_what_it_can(name: str, most: float, period) -> None:
    """Twice as many stayed behind, straight runs in bent cracks, while the middles of the plates did not move."""
    behind = []
    plain = cz.preset(name).replace(stubs=0, roughness=0, rounding=0, turn=180, hairpin=180)
    for seed in range(12):
        # A warp of a millionth holds nobody back.
        strengths = (plain.warp, 0, 1e-6 * plain.warp)
        after, before, nearly = (plain.replace(warp=w).crack(rng=seed, period=period).graph.vertices for w in strengths)
        wanted, moved = 1e6 * (nearly - before), after - before
        if period:
            wanted, moved = (part - np.rint(part / unit) * unit for part, unit in ((wanted, 1e6), (moved, 1.0)))
        is_free = wanted.any(axis=1)
        behind.extend(np.linalg.norm(moved - wanted, axis=1)[is_free] > 0.25 * wanted.std())
    assert np.mean(behind) < most


def turned_back(recipe: cz.Recipe, seed: int) -> float:
    """Per cent of the length of cracks that turns by more than 80 degrees.

    Within 1.5 spacings to both sides. Cracks go on at junctions as an eye follows them, whatever their width; a
    spacing is twice the area over the length.
    """
    bare = recipe.replace(roughness=0, rounding=0, stubs=0).crack(rng=seed)
    drawing = cz.steps.follow(cz.steps.draw(bare.graph), turn=60)
    length = np.linalg.norm(np.diff(drawing.vertices[drawing.edges], axis=1)[:, 0], axis=1)
    turned = 0.0
    for end in np.flatnonzero(drawing.partner > np.arange(len(drawing.partner))):
        a, b = (ahead(drawing, int(side), 3 / bare.graph.length) for side in (end, drawing.partner[end]))
        if a @ b > -np.cos(np.radians(80)) * np.hypot(*a) * np.hypot(*b):
            turned += length[[end // 2, drawing.partner[end] // 2]].sum() / 2
    return 100 * turned / length.sum()


@pytest.mark.parametrize(("name", "most"), [("painting-flemish", 7.0), ("painting-italian", 3.0)])
def test_cracks_of_paintings_are_no_worms(name: str, most: float) -> None:
    """Measured masks have 1 to 2; cracks that kept all bends of the walls between plates had 15 and 8."""
    assert np.mean([turned_back(cz.preset(name), seed) for seed in range(40)]) < most
