"""Cracks that meet where they should not, by Shapely."""

from __future__ import annotations

import numpy as np
import shapely

import crazing as cz


def crossings(c: cz.Crack) -> int:
    """Pairs of edges that meet anywhere but at a common vertex; of a torus those of 3 x 3 copies."""
    around = (-1, 0, 1) if c.period else (0,)
    copies = [np.array((a, b), dtype=int) for a in around for b in around]
    period = np.array(c.period or (0, 0))
    segments = np.concatenate([c.segments + copy * period for copy in copies])
    turns = np.stack([np.zeros_like(c.shifts, dtype=int), c.shifts.astype(int)], axis=1)
    turns = np.concatenate([turns + copy for copy in copies])
    vertices = np.tile(c.graph.edges, (len(copies), 1))[:, :, None]
    ends = np.concatenate([vertices, turns], axis=2)
    lines = shapely.linestrings(segments)
    i, j = shapely.STRtree(lines).query(lines, predicate="intersects")
    i, j = i[i < j], j[i < j]
    common = (ends[i][:, :, None] == ends[j][:, None]).all(axis=-1)
    apart = ~common.any(axis=(1, 2))
    # Edges from one vertex lie on each other only if they leave it in one direction.
    side_i, side_j = common.any(axis=2).argmax(axis=1), common.any(axis=1).argmax(axis=1)
    step = segments[:, 1] - segments[:, 0]
    p, q = ((1 - 2 * side)[:, None] * step[row] for side, row in ((side_i, i), (side_j, j)))
    folded = (p[:, 0] * q[:, 1] == p[:, 1] * q[:, 0]) & ((p * q).sum(axis=1) > 0)
    return int((apart | folded).sum())
