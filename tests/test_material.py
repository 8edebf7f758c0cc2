"""What a material looks like, in its colours and under a lamp."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import crazing as cz
from test_texture import lines


def test_black_cracks_stay_black_under_the_lamp():
    """A rough surface mirrors some hundredth of the light: F / 4 for Blinn's facets, over the lamp's own cosine."""
    black = cz.Material(
        plate=["#000"], crack="#000", dirt="#000", worn="#000", relief=0, roughness=1, roughness_spread=0
    )
    lit = cz.texture(lines([[0, 0, 1, 1]], [[0.1, 0.1]]), 16, maps="all", material=black).lit(light=(0, 0, 1))
    sent = (lit / 255 / 12.92).max() if lit.max() <= 10 else (((lit / 255 + 0.055) / 1.055) ** 2.4).max()
    assert 0.002 < sent <= 0.015


def test_debris_lies_in_cracks_only():
    net = cz.crack(n=60, width=0.06, rng=2)
    clean = cz.Material(crack="#000", dirt="#fff", dirt_amount=0, wear=0)
    bare = cz.texture(net, 96, maps=["color", "mask"], material=clean, seed=1)
    littered = cz.texture(net, 96, maps=["color"], material=dataclasses.replace(clean, debris=1), seed=1)["color"]
    outside = bare["mask"] == 0
    np.testing.assert_array_equal(littered[outside], bare["color"][outside])
    inside = bare["mask"] == 255
    assert (littered[inside] >= bare["color"][inside]).all() and np.ptp(littered[inside].astype(int)) > 100


@pytest.mark.parametrize("field", ["dirt_width", "wear_width"])
def test_a_width_of_nothing_leaves_cracks_their_colour(field: str) -> None:
    """Zero times infinity is no number: such cracks came out black, and their wear as NaN."""
    net = cz.crack(n=60, width=0.06, rng=2)
    t = cz.texture(net, 96, maps=["color", "mask", "wear"], material=cz.Material(crack="#f00", **{field: 0}), seed=1)
    assert (t["color"][t["mask"] == 255] == (255, 0, 0)).all() and np.isfinite(t["wear"]).all()


def settled(crack: cz.Crack, taper: float, size: int) -> np.ndarray:
    """How much has settled on every pixel, 0 to 1."""
    plain = {"plate": ["#000"], "crack": "#000", "dirt": "#fff", "dirt_amount": 1, "wear": 0, "mottle": 0, "chip": 0}
    material = cz.Material(**plain, dirt_width=0.2, dirt_taper=taper)
    return cz.texture(crack, size, maps=["color"], material=material, seed=1)["color"][..., 0] / 255


def test_what_has_settled_reaches_as_far_as_the_crack_is_wide() -> None:
    """Ice glowed as far along hairs as along its widest cracks."""
    far = {}
    for taper in (0.0, 1.0):
        column = settled(lines([[0, 0.25, 1, 0.25], [0, 0.75, 1, 0.75]], [[0.04, 0.04], [0.01, 0.01]]), taper, 512)
        far[taper] = [int((half[:, 256] > 0.002).sum()) for half in (column[256:], column[:256])]
    wide, narrow = far[1.0]
    assert abs(far[0.0][0] - far[0.0][1]) < 0.15 * far[0.0][0]
    # Beside the crack itself.
    assert 0.2 < narrow / wide < 0.3 and abs(wide - far[0.0][0]) < 3


def test_dirt_has_no_step_where_a_narrow_crack_leaves_a_wide_one() -> None:
    """Pixels beside each other are beside either."""
    graph = cz.PlanarGraph([(0, 0.5), (0.5, 0.5), (1, 0.5), (0.5, 1)], [(0, 1), (1, 2), (1, 3)])
    width, rows = np.repeat([[0.04], [0.04], [0.004]], 2, axis=1), np.array([0, 0, 1], dtype=np.int32)
    crack = cz.Crack(graph, width, rows, rows, (0.0, 0.0, 1.0, 1.0))
    steps = {}
    for taper in (0.0, 1.0):
        found = settled(crack, taper, 512)[:250, 262:]
        steps[taper] = max(np.abs(np.diff(found, axis=axis)).max() for axis in (0, 1))
    assert steps[1.0] < 2 * steps[0.0]


@pytest.mark.parametrize("period", [None, (1, 1)])
def test_windows_of_tapering_dirt_are_the_whole(period) -> None:
    crack = cz.preset("ice").crack(rng=4, period=period)
    plan = cz.texture_plan(crack, 256, maps=["color"], material="ice", seed=1)
    whole, part = plan.window(0, 0, 256, 256)["color"], plan.window(60, 90, 70, 110)["color"]
    np.testing.assert_array_equal(part, whole[60:130, 90:200])


def test_a_plate_around_a_torus_is_level():
    """It has no middle to tilt about: it would meet itself in a step."""
    tilted = cz.Material(tilt=1, level=0, grain=0, curl=0, rim=0, relief=1)
    drawing = cz.steps.impact(200, bounds=(0.1, 0.1, 0.9, 0.9), source=(0.5, 0.5), rng=1)
    plane = cz.steps.widen(drawing, width=0.004)
    whole = {"bounds": (0, 0, 1, 1), "period": (1, 1), "shifts": np.zeros((len(plane.graph.edges), 2), dtype=np.int8)}
    star = dataclasses.replace(plane, **whole)
    maps = cz.texture(star, 128, maps=["normal", "cell"], material=tilted, seed=3)
    border = maps["cell"][0]
    assert (border == border[0]).all()
    np.testing.assert_allclose(maps["normal"][0], [[0, 0, 1]] * 128, atol=1e-6)
    assert (maps["normal"][..., 2] < 0.999).mean() > 0.05


def test_a_map_that_is_not_there_is_named():
    t = cz.texture(lines([[0, 0, 1, 1]], [[0.1, 0.1]]), 8, maps=["height", "mask"])
    with pytest.raises(KeyError, match=r"no map 'hieght' .did you mean 'height'"):
        t["hieght"]
    assert "color" not in t and t.get("color") is None


@pytest.mark.parametrize("width", [1, 2, 3, 7, 8, 9])
def test_narrow_pictures_are_cut_from_wide_ones(width):
    c = cz.preset("bark").crack(rng=7)
    maps = ["mask", "color", "height", "normal", "cell"]
    wide = cz.texture(c, 64, maps=maps, material="bark", seed=1)
    for left in (0, 40, 64 - width):
        bounds = (left / 64, 0, (left + width) / 64, 1)
        narrow = cz.texture(c, (64, width), maps=maps, material="bark", seed=1, bounds=bounds)
        for name in maps:
            np.testing.assert_array_equal(narrow[name], wide[name][:, left : left + width], err_msg=name)
