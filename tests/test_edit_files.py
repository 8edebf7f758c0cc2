"""Files that the editor takes and gives: points, pictures, drawings."""

from __future__ import annotations

import io
import json
import re
import zlib
from typing import Any
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays
from numpy.typing import NDArray
from PIL import Image

import crazing as cz
from crazing.edit import exchange, knobs, layers, samples
from crazing.edit.session import Session
from edit_messages import MODES, STAR, Points, asked, good, points_in, raw

FINITE = st.floats(-1e300, 1e300, allow_nan=False)
POINTS = arrays.arrays(np.float64, st.tuples(st.integers(0, 30), st.just(2)), elements=FINITE)
EDGES = np.array([(0.1, -0.0), (5e-324, -1e300), (1 / 3, 2.0**53 + 2)])


# ---- files of points


@settings(deadline=None)
@given(points=POINTS, ending=st.sampled_from(exchange.FORMATS))
@example(points=EDGES, ending="csv")
@example(points=EDGES, ending="npy")
@example(points=EDGES, ending="svg")
@example(points=EDGES, ending="geojson")
def test_points_come_back_to_the_last_bit(points: Points, ending: str) -> None:
    assert exchange.load(exchange.written(points, ending)).tobytes() == points.tobytes()


def test_other_programs_read_the_files() -> None:
    content = {ending: exchange.written(STAR, ending) for ending in exchange.FORMATS}
    table = np.loadtxt(io.BytesIO(content["csv"]), delimiter=",", skiprows=1)
    circles = ElementTree.fromstring(content["svg"]).iter("{http://www.w3.org/2000/svg}circle")
    assert np.array_equal(table, STAR)
    assert np.array_equal(np.load(io.BytesIO(content["npy"]), allow_pickle=False), STAR)
    assert json.loads(content["geojson"])["geometry"]["coordinates"] == STAR.tolist()
    assert [[float(c.get("cx", "")), -float(c.get("cy", ""))] for c in circles] == STAR.tolist()


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (b"x;y\r\n1;2\r\n\r\n3;4\r\n", [[1, 2], [3, 4]]),
        (b"\xef\xbb\xbf1 2 9\n3\t4\t9", [[1, 2], [3, 4]]),
        (b"", []),
        (b'{"type": "Point", "coordinates": [1, 2, 9]}', [[1, 2]]),
        (
            b'{"type": "FeatureCollection", "features": [{"geometry": {"type": "Polygon", '
            b'"coordinates": [[[1, 2], [3, 4]]]}}, {"geometry": null}, '
            b'{"geometry": {"geometries": [{"coordinates": [5, 6]}]}}]}',
            [[1, 2], [3, 4], [5, 6]],
        ),
    ],
)
def test_forms_of_other_programs_are_read(content: bytes, wanted: list[list[float]]) -> None:
    assert exchange.load(content).tolist() == wanted


@pytest.mark.parametrize(
    "content",
    [
        b"point id,x,y,z\n7,1,2.5,9\n8,3,4,9\n",
        b"note,x,y,z\n,1,2.5,9\n,3,4,9\n",
        b"name,x,y\nNew York,1,2.5\nRome,3,4\n",
        b'name,x,y\n"Smith, J; 5",1,2.5\n"a ""b"", c",3,4\n',
        b'"x","y"\n"1","2.5"\n"3","4"\n',
        b'"1" "2.5"\n  3   "4"\n',
        b"x\ty\n1,0\t2,5\n3,0\t4,0\n",
        b"1,\t2,5\n\n3,\t4\n,,\n",
        b"lat,long\n2.5,1\n4,3\n",
        b"OBJECTID,POINT_X,POINT_Y\n7,1,2.5\n8,3,4\n",
        "Größe,x,y\n7,1,2.5\n8,3,4\n".encode("latin-1"),
    ],
)
def test_columns_are_those_that_the_names_say(content: bytes) -> None:
    assert exchange.load(content).tolist() == [[1, 2.5], [3, 4]]


@pytest.mark.parametrize(
    ("content", "line"),
    [
        # Ways to write numbers that leave it open which these are.
        (b"1,5 2,5\n3,5 4,5\n", 1),
        (b"1 2, 3 4\n5 6, 7 8\n", 2),
        (b"x,y\n1_0,2\n", 2),
        # A line of numbers, one of them amiss, is no line of names.
        (b"\t1\t2\n3\t4\n", 1),
        (b"1.000,5;2\n3;4\n", 1),
        (b"-,3\n1,2\n", 1),
        (b"id,x,y\n1,,3\n", 2),
        (b'"' + b"a" * 200_000 + b'",1\n', 1),
    ],
)
def test_lines_that_are_no_two_numbers_are_named(content: bytes, line: int) -> None:
    with pytest.raises(cz.CrazingError, match=f"line {line} is .*; two numbers are wanted"):
        exchange.load(content)


