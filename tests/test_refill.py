"""Maps that are drawn into the arrays of earlier ones."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

import crazing as cz
from crazing.texture import MAPS


@pytest.fixture(scope="module")
def net():
    return cz.crack(n=60, opening=0.5, rng=5)


def copied(maps):
    return {name: maps[name].copy() for name in maps}


def check_same(one, other):
    assert [*one] == [*other]
    for name in one:
        np.testing.assert_array_equal(one[name], other[name], err_msg=name)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_texture_in_used_arrays_is_that_in_new_ones(net, threads):
    """Of a pattern that grows, in another material, under another seed: nothing is left of what was there."""
    given = {"bounds": net.bounds, "threads": threads, "maps": "all"}
    frame = cz.texture(net, (150, 170), material="mud-mature", seed=4, **given)
    arrays = dict(frame)
    for age in (0.3, 1.0):
        fresh = cz.texture(net.at(age), (150, 170), **given)
        frame = cz.texture(net.at(age), (150, 170), out=frame, **given)
        check_same(frame, fresh)
        assert frame.crack == net.at(age)
        assert all(frame[name] is arrays[name] and not frame[name].flags.writeable for name in MAPS)


@pytest.mark.parametrize("window", [(0, 0, 40, 70), (31, 57, 40, 70), (-9, 200, 40, 70)])
def test_a_window_in_used_arrays_is_that_in_new_ones(net, window):
    plan = cz.texture_plan(net, (120, 150), maps="all")
    used = {name: np.full(array.shape, 77, array.dtype) for name, array in plan.window(5, 5, 40, 70).items()}
    found = plan.window(*window, out=used)
    check_same(found, plan.window(*window))
    assert all(found[name] is used[name] for name in MAPS)


def test_the_order_of_given_maps_does_not_matter(net):
    plan = cz.texture_plan(net, 40, maps=["mask", "height"])
    used = dict(reversed(plan.window(0, 0, 40, 40).items()))
    assert [*plan.window(0, 0, 40, 40, out=used)] == ["mask", "height"]


REFUSED = {
    "type": (lambda a: {**a, "height": a["height"].astype(np.float64)}, r"out\['height'\] is of float64"),
    "bytes turned": (lambda a: {**a, "height": a["height"].astype(">f4")}, "is of >f4"),
    "shape": (lambda a: {**a, "mask": a["mask"][:-1]}, r"out\['mask'\] is of uint8 and shape \(29, 30\)"),
    "channels": (lambda a: {**a, "normal": a["height"]}, r"out\['normal'\] is of float32 and shape \(30, 30\)"),
    "missing": (lambda a: {"mask": a["mask"]}, "out has mask; mask, height, normal are wanted"),
    "none": (lambda a: {}, "out has no maps"),
    "another": (lambda a: {**a, "ao": a["height"]}, "out has mask, height, normal, ao"),
    "order": (lambda a: {**a, "mask": np.asfortranarray(a["mask"])}, "in pieces"),
    "stride": (lambda a: {**a, "mask": np.zeros((30, 60), np.uint8)[:, ::2]}, "in pieces"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_other_arrays_are_refused_and_left_alone(net, name):
    change, words = REFUSED[name]
    plan = cz.texture_plan(net, 30, maps=["mask", "height", "normal"])
    given = change(plan.window(0, 0, 30, 30))
    before = copied(given)
    with pytest.raises(ValueError, match=words):
        plan.window(3, 3, 30, 30, out=given)
    check_same(given, before)


def test_arrays_that_share_memory_are_refused(net):
    plan = cz.texture_plan(net, 30, maps=["height", "distance"])
    memory = np.zeros(2 * 900 - 1, np.float32)
    given = {"height": memory[:900].reshape(30, 30), "distance": memory[899:].reshape(30, 30)}
    with pytest.raises(ValueError, match=r"out\['distance'\] shares memory with out\['height'\]"):
        plan.window(0, 0, 30, 30, out=given)
    beside = np.zeros(2 * 900, np.float32).reshape(2, 30, 30)
    given = {"height": beside[0], "distance": beside[1]}
    check_same(plan.window(0, 0, 30, 30, out=given), plan.window(0, 0, 30, 30))


def test_the_patterns_own_arrays_are_refused(net):
    rows = np.zeros(len(net.graph.edges) // 10 * 10, np.int32)
    graph = SimpleNamespace(vertices=net.graph.vertices, edges=net.graph.edges[: len(rows)])
    crack = SimpleNamespace(
        graph=graph, width=net.width[: len(rows)], strand=rows, generation=rows.copy(), bounds=net.bounds
    )
    plan = cz.texture_plan(crack, (10, len(rows) // 10), maps=["cell"])
    with pytest.raises(ValueError, match="shares memory with what is drawn"):
        plan.window(0, 0, 10, len(rows) // 10, out={"cell": rows.reshape(10, -1)})


def test_read_only_arrays_are_refused(net):
    plan = cz.texture_plan(net, 30, maps=["mask"])
    drawn = cz.texture(net, 30, maps=["mask"])
    with pytest.raises(ValueError, match="read-only"):
        plan.window(0, 0, 30, 30, out=drawn)
    frozen = np.frombuffer(bytes(900), np.uint8).reshape(30, 30)
    fields = {name: getattr(drawn, name) for name in drawn.__dataclass_fields__}
    with pytest.raises(ValueError, match="read-only"):
        cz.texture(net, 30, maps=["mask"], out=cz.Texture(**{**fields, "maps": {"mask": frozen}}))


@pytest.mark.parametrize(
    ("given", "words"), [((31, "mask"), "shape"), ((30, "ao"), "out has mask"), ((0, "mask"), "size")]
)
def test_a_refused_texture_stays_as_it_was(net, given, words):
    drawn = cz.texture(net, 30, maps=["mask"])
    before = copied(drawn)
    with pytest.raises(ValueError, match=words):
        cz.texture(net.at(0.5), given[0], maps=[given[1]], out=drawn)
    check_same(drawn, before)
    assert not drawn["mask"].flags.writeable


@pytest.mark.parametrize("out", [{}, 3, "mask", np.zeros((30, 30))])
def test_only_textures_are_used_again(net, out):
    with pytest.raises(TypeError, match="a Texture is wanted"):
        cz.texture(net, 30, out=out)


@pytest.mark.parametrize("out", [3, [np.zeros((30, 30), np.uint8)], {"mask": [[0] * 30] * 30}])
def test_only_arrays_by_name_are_filled(net, out):
    with pytest.raises(TypeError, match=r"out.* (is|are) wanted"):
        cz.texture_plan(net, 30, maps=["mask"]).window(0, 0, 30, 30, out=out)
