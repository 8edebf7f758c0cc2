"""SVG as drawing programs write it, beside svgpathtools on data without shortcuts, Shapely, and what browsers show."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
import shapely

import crazing as cz
from crazing.outline import svg_lines
from crazing.region import as_region

svgpathtools = pytest.importorskip("svgpathtools")


def points(inner: str, attributes: str = "") -> np.ndarray:
    """The samples of a picture, y down as in the file."""
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {attributes}>{inner}</svg>'
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return svg_lines(text.encode()).coords * (1, -1)


def box(inner: str, attributes: str = "") -> list[float]:
    found = points(inner, attributes)
    return [*found.min(axis=0), *found.max(axis=0)]


@pytest.mark.parametrize(
    ("short", "long"),
    [
        ("m1-2.5.5-3e1L.5.5-.5.5", "M 1 -2.5 L 1.5 -32.5 L 0.5 0.5 L -0.5 0.5"),
        ("M1.,2.L1.e1-3", "M 1 2 L 10 -3"),
        ("M0 0a25,25-30 0150,25", "M 0 0 A 25 25 -30 0 1 50 25"),
        ("M0 0a25,25 0 11.5.5 6 4 0 0,0-3 1", "M 0 0 A 25 25 0 1 1 0.5 0.5 A 6 4 0 0 0 -2.5 1.5"),
        ("M1 2h3v-4H0V7", "M 1 2 L 4 2 L 4 -2 L 0 -2 L 0 7"),
        ("M0 0c1 2 3 4 5 0s1-1 2 3S9 9 8 4", "M 0 0 C 1 2 3 4 5 0 C 7 -4 6 -1 7 3 C 8 7 9 9 8 4"),
        ("M0 0q1 2 3 0t4 1T9 9", "M 0 0 Q 1 2 3 0 Q 5 -2 7 1 Q 9 4 9 9"),
        ("M0 0L1 2s1-1 2 3t1 1", "M 0 0 L 1 2 C 1 2 2 1 3 5 Q 3 5 4 6"),
        ("M1 1L3 1 3 3zl-2-1m1 1 0 5", "M 1 1 L 3 1 L 3 3 L 1 1 M 1 1 L -1 0 M 0 1 L 0 6"),
        ("M0 0A0 5 0 0 1 3 4A-5 5 0 0 1 9 4", "M 0 0 L 3 4 A 5 5 0 0 1 9 4"),
        ("M0 0A5 5 0 0 1 0 0L3 4", "M 0 0 L 3 4"),
    ],
)
def test_path_data_without_a_gap_more_than_it_needs(short: str, long: str) -> None:
    parts = [svgpathtools.parse_path("M" + part) for part in long.split("M")[1:]]
    wanted = [
        np.array(
            [s.point(i / 32) for s in part for i in ([0] if isinstance(s, svgpathtools.Line) else range(32))]
            + [part[-1].end]
        )
        for part in parts
    ]
    found = [line @ [1, -1j] for line in svg_lines(short).lines]
    closed = [abs(line[0] - line[-1]) < 1e-12 for line in wanted]
    assert svg_lines(short).closed.tolist() == closed
    for line, other, shut in zip(found, wanted, closed, strict=True):
        np.testing.assert_allclose(line, other[: len(other) - shut], atol=1e-12)


@pytest.mark.parametrize("seed", range(40))
def test_a_ring_of_steps_closes_without_a_sliver(seed: int) -> None:
    rng = np.random.default_rng(seed)
    angle = (np.arange(12) + 0.8 * rng.random(12)) * np.pi / 6
    ring = np.column_stack([np.cos(angle), np.sin(angle)]) * rng.uniform(5, 10, (12, 1)) + rng.normal(0, 30, 2)
    ring = ring.round(3)
    steps = np.roll(ring, -1, axis=0) - ring
    data = f"m{ring[0, 0]:.3f} {ring[0, 1]:.3f} " + " ".join(f"{x:.3f},{y:.3f}" for x, y in steps.tolist()) + "z"
    lines = svg_lines(data)
    assert lines.closed.all()
    np.testing.assert_allclose(lines.coords, ring * (1, -1), atol=1e-12)
    area = shapely.Polygon(ring).area
    region = as_region(lines.lines)
    assert shapely.Polygon(region.coords).area == pytest.approx(area, rel=1e-12)
    assert len(cz.maze(cz.sample.uniform(30, bounds=region.bounds, rng=1), within=region, rng=1).passages)


def test_subpaths_that_touch_stay_apart() -> None:
    lines = svg_lines("M0 0H10V10ZM0 0H-5")
    assert [len(line) for line in lines.lines] == [3, 2]
    assert lines.closed.tolist() == [True, False]


@pytest.mark.parametrize(
    ("radii", "wanted"),
    [('rx="99"', (5, 2)), ('rx="99" ry="1"', (5, 1)), ('ry="1.5"', (1.5, 1.5)), ('rx="0"', (0, 0)), ("", (0, 0))],
)
def test_corners_of_a_rectangle_are_round_by_half_a_side_at_most(radii: str, wanted: tuple[float, float]) -> None:
    found = points(f'<rect x="1" y="2" width="10" height="4" {radii}/>')
    rx, ry = wanted
    area = 10 * 4 - (4 - np.pi) * rx * ry
    assert shapely.Polygon(found).area == pytest.approx(area, rel=1e-3)
    np.testing.assert_allclose([found.min(axis=0), found.max(axis=0)], [(1, 2), (11, 6)], atol=1e-9)


def test_polygons_need_no_gap_between_numbers() -> None:
    assert points('<polygon points="0,0 10-5 10.5.5"/>').tolist() == [[0, 0], [10, -5], [10.5, 0.5]]


@pytest.mark.parametrize(
    "nothing",
    [
        '<circle r="0"/>',
        "<circle/>",
        '<ellipse rx="3" ry="0"/>',
        '<rect width="9"/>',
        '<rect width="9" height="-9"/>',
        '<path d="none"/>',
        '<polyline points=""/>',
        '<svg width="0" height="5" viewBox="0 0 1 1"><path d="M0 0H99V99"/></svg>',
        '<g visibility="hidden"><path d="M0 0H99V99"/></g>',
        '<g style="visibility : collapse !important"><g><path d="M0 0H99V99"/></g></g>',
        '<g display=" none "><path d="M0 0H99V99"/></g>',
    ],
)
def test_what_draws_nothing_is_left_out(nothing: str) -> None:
    assert points(f'{nothing}<path d="M0 0H1V1"/>').tolist() == [[0, 0], [1, 0], [1, 1]]


def test_what_is_seen_in_a_hidden_group_is_taken() -> None:
    inner = '<g visibility="hidden"><path style="visibility:visible" d="M0 0H1"/><path d="M5 5H6"/></g>'
    assert points(inner).tolist() == [[0, 0], [1, 0]]
    # The style goes before the attribute.
    assert len(points('<path display="none" style="display:inline" d="M0 0H1"/>')) == 2


@pytest.mark.parametrize(
    ("inner", "count"),
    [
        # The box about an icon of Material Design.
        ('<path d="M0 0h24v24H0z" fill="none"/>', 0),
        ('<rect width="9" height="9" style="fill: none; stroke: none"/>', 0),
        ('<g fill="none"><path d="M0 0H9V9z" stroke="transparent"/></g>', 0),
        ('<g fill="none" stroke="red"><path d="M0 0H9V9z"/></g>', 3),
        ('<g fill="none"><path d="M0 0H9V9z" style="stroke:#123"/></g>', 3),
        ('<g fill="none"><path d="M0 0H9V9z" fill="url(#a)"/></g>', 3),
        # The sheet may say that it has a stroke.
        ('<style>.a{stroke:red}</style><path class="a" fill="none" d="M0 0H9V9z"/>', 3),
    ],
)
def test_what_has_no_paint_is_not_displayed(inner: str, count: int) -> None:
    assert len(points(f'{inner}<path d="M0 0H1V1"/>')) == 3 + count


@pytest.mark.parametrize(
    ("transform", "wanted"),
    [
        ("translate(3-4)", [3, -4]),
        ("translate(.5.5)", [0.5, 0.5]),
        ("matrix(1 0 0-1 5-3)", [5, -3]),
        ("translate(1e1-2),scale(2)", [10, -2]),
    ],
)
def test_transforms_need_no_gap_between_numbers(transform: str, wanted: list[float]) -> None:
    assert points(f'<path transform="{transform}" d="M0 0H1"/>')[0].tolist() == wanted


def test_lengths_have_units_and_parts() -> None:
    rect = '<rect x="1in" y="10%" width="25.4mm" height="50%"/>'
    assert box(rect, 'viewBox="0 0 400 200"') == pytest.approx([96, 20, 192, 120])
    assert box(rect, 'width="200px" height="100"') == pytest.approx([96, 10, 192, 60])
    # Of both sides together, as the specification has it.
    assert box('<circle r="10%"/>', 'viewBox="0 0 300 400"')[2] == pytest.approx(np.sqrt((300**2 + 400**2) / 2) / 10)
    np.testing.assert_allclose(box('<line x1="3pt" y2="1pc" x2="1cm"/>'), [4, 0, 96 / 2.54, 16], atol=1e-12)


SQUARE = '<rect width="100" height="100"/>'


@pytest.mark.parametrize(
    ("inner", "wanted"),
    [
        # As browsers show it: the square of the view box in a room of 20 by 10 about (1, 2).
        ("", [6, 2, 16, 12]),
        ("xMinYMin", [1, 2, 11, 12]),
        ("xMaxYMid meet", [11, 2, 21, 12]),
        ("xMidYMin slice", [1, 2, 21, 22]),
        ("xMidYMid slice", [1, -3, 21, 17]),
        ("none", [1, 2, 21, 12]),
    ],
)
def test_a_view_box_keeps_its_ratio_as_it_is_told_to(inner: str, wanted: list[float]) -> None:
    ratio = f'viewBox="0 0 100 100" preserveAspectRatio="{inner}"'
    size = 'x="1" y="2" width="20" height="10"'
    assert box(f"<svg {size} {ratio}>{SQUARE}</svg>") == pytest.approx(wanted)
    symbol = f'<symbol id="a" {ratio}>{SQUARE}</symbol>'
    assert box(f'{symbol}<use href="#a" {size}/>') == pytest.approx(wanted)
    # What the copy says of width and height goes before what the picture does.
    own = f'<defs><svg id="a" width="7" height="10" {ratio}>{SQUARE}</svg></defs>'
    assert box(f'{own}<use href="#a" x="1" y="2" width="20"/>') == pytest.approx(wanted)
    # A picture that says nothing is as large as the one it is in.
    assert box(f"<svg {ratio}>{SQUARE}</svg>", 'viewBox="0 0 20 10"') == pytest.approx(np.array(wanted) - [1, 2, 1, 2])


@pytest.mark.parametrize("name", ["map.svg", "m1.svg", "Maze.SVG"])
def test_a_name_that_begins_with_m_is_no_path_data(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(FileNotFoundError):
        cz.sample.from_svg(name)
    Path(name).write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H4"/></svg>')
    assert cz.sample.from_svg(name).tolist() == [[0, 0], [4, 0]]


@pytest.mark.parametrize(
    ("inner", "message"),
    [
        ('<path d="M0 0 L 10"/>', "its end at character 9, where a number"),
        ('<path d="M0 0 foo"/>', "'foo' at character 5, where a number"),
        ('<path d="L1 1"/>', "'L1 1' at character 0, where M"),
        ('<path d="M0 0H1Z5"/>', "'5' at character 7, where a command"),
        ('<path d="M0 0A1 1 0 2 0 3 3"/>', "'2 0 3 3' at character 11, where 0 or 1"),
        ('<rect width="3em" height="2"/>', "width is '3em'; a number, alone or in"),
        ('<rect width="50%" height="2"/>', "width is '50%' of a picture whose size is not told"),
        ('<polygon points="0 0 1 1 2"/>', "points is '0 0 1 1 2'; pairs of numbers"),
    ],
)
def test_what_cannot_be_read_is_named(tmp_path: Path, inner: str, message: str) -> None:
    path = tmp_path / "wrong.svg"
    path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg">{inner}</svg>')
    with pytest.raises(ValueError, match=message):
        cz.sample.from_svg(path)
