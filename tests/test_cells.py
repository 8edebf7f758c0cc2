"""Plates of cracks of which very many float, side by side or in each other."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import shapely
import shapely.ops

import crazing as cz
from test_texture import lines, middles


@pytest.mark.parametrize("spot", [1.0, 1e-3])
@pytest.mark.parametrize("upright", [False, True])
def test_cells_hold_what_floats_in_one_spot(upright, spot):
    """Thousands of boxes in boxes, or of bars side by side, each of which looks for what lies to its left."""
    rng = np.random.default_rng(6)
    places = (np.stack(np.meshgrid(np.arange(12), np.arange(12)), axis=-1).reshape(-1, 2) + 0.5) / 12
    square = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) / 40
    rings = []
    for middle in places:
        turn = rng.random()
        around = square @ [[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]]
        rings += [middle + around * part for part in (1, 0.7, 0.4)]
    if upright:
        rings = [[[x, 0.1], [x + 0.004, 0.1], [x + 0.004, 0.9], [x, 0.9]] for x in rng.permutation(100) / 100 + 0.003]
    vertices = 0.3 + spot * np.concatenate(rings)
    rows = np.arange(len(vertices)).reshape(-1, 4)
    edges = np.stack([rows, np.roll(rows, -1, axis=1)], axis=-1).reshape(-1, 2)
    # A line over all, that reaches farther to the right than any box, and begins farther to the left.
    vertices = np.concatenate([vertices, [[0.05, 0.3 + 1.01 * spot], [0.9, 0.3 + 1.02 * spot]]])
    edges = np.concatenate([edges, [[len(vertices) - 2, len(vertices) - 1]]])
    crack = lines(vertices[edges], np.zeros((len(edges), 2)), bounds=(0, 0, 2, 2))
    crack.graph = SimpleNamespace(vertices=vertices, edges=edges)
    shown = (0.3, 0.3, 0.3 + spot, 0.3 + spot)
    cell = cz.texture(crack, 300, maps="cell", bounds=shown)["cell"]
    faces = list(shapely.ops.polygonize(shapely.unary_union([shapely.LinearRing(vertices[row]) for row in rows])))
    points = shapely.points(*(0.3 + spot * part for part in middles(300))).ravel()
    at, face = shapely.STRtree(faces).query(points, predicate="within")
    outside = np.setdiff1d(np.arange(len(points)), at)
    number = np.concatenate([face, np.full(len(outside), len(faces))])
    pairs = np.unique(np.stack([number, cell.ravel()[np.concatenate([at, outside])]]), axis=1)
    assert pairs.shape[1] == len(rows) + 1
    # One plate a face, and one face a plate.
    assert all(len(np.unique(numbers)) == len(numbers) for numbers in pairs)
