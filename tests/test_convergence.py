"""The axis nears the true one: order 2 where the curve is smooth, order 1 where it has corners."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest


@pytest.mark.parametrize(("shape", "expected"), [("ellipse", 2.0), ("annulus", 2.0), ("rectangle", 1.0)])
@pytest.mark.parametrize("method", ["edge-filter", "one-step"])
def test_orders(root: Path, monkeypatch: pytest.MonkeyPatch, shape: str, method: str, expected: float) -> None:
    pytest.importorskip("matplotlib")
    pytest.importorskip("skimage")
    monkeypatch.setattr(sys, "path", [str(root / "python" / "examples"), *sys.path])
    import convergence

    errors = [convergence.error(shape, method, 96 * 2**i) for i in range(4)]
    assert convergence.order(errors) == pytest.approx(expected, abs=0.05)
    assert errors[0] < 0.1
