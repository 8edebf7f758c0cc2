"""Independent knobs: each moves its own statistic and leaves the others near, by `measure`."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import crazing as cz

BASE = {"n": 400, "relax": 1, "opening": 0.6, "rounds": 3, "slide": 0.15, "roughness": 0.02, "hierarchy": 0.4}

# Knob: two values, the statistics it is for (at least so much more at the second), those it may move besides.
KNOBS = {
    "opening": ((0.3, 0.9), {"i_nodes": 0.3, "loops_per_junction": -0.2}, {"cell_cv", "width_cv", "segment_cv"}),
    "rounds": ((0, 6), {"t_share": 0.25}, {"near_right", "tortuosity"}),
    "slide": ((0.0, 0.6), {"near_right": 0.06}, set()),
    "roughness": ((0.0, 0.08), {"tortuosity": 0.04}, {"near_right", "t_share", "width_cv"}),
    "stubs": ((0.0, 0.6), {"i_nodes": 0.1, "loops_per_junction": -0.06}, {"segment_cv", "near_right"}),
    "hierarchy": ((0.1, 1.0), {"width_cv": 0.35, "width_ratio": 1.0}, set()),
    "unevenness": ((0.0, 0.6), {"width_cv": 0.3}, {"width_ratio"}),
    "fade": ((0.0, 3.0), {"width_cv": 0.3}, {"width_ratio"}),
    "anisotropy": ((1.0, 3.0), {"orientation": 0.4}, {"t_share", "near_right", "cell_cv"}),
    "falloff": ((0.0, 1.0), {"cell_cv": 0.15}, {"segment_cv", "width_cv", "width_ratio"}),
    "patchiness": ((0.0, 1.2), {"cell_cv": 0.3, "segment_cv": 0.1}, set()),
}
NEAR = {
    "i_nodes": 0.04,
    "loops_per_junction": 0.05,
    "t_share": 0.08,
    "near_right": 0.05,
    "tortuosity": 0.04,
    "width_cv": 0.1,
    "width_ratio": 0.3,
    "orientation": 0.12,
    "cell_cv": 0.15,
    "segment_cv": 0.08,
}
# Two bounds of NEAR were once met by luck of two seeds, by .035 and .110: over 24 seeds the same generator moved the
# first by .050 +- .003 and the second by .172 +- .010, and today's by .055 +- .004 and .174 +- .010. Neither is a fault
# of a step. Walls between fewer junctions are longer chains of corners: without roughness it is .048 still, with ten
# rounds of straightening .045, and the thesis' maze itself winds 1.20 against 1.005 of all walls. Walls that are pulled
# straight make large cells larger, also where every door is shut (.138). Here they stand with bounds of their own.
MOVED = {("opening", "tortuosity"): 0.075, ("rounds", "cell_cv"): 0.22}


# Seeds of a mean. Single patterns differ by more than what is asked: of a falloff of 1, which moves the variation of
# cells by .21, by .15 more or less.
SEEDS = 24


@cache
def measured(knob: str, value: float) -> dict[str, float]:
    found = [cz.measure(cz.crack(**{**BASE, knob: value}, rng=seed)) for seed in range(SEEDS)]
    return {name: float(np.mean([getattr(each, name) for each in found])) for name in NEAR}


@pytest.mark.parametrize("knob", KNOBS)
def test_a_knob_moves_its_statistic_and_leaves_the_others_near(knob: str) -> None:
    (low, high), own, besides = KNOBS[knob]
    first, second = measured(knob, low), measured(knob, high)
    for name, least in own.items():
        moved = second[name] - first[name]
        assert (moved >= least) if least > 0 else (moved <= least), (name, first[name], second[name])
    for name in NEAR.keys() - own.keys() - besides:
        most = MOVED.get((knob, name), NEAR[name])
        assert abs(second[name] - first[name]) <= most, (name, first[name], second[name])
