"""Studies over sizes: one comparison each, and a table of all."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import crazing as cz

IMAGE = np.pad(np.ones((30, 50)), 10)


def test_every_size_is_compared_as_alone() -> None:
    study = cz.compare_sizes(IMAGE, [60, 33, 120], "edge-filter", "one-step", level=0.25)
    assert study.sizes == (60, 33, 120)
    for size, comparison in zip(study.sizes, study.comparisons, strict=True):
        assert comparison == cz.compare(cz.sample.from_image(IMAGE, level=0.25, n=size), "edge-filter", "one-step")
    assert [(row["samples"], row["method"]) for row in study.table[:2]] == [(60, "edge-filter"), (60, "one-step")]
    assert study.table[0]["crust edges"] == len(study.comparisons[0].first.crust.edges)


def test_the_table_is_aligned_and_the_figure_has_a_row_each() -> None:
    study = cz.compare_sizes(IMAGE, (60, 33))
    lines = str(study).splitlines()
    assert len(lines) == 5
    assert len({len(line) for line in lines}) == 1
    pytest.importorskip("matplotlib")
    titles = [axes.get_title() for axes in study.plot().axes]
    assert titles[0] == "60 samples, one-step" and titles[3] == "33 samples, one-step"


@pytest.mark.parametrize(("sizes", "error"), [([], ValueError), ([2], ValueError), ([9.5], TypeError)])
def test_bad_sizes_are_refused(sizes: Any, error: type[Exception]) -> None:
    with pytest.raises(error, match="sizes"):
        cz.compare_sizes(IMAGE, sizes)
