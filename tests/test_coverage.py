"""The mask of a texture beside the exact areas of pixels, by shapely."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import crazing as cz


def area_shares(crack, size):
    """(size, size) float64, the exact share of every pixel that edges cover in their widths, between 0 and 1."""
    ends, radii = crack.graph.vertices[crack.graph.edges] * size, np.maximum(crack.width * size / 2, 1e-7)
    discs = shapely.buffer(shapely.points(ends), radii, quad_segs=32)
    shape = shapely.union_all(shapely.convex_hull(shapely.union(discs[:, 0], discs[:, 1])))
    x, y = np.meshgrid(np.arange(size), np.arange(size)[::-1])
    return shapely.area(shapely.intersection(shapely.box(x, y, x + 1, y + 1), shape))


@pytest.mark.parametrize(
    ("pixels", "side", "end"), [(0.3, 0.1, 0.26), (0.9, 0.1, 0.26), (1.3, 0.05, 0.15), (5.0, 0.05, 0.1)]
)
def test_mask_of_an_oblique_bar_is_its_area(pixels, side, end):
    for angle in np.linspace(0.1, 3.0, 9):
        a, b = np.array([0.5, 0.52]) + np.outer([-0.35, 0.35], [np.cos(angle), np.sin(angle)])
        graph, only = cz.PlanarGraph([a, b], [(0, 1)]), np.zeros(1, np.int32)
        bar = cz.Crack(graph, np.full((1, 2), pixels / 24), only, only, (0, 0, 1, 1))
        off = np.abs(cz.texture(bar, 24, maps=["mask"])["mask"] / 255 - area_shares(bar, 24))
        assert off.max() < end
        x, y = np.meshgrid((np.arange(24) + 0.5) / 24, 1 - (np.arange(24) + 0.5) / 24)
        assert off[np.hypot(x - 0.5, y - 0.52) < 0.22].max() < side


@pytest.mark.parametrize(("preset", "size", "part"), [("mud-mature", 64, 0.01), ("glaze", 80, 0.04)])
def test_mask_of_a_pattern_is_its_area(preset, size, part):
    crack = cz.crack(preset=preset, n=25, rng=1)
    mask, true = cz.texture(crack, size, maps=["mask"])["mask"] / 255, area_shares(crack, size)
    off = np.abs(mask - true)
    rim = (true > 1e-3) & (true < 1 - 1e-3)
    assert off.max() < 0.5
    assert off[rim].mean() < 0.025
    assert mask.sum() == pytest.approx(true.sum(), rel=part)
