"""Pictures of cracks and graphs."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

import crazing as cz

GOLDEN = Path(__file__).parent / "golden"
CLEAR = cz.Style(ink="#000", ground=None)


def graph(vertices, edges):
    return SimpleNamespace(
        vertices=np.array(vertices, dtype=float).reshape(-1, 2), edges=np.array(edges, dtype=np.int32)
    )


def crack(vertices, edges, width, bounds):
    return SimpleNamespace(graph=graph(vertices, edges), width=np.array(width, dtype=float), bounds=bounds)


def thicket(n, *, seed=0, bounds=(0, 0, 1, 1)):
    rng = np.random.default_rng(seed)
    start = rng.random((n, 2))
    ends = np.concatenate([start, start + rng.normal(size=(n, 2)) / np.sqrt(n)])
    edges = np.stack([np.arange(n), np.arange(n) + n], axis=1)
    return crack(ends, edges, rng.random((n, 2)) / np.sqrt(n) / 5, bounds)


def star():
    """Tapers of every direction that meet, one thick joint and one hairline."""
    angles = np.arange(12) / 12 * 2 * np.pi
    tips = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    edges = [[0, i + 1] for i in range(12)] + [[1, 2]]
    return crack([[0, 0], *tips], edges, [[0.2, 0.0]] * 12 + [[0.01, 0.01]], (-1.1, -1.1, 1.1, 1.1))


def test_shape_type_and_owner():
    picture = cz.render(star(), (20, 30))
    assert picture.shape == (20, 30, 4)
    assert picture.dtype == np.uint8
    assert picture.flags.c_contiguous and picture.flags.writeable


@pytest.mark.parametrize(
    ("name", "style"),
    [
        ("star", cz.Style()),
        ("star-clear", cz.Style(ink=(200, 30, 0, 160), ground=None)),
        ("star-least", cz.Style(ink="#fff", ground="#123", min_width=1.5)),
    ],
)
def test_golden(name, style):
    with Image.open(GOLDEN / f"{name}.png") as stored:
        wanted = np.asarray(stored)
    np.testing.assert_array_equal(cz.render(star(), 64, style=style), wanted)


def test_y_points_up():
    picture = cz.render(crack([[1, 1], [9, 1]], [[0, 1]], [[1, 1]], (0, 0, 10, 10)), 10, style=CLEAR)
    inked = np.flatnonzero(picture[..., 3].any(axis=1))
    assert inked.tolist() == [8, 9]


@pytest.mark.parametrize("threads", [1, 2, 5, None])
def test_threads_change_nothing(threads):
    net = thicket(4000)
    np.testing.assert_array_equal(cz.render(net, (600, 800), threads=threads), cz.render(net, (600, 800), threads=1))


def test_a_graph_is_drawn_at_a_pixel_and_a_half():
    line = graph([[0, 0], [100, 0]], [[0, 1]])
    picture = cz.render(line, 200, bounds=(-50, -100, 150, 100), style=CLEAR)
    assert picture[:, 100, 3].sum() / 255 == pytest.approx(1.5, abs=0.02)
    wide = cz.render(line, 200, bounds=(-50, -100, 150, 100), style=cz.Style(ground=None, width=10.0))
    assert wide[:, 100, 3].sum() / 255 == pytest.approx(10, abs=0.02)


def test_bounds_of_a_graph_hold_all_its_edges_and_no_more():
    far = graph([[0, 0], [2, 1], [1e9, np.inf]], [[0, 1]])
    picture = cz.render(far, (50, 100), style=CLEAR)
    rows, columns = np.nonzero(picture[..., 3])
    assert columns.min() in range(1, 4) and columns.max() in range(96, 99)
    assert rows.min() >= 1 and rows.max() <= 48


@pytest.mark.parametrize("place", [[0, 0], [1e15, -3], [1e-300, 0]])
def test_a_single_place_has_a_box(place):
    assert cz.render(graph([place, place], [[0, 1]]), 9, style=CLEAR)[4, 4, 3] == 255


def test_nothing_to_draw_is_all_ground():
    picture = cz.render(graph([], []), 70, style=cz.Style(ground="#0102037f"))
    assert (picture == [1, 2, 3, 127]).all()


def test_colours():
    square = crack([[0, 0], [0, 0]], [[0, 1]], [[99, 99]], (-1, -1, 1, 1))
    for ink, wanted in [
        ("#f80", [255, 136, 0, 255]),
        ("#f808", [255, 136, 0, 136]),
        ("#010203", [1, 2, 3, 255]),
        ((1, 2, 3, 4), [1, 2, 3, 4]),
        (np.array([1, 2, 3]), [1, 2, 3, 255]),
    ]:
        assert cz.render(square, 3, style=cz.Style(ink=ink, ground=None))[1, 1].tolist() == wanted
    half = cz.render(square, 3, style=cz.Style(ink="#ff000080", ground="#00f"))[1, 1].tolist()
    assert half == [128, 0, 127, 255]


@pytest.mark.parametrize(
    ("style", "error"),
    [
        ({"ink": "red"}, ValueError),
        ({"ink": "#12345"}, ValueError),
        ({"ink": None}, TypeError),
        ({"ink": (1, 2)}, ValueError),
        ({"ink": (1, 2, 256)}, ValueError),
        ({"ink": (1.0, 0.5, 0.0)}, TypeError),
        ({"ground": 7}, TypeError),
        ({"width": -1}, ValueError),
        ({"min_width": float("nan")}, ValueError),
    ],
)
def test_bad_styles(style, error):
    with pytest.raises(error, match=next(iter(style))):
        cz.Style(**style)


@pytest.mark.parametrize(
    ("change", "error", "words"),
    [
        ({"size": 1 << 16}, ValueError, "at most 1073741824"),
        ({"size": (0, 5)}, ValueError, "size"),
        ({"size": (1, 2, 3)}, ValueError, "size"),
        ({"bounds": (0, 0, 0, 1)}, ValueError, "bounds"),
        ({"bounds": (0, 0, 5e-324, 5e-324)}, ValueError, "floats can scale"),
        ({"threads": 0}, ValueError, "threads"),
        ({"style": "#fff"}, TypeError, "style"),
        ({"crack_or_graph": [1, 2]}, TypeError, "vertices and edges"),
        ({"crack_or_graph": graph([[0, 0]], [[0, 1]])}, ValueError, r"edges\[0\] is 1"),
        ({"crack_or_graph": graph([[0, 0]], [[0, -1]])}, ValueError, r"edges\[0\] is -1"),
        ({"crack_or_graph": SimpleNamespace(vertices=[[0, 0]], edges=[[0.5, 0]])}, ValueError, "integers"),
        ({"crack_or_graph": SimpleNamespace(vertices=[[0, 0]], edges=[[2**40, 0]])}, ValueError, "32 bits"),
        ({"crack_or_graph": graph([[np.nan, 0]], [[0, 0]])}, ValueError, r"vertices\[0\] holds NaN"),
        (
            {"crack_or_graph": crack([[0, 0]], [[0, 0]], [[1, -1]], (0, 0, 1, 1))},
            ValueError,
            r"widths\[0\] holds -1",
        ),
        ({"crack_or_graph": crack([[0, 0]], [[0, 0]], [1, 1], (0, 0, 1, 1))}, ValueError, "one row an edge"),
    ],
)
def test_bad_arguments(change, error, words):
    arguments = {"crack_or_graph": star(), "size": 8, **change}
    with pytest.raises(error, match=words):
        cz.render(arguments.pop("crack_or_graph"), arguments.pop("size"), **arguments)


def test_strided_and_swapped_arrays_are_read_right():
    net = thicket(50)
    odd = SimpleNamespace(
        graph=SimpleNamespace(
            vertices=net.graph.vertices.astype(">f8")[::-1][::-1],
            edges=np.asfortranarray(net.graph.edges.astype(np.uint64)),
        ),
        width=np.asfortranarray(net.width),
        bounds=list(net.bounds),
    )
    np.testing.assert_array_equal(cz.render(odd, 80), cz.render(net, 80))


LONG = """
import numpy as np, crazing as cz
from types import SimpleNamespace
n = 200_000
rng = np.random.default_rng(0)
graph = SimpleNamespace(vertices=rng.random((n, 2)), edges=rng.integers(0, n, (n, 2)).astype(np.int32))
print("start", flush=True)
cz.render(graph, 8192, style=cz.Style(width=0.05))
print("end", flush=True)
"""


def test_ctrl_c_stops_a_long_render():
    with subprocess.Popen(
        [sys.executable, "-c", LONG], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as child:
        assert child.stdout is not None and child.stdout.readline() == "start\n"
        time.sleep(1.0)
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=60)
    assert "KeyboardInterrupt" in err
    assert "end" not in out


def test_notebooks_show_pictures() -> None:
    def shown(content: bytes) -> np.ndarray:
        return np.array(Image.open(io.BytesIO(content)))

    crack = cz.crack(n=30, rng=1)
    assert np.array_equal(shown(crack._repr_png_()), cz.render(crack, 512))
    maps = cz.texture(crack, (40, 1500), maps="all")
    assert np.array_equal(shown(maps._repr_png_()), maps.lit()[::3, ::3])
    plain = cz.texture(crack, 32, maps="color")
    assert np.array_equal(shown(plain._repr_png_()), plain["color"])
    assert cz.texture(crack, 32, maps="height")._repr_png_() is None
    broken = cz.Crack(cz.PlanarGraph([(0, 0), (np.nan, 1)], [(0, 1)]), 0.1, 0, 0, (0, 0, 1, 1))
    assert broken._repr_png_() is None
    maze = cz.maze(cz.sample.uniform(30, rng=1), rng=1)
    assert maze._repr_svg_() == maze.walls.to_svg()
    assert maze.diagram._repr_svg_() == maze.diagram.delaunay.to_svg()
    assert cz.diagram([[0, 0], [0.1, 0.2], [0.3, 0]], period=(1, 1))._repr_svg_() is None


@pytest.mark.parametrize("preset", ["glaze", "mud-mature"])
def test_a_periodic_crack_is_drawn_over_its_seams(preset: str) -> None:
    """Edges that leave the period once ran back across all of it, in notebooks too."""
    c = cz.crack(preset=preset, n=40, period=(2, 1), rng=2)
    one = cz.render(c, (120, 240))[..., 0].astype(int)
    # The widths of textures are covered by other code; both are dark where there is crack.
    mask = cz.texture(c, (120, 240), maps=["mask"])["mask"]
    assert abs(float((244 - one).mean() / (244 - 43) - mask.mean() / 255)) < 0.005
    four = cz.render(c, (240, 480), bounds=(0, 0, 4, 2))[..., 0].astype(int)
    assert np.abs(four - np.tile(one, (2, 2))).max() <= 4
    # Beside bounds of another shape the pattern goes on.
    wide = cz.render(c, (120, 480), bounds=(0, 0, 2, 1))[..., 0].astype(int)
    assert np.abs(wide - np.tile(one, (1, 3))[:, 120:600]).max() <= 4
    with pytest.raises(ValueError, match="bounds show"):
        cz.render(c, 8, bounds=(0, 0, 1e9, 1e9))


def test_styles_compare_whatever_their_colours_came_in() -> None:
    style = cz.Style(ink=(1, 2, 3), ground=(4, 5, 6, 7))
    for form in (list, np.array):
        other = cz.Style(ink=form([1, 2, 3]), ground=form([4, 5, 6, 7]))
        assert other == style and hash(other) == hash(style) and repr(other) == repr(style)


@pytest.mark.parametrize("kind", [list, np.array, iter])
def test_colours_of_any_kind_make_equal_styles(kind) -> None:
    assert cz.Style(ink=kind((1, 2, 3)), ground=kind((9, 8, 7, 6))) == cz.Style(ink=(1, 2, 3), ground=(9, 8, 7, 6))
