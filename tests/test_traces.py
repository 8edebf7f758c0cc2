"""Nodes of rock traces: I, Y, X and E as fractopo counts them, on traces whose nodes are known."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path
from types import ModuleType

import pytest
import shapely

import crazing as cz


@pytest.fixture(scope="module")
def example(root: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("traces", root / "python" / "examples" / "traces.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


# Traces, area, and the nodes they have by construction.
KNOWN = {
    "apart": ([((0, 0), (1, 0)), ((0, 1), (1, 1))], None, {"I": 4, "Y": 0, "X": 0, "E": 0}),
    "a crossing": ([((0, 0), (2, 2)), ((0, 2), (2, 0))], None, {"I": 4, "Y": 0, "X": 1, "E": 0}),
    "a T": ([((0, 0), (2, 0)), ((1, 0), (1, 1))], None, {"I": 3, "Y": 1, "X": 0, "E": 0}),
    "a T short of it": ([((0, 0), (2, 0)), ((1, 0.0004), (1, 1))], None, {"I": 3, "Y": 1, "X": 0, "E": 0}),
    "too short of it": ([((0, 0), (2, 0)), ((1, 0.01), (1, 1))], None, {"I": 4, "Y": 0, "X": 0, "E": 0}),
    "bends are none": ([((0, 0), (1, 0.3), (2, 0), (3, 1))], None, {"I": 2, "Y": 0, "X": 0, "E": 0}),
    "cut": ([((-5, 1), (5, 1)), ((1, 0.5), (1, 5))], shapely.box(0, 0, 2, 2), {"I": 1, "Y": 0, "X": 1, "E": 3}),
    "a ladder": (
        [((0, 0), (0, 9)), ((1, 0), (1, 9)), *(((0, y), (1, y)) for y in range(1, 9))],
        None,
        {"I": 4, "Y": 16, "X": 0, "E": 0},
    ),
}


@pytest.mark.parametrize("name", KNOWN)
def test_nodes_are_those_by_construction(example: ModuleType, name: str) -> None:
    lines, area, nodes = KNOWN[name]
    found, cut = example.graph([shapely.LineString(line) for line in lines], area)
    assert example.counts(found, cut) == nodes


def test_connections_per_branch_is_that_of_the_counts(example: ModuleType) -> None:
    found, cut = example.graph([shapely.LineString(line) for line in KNOWN["a ladder"][0]], None)
    nodes = example.counts(found, cut)
    branches = (nodes["I"] + 3 * nodes["Y"] + 4 * nodes["X"]) / 2
    assert cz.measure(found).connections_per_branch == pytest.approx((3 * nodes["Y"] + 4 * nodes["X"]) / branches)


def test_files_are_read_as_single_lines(example: ModuleType, tmp_path: Path) -> None:
    several = {"type": "MultiLineString", "coordinates": [[[0, 0], [1, 0]], [[0, 1], [1, 1]]]}
    rows = [{"type": "Feature", "geometry": each} for each in (several, None)]
    path = tmp_path / "traces.geojson"
    path.write_text(json.dumps({"type": "FeatureCollection", "features": rows}))
    assert [line.geom_type for line in example.geometries(path)] == ["LineString", "LineString"]