def npy(array: NDArray[Any]) -> bytes:
    file = io.BytesIO()
    np.save(file, array)
    return file.getvalue()


PROMISE = np.lib.format.magic(1, 0) + (118).to_bytes(2, "little")
PROMISE += b"{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999, 2), }".ljust(117) + b"\n"
DEEP = b"[" * 100_000
LAUGHS = (
    b'<!DOCTYPE svg [<!ENTITY a "aaaa">]><svg xmlns="http://www.w3.org/2000/svg"><g id="crazing-points">&a;</g></svg>'
)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"1,2\n3,four", "line 2 is '3,four'"),
        (b"1,2\n3", "line 2 is '3'"),
        (b"1,nan", r"points\[0\] is \(1.0, nan\)"),
        (PROMISE, "header does not fit"),
        (npy(np.array([{}], dtype=object)), "NPY file cannot be read|does not fit"),
        (npy(np.zeros((3, 3))), r"shape \(3, 3\)"),
        (npy(np.zeros((3, 2)))[:-1], "does not fit"),
        (b"\x93NUMPY\x09\x00", "NPY file cannot be read"),
        (DEEP, "GeoJSON cannot be read"),
        (b'{"coordinates": ["a", 1]}', "where positions are wanted"),
        (b'{"coordinates": [1e999, 1]}', "finite"),
        (b"<svg", "SVG cannot be read"),
        (LAUGHS, "document type"),
        (b'<svg><g id="crazing-points"><circle cx="a"/></g></svg>', "no position"),
        (b"\xff\xfe\x00\x01", "no CSV, NPY, GeoJSON or SVG"),
    ],
)
def test_damaged_files_get_one_clear_error(content: bytes, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        exchange.load(content)


def test_too_many_points_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(exchange, "MOST_POINTS", 3)
    with pytest.raises(cz.CrazingError, match="at most 3"):
        exchange.checked(np.zeros((4, 2)))
    with pytest.raises(cz.CrazingError, match="more than 3"):
        exchange.load(b"1,2\n" * 4)


# ---- samplers and pictures


def test_a_poisson_disk_sample_is_as_large_as_asked() -> None:
    for n in (50, 2000):
        points = points_in(good(Session(), "sample", sampler="poisson_disk", n=n, seed=2))
        assert abs(len(points) - n) < 0.15 * n
        # None is nearer to another than five sixths of the step of a square grid of as many.
        away = np.hypot(*np.diff(cz.diagram(points).delaunay.segments, axis=1)[:, 0].T).min()
        assert away > 0.83 * n**-0.5


@pytest.mark.parametrize("name", ["uniform", "normal", "laplace"])
def test_samplers_are_those_of_the_library(name: str) -> None:
    reply = good(Session(), "sample", sampler=name, n=40, seed=5)
    assert np.array_equal(points_in(reply), getattr(cz.sample, name)(40, rng=5))
    assert reply.content["source"] == {"sampler": name, "n": 40, "seed": 5}


@pytest.mark.parametrize("name", samples.OUTLINES)
def test_outlines_are_closed_curves(name: str) -> None:
    points = samples.points_of(name, 200, 0)
    assert set(cz.curve(points).degrees.tolist()) == {2}


def disc(size: int = 200, radius: float = 60.0) -> bytes:
    row, column = np.mgrid[:size, :size] + 0.5
    inside = np.hypot(row - size / 2, column - size / 2) < radius
    file = io.BytesIO()
    Image.fromarray((255 * ~inside).astype(np.uint8)).save(file, "PNG")
    return file.getvalue()


def test_a_picture_gives_its_contour() -> None:
    session = Session()
    assert good(session, "load", [disc()]).content == {
        "kind": "picture", "width": 200, "height": 200, "of": "load", "serial": 1,
    }  # fmt: skip
    plain = points_in(good(session, "contour", n=100))
    wanted = cz.sample.from_image(np.asarray(Image.open(io.BytesIO(disc()))), n=100)
    assert np.array_equal(plain, wanted)
    smooth = points_in(good(session, "contour", n=100, smoothing=4))
    away = [np.abs(np.hypot(*(points - 100).T) - 60) for points in (plain, smooth)]
    assert away[1].max() < away[0].max()
    assert away[1].max() < 1
    rings = points_in(good(session, "contour", n=99, smoothing=6, levels=3, spread=0.8))
    radii = np.hypot(*(rings - 100).T)
    assert np.ptp(radii) > 4


def test_a_picture_gives_points_by_its_brightness() -> None:
    session = Session()
    good(session, "load", [disc()])
    asking = {"way": "by brightness", "n": 500, "seed": 4}
    dark = points_in(good(session, "contour", **asking))
    light = points_in(good(session, "contour", **asking, dark=False))
    assert (len(dark), len(light)) == (500, 500)
    inside = [np.hypot(*(points - 100).T) < 61 for points in (dark, light)]
    assert inside[0].all()
    assert not inside[1][np.hypot(*(light - 100).T) < 59].any()
    again = points_in(good(session, "contour", **asking))
    other = points_in(good(session, "contour", **{**asking, "seed": 5}))
    assert np.array_equal(dark, again) and not np.array_equal(dark, other)
    # The contour's own knobs are nothing to it, and a picture without any dark is told so.
    assert np.array_equal(points_in(good(session, "contour", **asking, level=0.9, levels=4)), dark)
    white = io.BytesIO()
    Image.new("L", (20, 20), 255).save(white, "PNG")
    good(session, "load", [white.getvalue()])
    assert asked(session, "contour", **asking).content["kind"] == "error"


def test_a_large_picture_is_traced_smaller_and_placed_at_its_size() -> None:
    session = Session()
    good(session, "load", [disc(2050, 800)])
    radii = np.hypot(*(points_in(good(session, "contour", n=300)) - 1025).T)
    assert np.abs(radii - 800).max() < 3


def test_hostile_pictures_are_refused() -> None:
    header = io.BytesIO()
    Image.new("1", (8, 8)).save(header, "PNG")
    bomb = bytearray(header.getvalue())
    bomb[16:24] = (60_000).to_bytes(4, "big") * 2
    bomb[29:33] = zlib.crc32(bytes(bomb[12:29])).to_bytes(4, "big")
    session = Session()
    assert re.search("pixels.*(at most|exceeds)", asked(session, "load", [bytes(bomb)]).content["message"])
    assert "cannot be read" in asked(session, "load", [disc()[:300]]).content["message"]
    assert "no picture" in asked(session, "contour").content["message"]
    for content in (b"%PDF-1.4\xff\xfe", b"GIF8\x00", b"\x89PNG\r\n\x1a\n", b"BMxxxxxxxx", b"II*\x00\x00\x00\x00\x00"):
        assert asked(session, "load", [content]).content["kind"] == "error"


def test_a_drawing_of_others_is_left_to_the_browser() -> None:
    other = (
        b'<?xml version="1.0"?><svg xmlns="http://www.w3.org/2000/svg"><script>alert(1)</script><path d="M0 0"/></svg>'
    )
    assert good(Session(), "load", [other]).content["kind"] == "drawing"


# ---- what can be taken away


@pytest.mark.parametrize("mode", MODES)
def test_svg_and_dxf_hold_the_layers(mode: str) -> None:
    session = Session()
    values = knobs.read({"skeleton": {"poles": True, "nested": True, "delaunay": True, "iterations": 2}})
    drawing = layers.draw(STAR, mode, values[mode])
    svg = good(session, "export", raw(STAR), mode=mode, values=values, what="svg").buffers[0]
    groups = {g.get("id"): g for g in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}g")}
    dxf = good(session, "export", raw(STAR), mode=mode, values=values, what="dxf").buffers[0]
    document = ezdxf.read(io.StringIO(dxf.decode()))
    assert not document.audit().errors
    space = document.modelspace()
    lines = {layer.name: layer for layer in drawing.layers if layer.name in groups and layer.graph is not None}
    assert set(groups) == {"points", *lines, *(layer.name for layer in drawing.layers if layer.marks is not None)}
    for name, layer in lines.items():
        assert layer.graph is not None
        coords, offsets = layer.graph.polylines()
        found = re.findall(r"M([^M]*)", groups[name][0].get("d", ""))
        drawn = [np.array(part.replace("L", " ").split(), dtype=float).reshape(-1, 2) * (1, -1) for part in found]
        assert [len(part) for part in drawn] == np.diff(offsets).tolist()
        assert np.array_equal(np.concatenate([np.empty((0, 2)), *drawn]), coords)
        assert len(space.query(f'LWPOLYLINE[layer=="{name.upper()}"]')) == len(drawn)
    assert len(space.query('POINT[layer=="POINTS"]')) == len(STAR)


@pytest.mark.parametrize("mode", MODES)
def test_png_has_the_size_asked_for(mode: str) -> None:
    wide = STAR * (2, 1)
    reply = good(Session(), "export", raw(wide), mode=mode, what="png", size=300)
    picture = np.asarray(Image.open(io.BytesIO(reply.buffers[0])).convert("RGB"))
    assert max(picture.shape) == 300
    assert picture.shape[1] > picture.shape[0]
    assert picture.astype(float).std() > 3


def test_nothing_is_no_file() -> None:
    reply = asked(Session(), "export", raw(np.empty((0, 2))), mode="maze", what="svg")
    assert "nothing to be written" in reply.content["message"]
