"""Mazes on paper: every format holds the walls, once, in millimetres, in an order a plotter likes."""

from __future__ import annotations

import re
from itertools import pairwise
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from click.testing import CliRunner
from matplotlib.figure import Figure
from PIL import Image

import crazing as cz
from crazing.cli import main
from crazing.sheet import ordered


@pytest.fixture(scope="module")
def maze() -> cz.Maze:
    return cz.maze(cz.sample.uniform(300, rng=1), bounds=(0, 0, 1, 1), rng=1)


def read_svg(path: Path) -> dict[str, list[np.ndarray]]:
    layers = {}
    for name, content in re.findall(r'<g id="(\w+)".*?<path d="(.*?)"/>', path.read_text(), flags=re.DOTALL):
        lines = [np.array([p.split(" ") for p in line.split("L")], dtype=float) for line in content.split("M")[1:]]
        layers[name] = lines
    return layers


def length(lines: list[np.ndarray]) -> float:
    return sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in lines)


@pytest.mark.parametrize("page", [(210, 297), (50, 20)])
def test_svg_holds_the_walls_in_the_page(maze: cz.Maze, page: tuple[float, float], tmp_path: Path) -> None:
    maze.save(tmp_path / "m.svg", page=page, margin=4)
    assert (
        f'width="{page[0]}mm" height="{page[1]}mm" viewBox="0 0 {page[0]} {page[1]}"'
        in (tmp_path / "m.svg").read_text()
    )
    lines = read_svg(tmp_path / "m.svg")["walls"]
    points = np.concatenate(lines)
    assert points.min() >= 4 - 1e-3 and (points <= np.array(page) - 4 + 1e-3).all()
    drawn = maze.walls.vertices[np.unique(maze.walls.edges)]
    scale = min((np.array(page) - 8) / np.ptp(drawn, axis=0))
    assert length(lines) == pytest.approx(maze.walls.length * scale, rel=1e-3)


def test_no_line_is_drawn_twice_and_the_pen_travels_little(tmp_path: Path) -> None:
    m = cz.maze(cz.sample.uniform(2000, rng=3), within=[(0, 0), (1, 0), (1, 1), (0, 1)], rng=3)
    m.save(tmp_path / "m.svg")
    lines = read_svg(tmp_path / "m.svg")["walls"]
    segments = np.concatenate([np.stack([line[:-1], line[1:]], axis=1) for line in lines])
    assert len(np.unique(np.sort(segments, axis=1), axis=0)) == len(segments)
    travel = sum(np.linalg.norm(b[0] - a[-1]) for a, b in pairwise(lines))
    shuffled = [lines[i] for i in np.random.default_rng(1).permutation(len(lines))]
    aimless = sum(np.linalg.norm(b[0] - a[-1]) for a, b in pairwise(shuffled))
    assert travel < aimless / 10


def test_ordered_keeps_every_line_once() -> None:
    rng = np.random.default_rng(2)
    lines = [rng.random((rng.integers(2, 5), 2)) ** 3 for _ in range(300)]
    found = ordered(lines)
    assert sorted(min(x.tolist(), x[::-1].tolist()) for x in found) == sorted(
        min(x.tolist(), x[::-1].tolist()) for x in lines
    )
    assert ordered([]) == []
    same = [np.zeros((2, 2))] * 3
    assert len(ordered(same)) == 3


def test_dxf_has_layers_in_millimetres(maze: cz.Maze, tmp_path: Path) -> None:
    maze.save(tmp_path / "m.dxf", solution=True)
    drawing = ezdxf.readfile(tmp_path / "m.dxf")
    assert drawing.units == ezdxf.units.MM
    layers = [line.dxf.layer for line in drawing.modelspace()]
    assert {"WALLS", "SOLUTION"} == set(layers)
    assert layers.count("SOLUTION") == 1


def test_pdf_and_png_are_pages(maze: cz.Maze, tmp_path: Path) -> None:
    maze.save(tmp_path / "m.pdf", page=(100, 50), solution=True)
    content = (tmp_path / "m.pdf").read_bytes()
    width, height = re.search(rb"/MediaBox \[ ?0 0 ([\d.]+) ([\d.]+)", content).groups()
    assert (float(width), float(height)) == pytest.approx((100 / 25.4 * 72, 50 / 25.4 * 72), abs=0.1)
    maze.save(tmp_path / "again.pdf", page=(100, 50), solution=True)
    assert (tmp_path / "again.pdf").read_bytes() == content
    maze.save(tmp_path / "m.png", page=(50.8, 25.4), solution=True)
    with Image.open(tmp_path / "m.png") as picture:
        assert picture.size == (600, 300)
        assert np.asarray(picture)[..., :3].min() < 50


