"""Cells as areas: they pave what the maze is in, and Shapely cuts the same ones."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
import shapely
from matplotlib.figure import Figure
from PIL import Image

import crazing as cz
from crazing.mosaic import Mosaic, mosaic

TURNS = np.linspace(0, 2 * np.pi, 60, endpoint=False)
FLOWER = 0.5 + np.stack([np.cos(TURNS), np.sin(TURNS)], axis=1) * (0.3 + 0.17 * np.cos(9 * TURNS))[:, None]
HOLED = [[(0.05, 0.05), (0.95, 0.1), (0.9, 0.6), (0.5, 0.35), (0.6, 0.95)], [(0.2, 0.2), (0.35, 0.2), (0.35, 0.5)]]


def area(rings: list[np.ndarray]) -> float:
    """Signed: of rings that go round once it is what they wind about."""
    x, y = (np.concatenate([ring[:, axis] for ring in rings]) for axis in (0, 1))
    x2, y2 = (np.concatenate([np.roll(ring[:, axis], -1) for ring in rings]) for axis in (0, 1))
    return float((x * y2 - x2 * y).sum() / 2)


def areas(m: cz.Maze) -> Mosaic:
    return mosaic(m, np.ones(m.size, dtype=bool))


@pytest.mark.parametrize("bounds", [(-0.1, -0.2, 1.1, 1.2), (0.25, 0.3, 0.6, 0.9), (2, 2, 3, 3)])
@pytest.mark.parametrize("n", [1, 2, 3, 40])
def test_voronoi_cells_pave_the_bounds_and_each_point_is_nearest_to_its_site(n: int, bounds: tuple) -> None:
    m = cz.maze(cz.sample.uniform(n, rng=n), bounds=bounds, rng=1)
    found = areas(m)
    box = (bounds[2] - bounds[0]) * (bounds[3] - bounds[1])
    assert sum(map(area, found.areas)) == pytest.approx(box)
    assert len(set(found.cells.tolist())) == len(found.cells)
    for cell, (ring,) in zip(found.cells.tolist(), found.areas, strict=True):
        away = np.linalg.norm(m.diagram.sites - ring.mean(axis=0), axis=1)
        assert away.argmin() == cell


@pytest.mark.parametrize("cells", ["voronoi", "delaunay"])
@pytest.mark.parametrize("n", [1, 2, 3, 60])
def test_copies_pave_the_period(n: int, cells: str) -> None:
    m = cz.maze(cz.sample.uniform(n, bounds=(0, 0, 2, 1), rng=n), cells=cells, period=(2, 1), rng=1)
    found = areas(m)
    (frame,) = found.clip
    assert frame.tolist() == [[0, 0], [2, 0], [2, 1], [0, 1]]
    drawn = np.array([shapely.Polygon(ring) for (ring,) in found.areas])
    inside = shapely.intersection(drawn, shapely.box(0, 0, 2, 1))
    assert shapely.area(inside).sum() == pytest.approx(2)
    assert shapely.area(shapely.union_all(inside)) == pytest.approx(2)
    # All copies of a cell together are as large as the cell.
    whole = np.zeros(m.size)
    np.add.at(whole, found.cells, shapely.area(inside))
    one = dict(zip(found.cells.tolist(), shapely.area(drawn).tolist(), strict=True))
    np.testing.assert_allclose(whole, [one[cell] for cell in range(m.size)])


@pytest.mark.parametrize("shape", [FLOWER, HOLED])
def test_parts_of_cells_are_those_that_shapely_cuts(shape) -> None:
    m = cz.maze(cz.sample.uniform(160, rng=5), within=shape, rng=2)
    region = shapely.Polygon(FLOWER) if shape is FLOWER else shapely.Polygon(HOLED[0], HOLED[1:])
    found = dict(zip((cells := areas(m)).cells.tolist(), cells.areas, strict=True))
    plain = areas(cz.maze(m.diagram, bounds=m.bounds, rng=2))
    pieces = shapely.intersection(np.array([shapely.Polygon(ring) for (ring,) in plain.areas]), region)
    of_site = dict(zip(plain.cells.tolist(), pieces, strict=True))
    assert len(m.plan.parts) > 3
    for site in np.unique(m.plan.parts).tolist():
        parts = [site, *(len(m.diagram.sites) + np.flatnonzero(m.plan.parts == site)).tolist()]
        ours = sorted(area(found[part]) for part in parts)
        # Parts without a door are no cells.
        theirs = sorted(shapely.area(shapely.get_parts(of_site[site])).tolist())
        assert all(min(abs(np.subtract(theirs, own))) < 1e-12 for own in ours)


def test_every_wanted_cell_is_filled_on_axes() -> None:
    for m in (
        cz.maze(cz.sample.uniform(60, rng=1), within=FLOWER, rng=1),
        cz.maze(cz.sample.uniform(60, rng=1), cells="delaunay", within=HOLED, rng=1),
        cz.maze(cz.sample.uniform(60, rng=1), period=(1, 1), rng=1),
    ):
        ax = m.plot(Figure().subplots(), distances=True, solution=True, color="black")
        filled = max(ax.collections, key=lambda drawn: drawn.get_array() is not None)
        assert len(filled.get_paths()) >= (m.distances() >= 0).sum()
        assert filled.get_array().max() == m.distances().max()
    m = cz.maze(cz.sample.uniform(60, rng=1), bounds=(0, 0, 1, 1), rng=1)
    ax = m.plot(Figure().subplots(), solution=m.longest(), distances=4)
    assert np.ptp(ax.get_xlim()) < 1.2 and np.ptp(ax.get_ylim()) < 1.2, "doors far out do not make the walls small"


def test_files_are_coloured_from_pale_to_dark_within_the_shape(tmp_path: Path) -> None:
    points = cz.sample.uniform(200, rng=1)
    m = cz.maze(points, within=FLOWER, start=int(np.linalg.norm(points - 0.5, axis=1).argmin()), rng=1)
    m.save(tmp_path / "m.svg", distances=True, solution=True)
    text = (tmp_path / "m.svg").read_text()
    assert re.findall(r'id="(\w+)"', text) == ["shape", "distances", "walls", "solution"]
    tones = re.findall(r'fill="#(\w{6})"', text)
    assert len(tones) == len(set(tones)) > 30
    brightness = [sum(bytes.fromhex(tone)) for tone in tones]
    assert brightness == sorted(brightness, reverse=True)
    far = int(np.where(m.region.contains(m.centres), m.distances(), 0).argmax())
    m.save(tmp_path / "m.png", page=(60, 60), margin=2, pen=0.1, distances=True)
    with Image.open(tmp_path / "m.png") as picture:
        pixels = np.asarray(picture.convert("RGB")).astype(int)
    assert (pixels[:10] == 255).all() and (pixels[:, :10] == 255).all()
    low, high = FLOWER.min(axis=0), FLOWER.max(axis=0)
    scale = 56 / max(high - low)
    seen = {}
    for cell in (m.start, far):
        x, y = (m.centres[cell] - (low + high) / 2) * scale + 30
        seen[cell] = pixels[int((60 - y) / 25.4 * 300), int(x / 25.4 * 300)].sum()
    assert seen[far] < seen[m.start] < 3 * 255
    m.save(tmp_path / "m.pdf", distances=far)
    with pytest.raises(ValueError, match=r"DXF .* \.svg, \.pdf or \.png"):
        m.save(tmp_path / "m.dxf", distances=True)
    assert not (tmp_path / "m.dxf").exists()
