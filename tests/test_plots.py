"""Diagrams, skeletons and cracks on Matplotlib axes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

import crazing as cz

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4), (1, 2), (3, 2)]


def axes() -> Any:
    return Figure().subplots()


def drawn(ax: Any) -> dict[str, float]:
    """The length of the lines under each label."""
    return {
        lines.get_label(): sum(float(np.hypot(*np.diff(line, axis=0).T).sum()) for line in lines.get_segments())
        for lines in ax.collections
    }


def flower(n: int) -> np.ndarray[Any, Any]:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return (1 + 0.3 * np.cos(5 * t))[:, None] * np.column_stack([np.cos(t), np.sin(t)])


def test_a_diagram_shows_both_faces_or_one() -> None:
    d = cz.diagram(cz.sample.uniform(60, rng=1))
    ax = axes()
    assert d.plot(ax) is ax
    delaunay, voronoi = d.delaunay.length, d.voronoi().length
    assert drawn(ax) == {"Delaunay": pytest.approx(delaunay), "Voronoi": pytest.approx(voronoi)}
    assert drawn(d.plot(axes(), voronoi=False)) == {"Delaunay": pytest.approx(delaunay)}
    assert drawn(d.plot(axes(), delaunay=False, color="k")) == {"Voronoi": pytest.approx(voronoi)}
    assert ax.get_aspect() == 1.0


def test_a_diagram_with_constraints_shows_them_instead_of_voronoi_edges() -> None:
    d = cz.diagram(SQUARE, constraints=[[0, 1, 2, 3, 0], [4, 5]])
    assert drawn(d.plot(axes())) == {"Delaunay": pytest.approx(d.delaunay.length), "constraints": pytest.approx(18)}
    with pytest.raises(ValueError, match="has constraints"):
        d.plot(axes(), voronoi=True)


@pytest.mark.parametrize("points", [[], [(2, 3)], [(0, 0), (1, 1), (2, 2)]])
def test_a_diagram_without_triangles_is_shown(points: Any) -> None:
    ax = cz.diagram(points).plot(axes())
    assert len(ax.collections) == 2
    FigureCanvasAgg(ax.figure).draw()


def test_a_diagram_on_a_torus_is_shown_within_its_period() -> None:
    ax = cz.diagram(cz.sample.uniform(30, rng=2), period=(1, 1)).plot(axes())
    corners = np.concatenate([line for lines in ax.collections for line in lines.get_segments()])
    assert (corners >= 0).all() and (corners <= 1).all()


def test_a_skeleton_shows_crust_and_axis_in_two_colours() -> None:
    s = cz.medial_axis(flower(200), method="one-step").prune()
    ax = s.plot(axes(), linewidth=2)
    assert drawn(ax)["crust"] == pytest.approx(s.crust.length)
    colors = {tuple(lines.get_color()[0]) for lines in ax.collections}
    assert len(colors) == 2
    # Vertices far away stretch nothing.
    low, high = s.diagram.sites.min(), s.diagram.sites.max()
    assert low - 0.5 < min(ax.get_xlim()[0], ax.get_ylim()[0]) and max(ax.get_xlim()[1], ax.get_ylim()[1]) < high + 0.5
    near = s.plot(axes(), bounds=(0, 0, 0.5, 0.5))
    assert near.get_xlim()[1] < 0.6 and drawn(near)["crust"] == 0


def covered(crack: cz.Crack, size: int) -> np.ndarray[Any, Any]:
    """How dark each pixel is when the bounds fill the figure."""
    figure = Figure(figsize=(size / 100, size / 100), dpi=100)
    canvas = FigureCanvasAgg(figure)
    ax = figure.add_axes((0, 0, 1, 1))
    crack.plot(ax)
    xmin, ymin, xmax, ymax = crack.bounds
    ax.set(xlim=(xmin, xmax), ylim=(ymin, ymax))
    ax.axis("off")
    canvas.draw()
    return 1 - np.asarray(canvas.buffer_rgba())[..., 0] / 255.0


@pytest.mark.parametrize("period", [None, (1, 1)])
def test_a_crack_is_as_wide_as_it_is(period: Any) -> None:
    crack = cz.crack(preset="mud-mature", period=period, rng=7)
    size = 400
    plain = cz.Style(ink="#000", ground="#fff")
    wanted = 1 - cz.render(crack, size, style=plain)[..., 0] / 255.0
    found = covered(crack, size)
    assert 0.1 < wanted.mean() < 0.5
    # Ends and bends are round there and mitred here, which no more than the rim shows.
    assert abs(found.mean() - wanted.mean()) < 0.02 * wanted.mean()
    assert np.abs(found - wanted).mean() < 0.05 * wanted.mean()


def test_a_crack_takes_a_style() -> None:
    ax = cz.crack(n=50, rng=1).plot(axes(), facecolor="red", alpha=0.5, label="cracks")
    (outlines,) = ax.collections
    assert outlines.get_label() == "cracks"
    assert outlines.get_facecolor()[0].tolist() == [1, 0, 0, 0.5]
    assert len(cz.crack([(0, 0)], rng=1).plot(axes()).collections) == 1


@pytest.mark.parametrize(
    "held",
    [cz.diagram(SQUARE), cz.medial_axis(SQUARE), cz.crack(n=20, rng=1)],
    ids=["diagram", "skeleton", "crack"],
)
def test_what_is_no_axes_is_refused(held: Any) -> None:
    with pytest.raises(TypeError, match="ax is 'here'; axes of Matplotlib are wanted"):
        held.plot("here")