def test_thick_walls_are_closed_outlines_of_that_thickness(maze: cz.Maze, tmp_path: Path) -> None:
    maze.save(tmp_path / "m.svg", thickness=1.0, margin=5)
    rings = read_svg(tmp_path / "m.svg")["walls"]
    assert all((ring[0] == ring[-1]).all() for ring in rings)
    points = np.concatenate(rings)
    assert points[:, 0].min() >= 5 - 2e-3 and points[:, 0].max() <= 205 + 2e-3


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
def test_the_solution_meets_no_wall(cells: str) -> None:
    m = cz.maze(cz.sample.uniform(500, rng=8), cells=cells, rng=8)
    way = m.longest()
    line = shapely.linestrings(m.path(way).segments)
    crossed = shapely.STRtree(shapely.linestrings(m.walls.segments)).query(line, predicate="crosses")
    assert crossed.shape[1] == 0
    with pytest.raises(ValueError, match="no open door joins them"):
        m.path([way[0], way[-1]])


def test_plot_and_statistics(maze: cz.Maze) -> None:
    ax = maze.plot(Figure().subplots(), solution=True, distances=True, color="black")
    assert len(ax.collections) == 3
    found = maze.statistics
    doors = np.bincount(maze.passages.ravel())
    assert (found.cells, found.dead_ends, found.junctions) == (300, (doors == 1).sum(), (doors > 2).sum())
    assert found.solution == len(maze.longest())
    assert found.winding > 1
    torus = cz.maze(maze.diagram.sites, period=(1, 1), rng=1)
    torus.plot(Figure().subplots(), solution=True)
    assert torus.path(torus.longest()).length > 1


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"page": (10, 10)}, "margin is 10.0"),
        ({"page": 7}, "page is 7"),
        ({"pen": -1}, "pen is -1.0"),
        ({"thickness": 0}, "thickness is 0.0"),
        ({"solution": [0, 299]}, "no open door|way goes"),
    ],
)
def test_bad_pages_are_named(maze: cz.Maze, words: dict, message: str, tmp_path: Path) -> None:
    with pytest.raises((TypeError, ValueError), match=message):
        maze.save(tmp_path / "m.svg", **words)
    with pytest.raises(ValueError, match=r"an ending of \.svg, \.dxf"):
        maze.save(tmp_path / "m.jpg")
    assert list(tmp_path.iterdir()) == []


def test_the_command_fills_the_shape_of_a_picture(tmp_path: Path) -> None:
    y, x = np.mgrid[:120, :160]
    disc = (x - 80) ** 2 + (y - 60) ** 2 < 50**2
    Image.fromarray(np.where(disc, 30, 255).astype(np.uint8)).save(tmp_path / "leaf.png")
    words = [
        "maze",
        "--within",
        tmp_path / "leaf.png",
        "--solution",
        "--seed",
        7,
        "-n",
        400,
        "-o",
        tmp_path / "leaf.svg",
    ]
    result = CliRunner().invoke(main, [str(word) for word in words])
    assert result.exit_code == 0, result.output
    assert re.search(r"\d+ cells, \d+ dead ends, .* seed 7", result.stdout)
    first = (tmp_path / "leaf.svg").read_bytes()
    assert set(read_svg(tmp_path / "leaf.svg")) == {"walls", "solution"}
    CliRunner().invoke(main, [str(word) for word in words])
    assert (tmp_path / "leaf.svg").read_bytes() == first
    triangles = CliRunner().invoke(main, [*(str(word) for word in words), "--cells", "delaunay"])
    assert triangles.exit_code == 0, triangles.output
    assert 300 < int(re.search(r"(\d+) cells", triangles.stdout)[1]) < 700
    plain = CliRunner().invoke(main, ["maze", "--seed", "1", "-n", "50", "-o", str(tmp_path / "m.dxf")])
    assert plain.exit_code == 0, plain.output
    coloured = CliRunner().invoke(main, [*(str(word) for word in words), "--distances"])
    assert coloured.exit_code == 0, coloured.output
    assert 'id="distances"' in (tmp_path / "leaf.svg").read_text()
    for bad in (
        ["-o", "m.dxf", "--distances"],
        ["-o", "m.jpg"],
        ["-o", "m.svg", "-n", "2"],
        ["-o", "m.svg", "--within", "none.png"],
    ):
        refused = CliRunner().invoke(main, ["maze", *bad])
        assert refused.exit_code == 2
        assert refused.stderr.startswith("Error: ") and refused.stderr.count("\n") == 1
