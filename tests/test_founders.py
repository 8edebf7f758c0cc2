"""The first cracks of a torus, from which splitting starts."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse

import crazing as cz


def first_crack(bend: float, seed: int) -> np.ndarray:
    """How far the first crack of a torus lies off its way around, at even places."""
    drawing = cz.steps.split(1, bend=bend, period=(1, 1), rng=seed)
    first = np.flatnonzero(drawing.age == drawing.age.min())
    start, end = np.moveaxis(drawing.vertices[drawing.edges[first]], 1, 0)
    step = end + drawing.shifts[first] - start
    way = np.rint(step.sum(axis=0))
    along = np.concatenate([[0.0], np.cumsum(step @ way)]) / (way @ way)
    across = np.concatenate([[0.0], np.cumsum(step @ (-way[1], way[0]))])
    return np.interp(np.arange(64) / 64, along, across)


def test_the_first_crack_of_a_torus_is_no_sine() -> None:
    """A wave of one period far above the others is seen in every tile."""
    power = np.mean([np.abs(np.fft.rfft(first_crack(1.0, seed))[1:6]) ** 2 for seed in range(200)], axis=0)
    assert 0.2 < power[1:].sum() / power[0] < 0.6
    assert max(np.abs(first_crack(0.0, seed)).max() for seed in range(20)) < 1e-12


def test_the_first_crack_of_a_torus_does_not_waver() -> None:
    """Its short waves turned it as far as its long ones, beside cracks that run in one arc."""
    waves = np.array([np.abs(np.fft.rfft(first_crack(1.0, seed))[1:7]) ** 2 for seed in range(200)])
    turned = (waves * np.arange(1, 7) ** 2).mean(axis=0)
    assert turned[3:].sum() < 0.2 * turned.sum()


@pytest.mark.parametrize("period", [(1, 0.05), (0.05, 1), (1, 0.01), (1, 1 / 3), (0.002, 1)])
def test_a_long_torus_is_split_into_as_many_cells(period):
    for seed in range(3):
        drawing = cz.steps.split(500, period=period, rng=seed)
        # Euler: on a torus what is connected has as many faces as edges beyond its vertices.
        assert len(drawing.edges) - len(drawing.vertices) == 500
        assert scipy.sparse.csgraph.connected_components(joined(drawing))[0] == 1


def joined(drawing):
    count = len(drawing.vertices)
    return scipy.sparse.coo_array((np.ones(len(drawing.edges)), drawing.edges.T), shape=(count, count))


def test_a_torus_too_long_to_be_split_is_refused():
    with pytest.raises(cz.CrazingError, match=r"length over width of the period is 1073741824; .* less long"):
        cz.steps.split(500, period=(1, 2.0**-30), rng=0)
