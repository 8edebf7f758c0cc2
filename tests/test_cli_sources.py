"""What the commands read: tables as people write them, polygons, drawings, and what holds nothing."""

from __future__ import annotations

import json
import os
import threading
import warnings
from pathlib import Path

import numpy as np
import pytest

import crazing as cz
from command_line import refused, run

Image = pytest.importorskip("PIL.Image")
svgpathtools = pytest.importorskip("svgpathtools")


def ring() -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    return np.column_stack([2 * np.cos(t), np.sin(t)])


def lines(form: str, head: str = "") -> bytes:
    return (head + "\n".join(form.format(i=i, x=x, y=y) for i, (x, y) in enumerate(ring().tolist()))).encode()


TABLES: dict[str, bytes] = {
    "plain": lines("{x},{y}"),
    "names": lines("{x},{y}", "x,y\n"),
    "numbered": lines("{i},{x},{y}", "id,x,y\n"),
    "by tabs, turned round": lines("{i}\t{y}\t{x}", "id\tY\tX\n"),
    "by longitude and latitude": lines('"{i}";{y};{x};', '"name";"lat";"lon";\n'),
    "with remarks": lines("{x} {y}", "# two columns\n\n"),
    "decimal commas": lines("{x};{y}").replace(b".", b","),
    "UTF-16": lines("{x},{y}", "x,y\n").decode().encode("utf-16"),
    "byte order mark and carriage returns": b"\xef\xbb\xbf" + lines("{x};{y}", "x;y\n").replace(b"\n", b"\r\n"),
}


@pytest.mark.parametrize("name", TABLES)
def test_tables_are_read_as_people_write_them(name: str, tmp_path: Path) -> None:
    source = tmp_path / "points.csv"
    source.write_bytes(TABLES[name])
    result = run("skeleton", str(source), "--json", "-o", str(tmp_path / "out.svg"))
    found = json.loads(result.stdout)
    assert (found["samples"], found["components"], found["leaves"]) == (60, 1, 2)
    assert found["length"] == pytest.approx(2.99, abs=0.05)


def test_structured_arrays_have_columns_x_and_y(tmp_path: Path) -> None:
    rows = np.array([(i, y, x) for i, (x, y) in enumerate(ring())], dtype=[("i", "i4"), ("y", "f8"), ("x", "f8")])
    np.save(tmp_path / "points.npy", rows)
    result = run("skeleton", str(tmp_path / "points.npy"), "--json", "-o", str(tmp_path / "out.svg"))
    assert json.loads(result.stdout)["leaves"] == 2


def test_polygons_are_sampled_along_their_outline(tmp_path: Path) -> None:
    corners = [[0, 0], [8, 0], [8, 2], [0, 2], [0, 0]]
    feature = {"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates": [corners]}}
    source = tmp_path / "box.geojson"
    source.write_text(json.dumps({"type": "FeatureCollection", "features": [feature]}), encoding="utf-8-sig")
    for more, samples in [((), 1000), (("--points", "300"), 300), (("--spacing", "0.1"), 200)]:
        result = run("skeleton", str(source), "--json", *more, "-o", str(tmp_path / "out.svg"))
        found = json.loads(result.stdout)
        assert (found["samples"], found["components"], found["leaves"]) == (samples, 1, 4)


