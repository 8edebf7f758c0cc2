"""Comparisons: the parts make the whole, and printed and drawn they say so."""

from __future__ import annotations

import json
import pickle
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

import crazing as cz
from command_line import run

METHODS = ("initial", "edge-filter", "one-step")


def flower(samples: int) -> NDArray[np.float64]:
    turn = np.linspace(0, 2 * np.pi, samples, endpoint=False)
    radius = 1 + 0.3 * np.cos(5 * turn)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)


def drawn(*graphs: cz.PlanarGraph) -> Counter[Any]:
    """Segments by their places, whichever way they run; those without length left out."""
    ends = np.concatenate([graph.segments[graph.lengths > 0] for graph in graphs])
    return Counter(tuple(sorted(map(tuple, pair))) for pair in ends.tolist())


@pytest.mark.parametrize("first", METHODS)
@pytest.mark.parametrize("second", METHODS)
def test_parts_make_both_axes(first: str, second: str, rng: np.random.Generator) -> None:
    comparison = cz.compare(rng.normal(size=(300, 2)), first, second)
    assert (comparison.first.method, comparison.second.method) == (first, second)
    assert drawn(comparison.shared, comparison.only_first) == drawn(comparison.first.axis)
    assert drawn(comparison.shared, comparison.only_second) == drawn(comparison.second.axis)
    assert not drawn(comparison.only_first) & drawn(comparison.second.axis)
    assert not drawn(comparison.only_second) & drawn(comparison.first.axis)


def test_masks_say_the_same(rng: np.random.Generator) -> None:
    comparison = cz.compare(rng.normal(size=(1000, 2)))
    first, second = comparison.first.axis_mask, comparison.second.axis_mask
    assert first is not None
    assert second is not None
    for graph, mask in (
        (comparison.shared, first & second),
        (comparison.only_first, first & ~second),
        (comparison.only_second, second & ~first),
    ):
        kept = comparison.first.diagram.dual_edges[mask]
        finite = cz.PlanarGraph(comparison.first.diagram.vertices, kept[(kept >= 0).all(axis=1)])
        assert drawn(graph) == drawn(finite)


@settings(max_examples=25)
@given(st.integers(2, 12), st.integers(2, 12), st.sampled_from(METHODS))
def test_lattices_whose_vertices_coincide(width: int, height: int, second: str) -> None:
    points = [(x, y) for x in range(width) for y in range(height)]
    comparison = cz.compare(points, "one-step", second)
    assert drawn(comparison.shared, comparison.only_second) == drawn(comparison.second.axis)


def test_a_diagram_is_not_triangulated_again() -> None:
    diagram = cz.diagram(flower(50))
    comparison = cz.compare(diagram)
    assert comparison.first.diagram is diagram
    assert comparison.second.diagram is diagram
    assert comparison.shared.vertices is not None
    assert np.shares_memory(comparison.shared.vertices, diagram.vertices)


def test_edge_filter_has_nothing_that_one_step_has_not() -> None:
    assert len(cz.compare(flower(400)).only_second.edges) == 0


def test_table_counts_and_prints_aligned() -> None:
    comparison = cz.compare(flower(200))
    table = {name: (a, b) for name, a, b in comparison.table}
    axes = comparison.first.axis, comparison.second.axis
    assert table["axis edges"] == tuple(len(axis.edges) for axis in axes)
    assert all(0 < length <= axis.length for length, axis in zip(table["axis length in box"], axes, strict=True))
    assert table["axis leaves"] == tuple(axis.leaves for axis in axes)
    assert table["axis components"] == tuple(axis.components for axis in axes)
    assert table["axis edges shared"] == (len(comparison.shared.edges),) * 2
    assert table["axis edges only here"] == (
        len(comparison.only_first.edges),
        len(comparison.only_second.edges),
    )
    lines = str(comparison).splitlines()
    assert lines[0].split() == ["one-step", "edge-filter"]
    assert len(lines) == 1 + len(comparison.table)
    assert len({len(line) for line in lines}) == 1
    assert repr(comparison) == str(comparison)


def test_time_is_no_part_of_equality() -> None:
    comparison = cz.compare(flower(60))
    again = pickle.loads(pickle.dumps(comparison))
    assert comparison == again == cz.compare(flower(60))
    assert again.seconds == comparison.seconds
    assert comparison != cz.compare(flower(61))


