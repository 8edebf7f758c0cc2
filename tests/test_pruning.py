"""After the axis: radius, sides, pruning, the longest path."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import cKDTree

import crazing as cz

N = 1000
T = np.linspace(0, 2 * np.pi, N, endpoint=False)
ELLIPSE = np.column_stack([2000 * np.cos(T), 1000 * np.sin(T)])
FLOWER = 1000 * (1 + 0.3 * np.cos(5 * T) + 0.1 * np.cos(13 * T))[:, None] * np.column_stack([np.cos(T), np.sin(T)])
SHAPES = {"ellipse": (ELLIPSE, 2), "flower": (FLOWER, 13)}


def noisy(points: NDArray[np.float64], noise: float, seed: int = 0) -> NDArray[np.float64]:
    """Each coordinate moved by up to `noise` of the mean spacing."""
    spacing = np.hypot(*(np.roll(points, -1, axis=0) - points).T).mean()
    return points + np.random.default_rng(seed).uniform(-1, 1, points.shape) * noise * spacing


def one_step(points: NDArray[np.float64]) -> cz.Skeleton:
    return cz.medial_axis(points, method="one-step")


def cycles(graph: cz.PlanarGraph) -> int:
    return len(graph.edges) - len(np.unique(graph.edges)) + graph.components


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("noise", [0, 0.013, 0.125, 0.25])
@pytest.mark.parametrize("seed", range(3))
def test_the_default_leaves_the_true_branches(shape: str, noise: float, seed: int) -> None:
    points, leaves = SHAPES[shape]
    inner = one_step(noisy(points, noise, seed)).prune().inner
    assert (inner.leaves, inner.components, cycles(inner)) == (leaves, 1, 0)


@pytest.mark.parametrize("noise", [0.0, 0.25])
def test_the_pruned_axis_of_an_ellipse_is_its_segment(noise: float) -> None:
    a, b = 2000.0, 1000.0
    inner = one_step(noisy(ELLIPSE, noise)).prune().inner
    ends = inner.segments.reshape(-1, 2)
    spacing = 2 * np.pi * 1500 / N
    assert np.abs(ends[:, 1]).max() <= max(2.5 * noise * np.sqrt(2) * spacing, 1e-3 * a)
    assert abs(np.abs(ends[:, 0]).max() - (a * a - b * b) / a) <= 0.03 * 2 * a


def test_radius_is_the_distance_to_the_nearest_site() -> None:
    s = one_step(cz.sample.uniform(300, rng=1))
    np.testing.assert_allclose(s.radius, cKDTree(s.diagram.sites).query(s.diagram.vertices)[0], rtol=1e-6)


def test_inside_of_an_annulus_is_its_middle_circle() -> None:
    circle = np.column_stack([np.cos(T), np.sin(T)])
    s = one_step(np.vstack([circle, 3 * circle]))
    inner = s.inner
    radius = np.hypot(*inner.segments.reshape(-1, 2).T)
    np.testing.assert_allclose(radius, 2, atol=1e-4)
    assert (inner.components, inner.leaves, cycles(inner)) == (1, 0, 1)
    assert s.prune().inner == inner


def test_sides_agree_with_shapely() -> None:
    shapely = pytest.importorskip("shapely")
    s = one_step(FLOWER)
    middle = s.diagram.triangles
    inner = shapely.contains_xy(shapely.Polygon(FLOWER), *s.diagram.sites[middle].mean(axis=1).T)
    duals = s.diagram.dual_edges
    expected = s.axis_mask & (duals >= 0).all(axis=1) & inner[duals[:, 0]] & inner[duals[:, 1]]
    np.testing.assert_array_equal(s.inside, expected)


def test_chord_drops_edges_between_near_sites() -> None:
    s = one_step(noisy(FLOWER, 0.1)).prune(chord=100.0)
    assert (s.diagram.delaunay.lengths[s.axis_mask] >= 100.0).all()


def test_length_takes_the_shortest_branches_off_first() -> None:
    s = one_step(noisy(FLOWER, 0.05)).prune(0.005)
    few, fewer = (s.prune(length=length).inner for length in (200.0, 300.0))
    assert s.inner.leaves == few.leaves == 13 > fewer.leaves
    assert fewer.components == 1
    assert s.prune(length=0.0).axis == s.axis


def test_ratio_keeps_branches_that_reach_out() -> None:
    inner = one_step(noisy(FLOWER, 0.01)).prune(ratio=1.05).inner
    assert (inner.components, inner.leaves) == (1, 13)


def test_retraction_takes_hairs_of_one_edge() -> None:
    s = one_step(noisy(ELLIPSE, 0.002))
    once = s.prune(retract=1)
    assert once.inner.leaves < s.inner.leaves
    moved = (once.crust.vertices != s.crust.vertices).any(axis=1)
    assert moved.sum() > 0
    # Every moved sample is on the circle of some vertex of the axis.
    distance = np.abs(np.hypot(*(once.crust.vertices[moved][:, None] - s.diagram.vertices).T).T - s.radius)
    assert distance.min(axis=1).max() < 1e-6
    assert s.prune(retract=0).axis == s.axis


def test_main_is_the_longest_path_of_a_tree() -> None:
    networkx = pytest.importorskip("networkx")
    pruned = one_step(noisy(FLOWER, 0.1)).prune()
    main = pruned.main
    lengths = dict(networkx.all_pairs_dijkstra_path_length(pruned.inner.compact().to_networkx(), weight="length"))
    assert main.length == pytest.approx(max(max(row.values()) for row in lengths.values()))
    assert (main.leaves, main.components, main.degrees.max()) == (2, 1, 2)


def test_nonsense_is_refused() -> None:
    s = one_step(FLOWER)
    for name in ("residual", "chord", "length", "ratio", "retract"):
        with pytest.raises(ValueError, match=f"{name} is -1"):
            s.prune(**{name: -1})
    for method in ("initial", "poles"):
        with pytest.raises(ValueError, match="cannot be pruned"):
            cz.medial_axis(FLOWER, method=method).prune()