REFUSED = {
    "nothing": (b"", "holds no points"),
    "no features": (b'{"type": "FeatureCollection", "features": []}', "holds no points"),
    "junk": (bytes(range(256)), "this is no CSV, NPY, GeoJSON or SVG"),
    "text": (b"x,y\n1,2\n3,four\n", "line 3 is '3,four'; two numbers are wanted"),
    "one column": (b"x\n1\n2\n", "line 1 is 'x'; two numbers are wanted"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_what_holds_no_points_is_named(name: str, tmp_path: Path) -> None:
    content, message = REFUSED[name]
    source = tmp_path / "points"
    source.write_bytes(content)
    refused(run("skeleton", source, "-o", tmp_path / "out.svg"), message)


def test_files_without_end_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("crazing.cli.source.MOST", 1000)
    (tmp_path / "points.csv").write_bytes(b"1,2\n" * 251)
    refused(run("skeleton", tmp_path / "points.csv", "-o", tmp_path / "out.svg"), "holds more than 1000 bytes")


RING = "M0 0H100V100H0Z M40 40H60V60H40Z"


def shape(kind: str, folder: Path) -> Path:
    """A square with a square hole, in one of the files that hold shapes."""
    path = folder / f"shape.{kind}"
    if kind == "svg":
        path.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{RING}"/></svg>')
    elif kind == "geojson":
        rings = [[[0, 0], [100, 0], [100, 100], [0, 100], [0, 0]], [[40, 40], [60, 40], [60, 60], [40, 60], [40, 40]]]
        path.write_text(json.dumps({"type": "Polygon", "coordinates": rings}))
    else:
        pixels = np.pad(np.full((100, 100), 255, np.uint8), 4)
        pixels[44:64, 44:64] = 0
        Image.fromarray(pixels).save(path)
    return path


@pytest.mark.parametrize("kind", ["png", "svg", "geojson"])
@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
def test_mazes_fill_the_shape_in_any_file(kind: str, cells: str, tmp_path: Path) -> None:
    path = tmp_path / "maze.svg"
    more = ("-n", 300, "--seed", 1, "--cells", cells, "--page", 120, 120, "--margin", 10, "--pen", 0.25)
    result = run("maze", "--within", shape(kind, tmp_path), *more, "-o", path)
    assert result.exit_code == 0, result.output
    assert result.stdout.endswith("seed 1\n")
    drawn = path.read_text()
    assert 'width="120mm"' in drawn
    assert 'stroke-width="0.25"' in drawn
    places = [line for group in svgpathtools.svg2paths(path)[0] for line in group]
    inside = [p for line in places for p in (line.start, line.end) if 50.5 < p.real < 69.5 and 50.5 < p.imag < 69.5]
    assert len(places) > 100
    assert not inside


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
def test_a_maze_and_its_solution_stay_on_the_page(cells: str, tmp_path: Path) -> None:
    path = tmp_path / "maze.svg"
    more = ("--cells", cells, "--page", 120, 120, "--margin", 10, "--solution")
    for seed in range(3, 6):
        assert run("maze", "-n", 150, "--seed", seed, *more, "-o", path).exit_code == 0
        lines = [line for group in svgpathtools.svg2paths(path)[0] for line in group]
        places = np.array([p for line in lines for p in (line.start, line.end)])
        sides = np.stack([places.real, places.imag])
        assert sides.min() == pytest.approx(10) and sides.max() == pytest.approx(110)
        # The frame, but for entrance and exit.
        along = [line for line in lines if {line.start.real, line.end.real} <= {10.0, 110.0}]
        along += [line for line in lines if {line.start.imag, line.end.imag} <= {10.0, 110.0}]
        assert sum(abs(line.end - line.start) for line in along) > 320


def test_an_opening_shuts_doors(tmp_path: Path) -> None:
    path = tmp_path / "maze.svg"
    whole = run("maze", "-n", 200, "--seed", 1, "-o", path).stdout
    half = run("maze", "-n", 200, "--seed", 1, "--opening", 0.5, "-o", path).stdout
    assert whole != half
    assert ", no solution, seed 1" in run("maze", "-n", 200, "--seed", 1, "--opening", 0, "-o", path).stdout
    refused(run("maze", "--opening", 2, "-o", path), "--opening")


def test_a_shape_of_nothing_is_named(tmp_path: Path) -> None:
    path = tmp_path / "white.png"
    Image.new("L", (50, 50), 255).save(path)
    refused(run("maze", "--within", path, "-o", tmp_path / "maze.svg"), "white.png has nothing inside")


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
@pytest.mark.parametrize("kind", ["png", "svg", "geojson"])
@pytest.mark.parametrize("words", [("skeleton",), ("maze", "--seed", 1, "--within")])
def test_shapes_come_through_a_pipe(kind: str, words: tuple[object, ...], tmp_path: Path) -> None:
    """A shell's `<(...)` gives its bytes once."""
    path, pipe = shape(kind, tmp_path), tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=lambda: pipe.write_bytes(path.read_bytes()), daemon=True)
    writer.start()
    result = run(*words, pipe, "-o", tmp_path / "piped.svg")
    assert result.exit_code == 0, result.output
    run(*words, path, "-o", tmp_path / "plain.svg")
    assert (tmp_path / "piped.svg").read_bytes() == (tmp_path / "plain.svg").read_bytes()


@pytest.mark.parametrize("words", [("skeleton",), ("maze", "--within")])
def test_pictures_that_are_none_are_named(words: tuple[object, ...], tmp_path: Path) -> None:
    path = tmp_path / "torn.png"
    path.write_bytes(shape("png", tmp_path).read_bytes()[:60])
    refused(run(*words, path, "-o", tmp_path / "out.svg"), "torn.png cannot be read as a picture")


def test_a_shape_of_lines_is_named(tmp_path: Path) -> None:
    path = tmp_path / "way.geojson"
    path.write_text(json.dumps({"type": "LineString", "coordinates": [[0, 0], [1, 0], [1, 1]]}))
    message = "way.geojson is a geometry of type 'LineString'; Polygon"
    refused(run("maze", "--within", path, "-o", tmp_path / "maze.svg"), message)


@pytest.mark.parametrize(("page", "found"), [((0, 9), "page is (0.0, 9.0)"), (("nan", 9), "page[0] is nan")])
def test_a_page_of_nothing_is_named(page: tuple[object, object], found: str, tmp_path: Path) -> None:
    refused(run("maze", "--page", *page, "-o", tmp_path / "maze.svg"), found)


def test_drawings_in_any_encoding(tmp_path: Path) -> None:
    text = f'<svg xmlns="http://www.w3.org/2000/svg"><title>Überzug</title><path d="{RING}"/></svg>'
    path, expected = tmp_path / "shape.svg", cz.sample.from_svg(RING)
    for encoding in ("utf-8", "utf-8-sig", "utf-16", "latin-1"):
        path.write_bytes(f'<?xml version="1.0" encoding="{encoding.removesuffix("-sig")}"?>{text}'.encode(encoding))
        np.testing.assert_array_equal(cz.sample.from_svg(path), expected)


def test_drawings_whose_names_have_a_prefix(tmp_path: Path) -> None:
    path = tmp_path / "prefixed.svg"
    path.write_text(f'<svg:svg xmlns:svg="http://www.w3.org/2000/svg"><svg:path d="{RING}"/></svg:svg>')
    plain = tmp_path / "plain.svg"
    plain.write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{RING}"/></svg>')
    for source in (path, plain):
        assert run("skeleton", source, "-o", source.with_suffix(".geojson")).exit_code == 0
    assert path.with_suffix(".geojson").read_bytes() == plain.with_suffix(".geojson").read_bytes()


def test_a_drawing_without_end_is_one_line(tmp_path: Path) -> None:
    path = tmp_path / "far.svg"
    path.write_text('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0L1e999 0L10 10Z"/></svg>')
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        refused(run("skeleton", path, "-o", tmp_path / "out.svg"), "nan or infinity")