@pytest.mark.parametrize("name", ["", "One-Step", None, 3])
def test_an_unknown_method_is_refused(name: Any) -> None:
    with pytest.raises(ValueError, match=r"first is .*; one of 'edge-filter', 'one-step', 'initial'"):
        cz.compare(flower(10), name)


def test_bad_points_are_refused() -> None:
    with pytest.raises(cz.CrazingError, match="finite"):
        cz.compare([[0, 0], [1, 0], [np.nan, 1]])
    with pytest.raises(cz.DegenerateInputError):
        cz.compare([[0, 0], [1, 0]])


def test_plot_shows_the_samples_and_not_the_far_vertices() -> None:
    figure = pytest.importorskip("matplotlib.figure").Figure(layout="constrained")
    comparison = cz.compare(np.array([[0, 0], [1, 1e-9], [2, 0], [1, 2], [0.5, 1]]))
    panels = comparison.plot(figure.subplots(1, 3))
    assert [panel.get_title() for panel in panels] == ["one-step", "edge-filter", "both"]
    for panel in panels:
        assert panel.get_xlim() == pytest.approx((-0.1, 2.1))
        assert panel.get_ylim() == pytest.approx((-0.1, 2.1))
        assert panel.get_aspect() == 1.0
    legend = [text.get_text() for text in panels[2].get_legend().get_texts()]
    assert legend[0] == "samples (5)"
    assert legend[2] == f"only one-step ({len(comparison.only_first.edges)})"
    figure.canvas.draw()


@pytest.mark.parametrize("height", [0.01, 0.3, 1.0, 3.0])
def test_words_of_the_plot_lie_within_its_figure(height: float) -> None:
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("Agg")
    panels = cz.compare(flower(500) * (1, height)).plot()
    figure = panels[0].figure
    figure.canvas.draw()
    for panel in panels:
        for words in (panel.get_legend(), panel.title):
            box = words.get_window_extent()
            assert box.x0 >= 0 and box.x1 <= figure.bbox.width
            assert box.y0 >= 0 and box.y1 <= figure.bbox.height
    pyplot.close(figure)


def test_plot_wants_three_axes() -> None:
    figure = pytest.importorskip("matplotlib.figure").Figure()
    with pytest.raises(ValueError, match="three"):
        cz.compare(flower(20)).plot(figure.subplots(1, 2))


def test_distances_are_those_of_shapely(rng: np.random.Generator) -> None:
    shapely = pytest.importorskip("shapely")
    comparison = cz.compare(rng.normal(size=(300, 2)))
    sites = comparison.first.diagram.sites
    low, high = sites.min(axis=0), sites.max(axis=0)
    drawn = []
    for axis in (comparison.first.axis, comparison.second.axis):
        kept = ((axis.segments >= low) & (axis.segments <= high)).all(axis=(1, 2))
        drawn.append(shapely.MultiLineString(list(axis.segments[kept])))
    expected = shapely.hausdorff_distance(*drawn, densify=0.01)
    assert comparison.hausdorff == pytest.approx(expected, rel=0.05)
    assert max({name: (a, b) for name, a, b in comparison.table}["farthest from the other"]) == comparison.hausdorff


def test_a_known_axis_is_measured_against() -> None:
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    ellipse = np.column_stack([2 * np.cos(turn), np.sin(turn)])
    comparison = cz.compare(ellipse, axis=[[(-1.5, 0), (1.5, 0)]])
    table = {name: (a, b) for name, a, b in comparison.table}
    assert max(table["inner axis from known"]) < 1e-3
    assert max(table["known from inner axis"]) < 1e-3
    with pytest.raises(ValueError, match=r"\(e, 2, 2\)"):
        cz.compare(ellipse, axis=[(1, 2)])


def test_compare_has_no_infinity_in_its_json(tmp_path: Path) -> None:
    # Three pixels corner to corner: only "initial" finds an axis among them.
    bright = np.zeros((6, 7), np.uint8)
    bright[[2, 3, 3], [3, 2, 4]] = 255
    cz.save_png(tmp_path / "v.png", bright)
    result = run("compare", tmp_path / "v.png", "--first", "initial", "--json")

    def refuse(token: str) -> None:
        raise AssertionError(token)

    first, second = json.loads(result.stdout, parse_constant=refuse)
    assert (first["axis length in box"] > 0, second["axis length in box"]) == (True, 0)
    assert (first["farthest from the other"], second["farthest from the other"]) == (None, 0.0)
