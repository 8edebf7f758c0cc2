"""Pictures of any size: rough cracks and noise have detail down to the pixel, and stay what they are."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

import crazing as cz


def places(crack: cz.Crack) -> set[bytes]:
    return {row.tobytes() for row in crack.graph.vertices}


def widths(crack: cz.Crack) -> set[tuple[bytes, float]]:
    ends = crack.graph.vertices[crack.graph.edges].reshape(-1, 2)
    return {(row.tobytes(), width) for row, width in zip(ends, crack.width.ravel().tolist(), strict=True)}


def lengths(crack: cz.Crack) -> np.ndarray:
    ends = crack.graph.vertices[crack.graph.edges]
    step = ends[:, 1] - ends[:, 0]
    if crack.period is not None:
        step += crack.shifts * np.array(crack.period)
    return np.hypot(*step.T)


@pytest.mark.parametrize("frame", [{}, {"period": (1.0, 1.0)}])
@pytest.mark.parametrize(
    "name", [name for name in cz.presets() if cz.preset(name).roughness or cz.preset(name).rounding]
)
def test_finer_pieces_add_to_a_crack_and_move_nothing(name, frame):
    coarse, middle, fine = (
        cz.crack(preset=name, rng=3, detail=detail, **frame) for detail in (None, 1 / 400, 1 / 3200)
    )
    within = [(coarse, middle), (middle, fine)]
    assert all(places(one) <= places(other) for one, other in within)
    assert len(coarse.graph.edges) <= len(middle.graph.edges) < len(fine.graph.edges)
    assert lengths(coarse).sum() <= lengths(middle).sum() * (1 + 1e-12) <= lengths(fine).sum() * (1 + 1e-12) ** 2
    assert len(np.unique(fine.strand)) == len(np.unique(middle.strand)) == len(np.unique(coarse.strand))
    # At vertices that were there, cracks are as wide as they were.
    for one, other in within:
        assert widths(one) <= widths(other)


def farthest(fine: cz.Crack, coarse: cz.Crack) -> float:
    """The farthest vertex of a crack from the lines of another."""
    lines = shapely.multilinestrings(shapely.linestrings(coarse.graph.segments))
    return shapely.distance(lines, shapely.points(fine.graph.vertices)).max()


def test_no_crack_wanders_more_finely_than_it_is_wide():
    recipe = cz.Recipe(n=80, relax=2, roughness=0.02, grain=0.3, taper=0.0, hierarchy=0.0)

    def off(width: float) -> float:
        coarse, fine = (recipe.crack(rng=1, width=width, detail=detail) for detail in (None, 1e-3))
        assert len(fine.graph.edges) >= len(coarse.graph.edges)
        return farthest(fine, coarse)

    # What is added to a crack wider than its coarse pieces are long, lies on these.
    assert off(10.0) < 0.01 * off(1e-6)
    assert off(1e-6) > 1e-3


def test_detail_coarser_than_the_recipe_changes_nothing():
    recipe = cz.preset("mud-mature")
    plain, same = recipe.crack(rng=1), recipe.crack(rng=1, detail=1.0)
    np.testing.assert_array_equal(plain.graph.vertices, same.graph.vertices)
    np.testing.assert_array_equal(plain.width, same.width)
    smooth = cz.crack(n=50, rng=1, detail=1e-6)
    np.testing.assert_array_equal(smooth.graph.vertices, cz.crack(n=50, rng=1).graph.vertices)


@pytest.mark.parametrize("wrong", [0, -1, np.nan, np.inf, "fine"])
def test_what_is_no_detail_is_named(wrong):
    with pytest.raises((TypeError, ValueError), match="detail"):
        cz.crack(preset="bark", rng=1, detail=wrong)


def test_more_pieces_than_fit_are_refused():
    with pytest.raises(cz.CrazingError, match="pieces of rough edges"):
        cz.crack(preset="mud-mature", n=300_000, rng=1, detail=1e-9)


def halved(picture: np.ndarray, times: int) -> np.ndarray:
    side = len(picture) // times
    return picture[: side * times, : side * times].reshape(side, times, side, times).mean(axis=(1, 3))


@pytest.mark.parametrize("name", ["mud-mature", "asphalt-alligator", "rock", "painting-french"])
def test_a_large_picture_is_the_small_one_with_more_in_it(name):
    crack = cz.crack(preset=name, period=(1, 1), rng=2)
    small, large = (cz.texture(crack, size, maps="height", material=name)["height"] for size in (256, 1024))
    beyond = cz.texture(crack, 256, maps="distance")["distance"] > 0.02
    shrunk = halved(large, 4)
    # Height of plates away from rims: tilt and grain.
    one, other = small[beyond].astype(float), shrunk[beyond].astype(float)
    assert np.corrcoef(one, other)[0, 1] > 0.8
    # From pixel to pixel, there is as much to be seen in the large one as in a small one of a coarse grain.
    far = np.kron(beyond, np.ones((4, 4))) > 0
    flat = halved(large, 2).repeat(2, axis=0).repeat(2, axis=1)
    fine = (large - flat)[far]
    assert fine.std() > 0.03 * cz.material.preset_material(name).grain
