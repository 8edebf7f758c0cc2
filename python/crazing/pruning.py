"""Ways to take hairs off an axis; see `Skeleton.prune`."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing import _core
from crazing.arguments import count, number
from crazing.graph import PlanarGraph

if TYPE_CHECKING:
    from crazing.skeleton import Mask, Skeleton

#: Least part of its ring that an axis edge spans, if nothing else is asked for.
RESIDUAL = 0.0125


@dataclass(frozen=True)
class Limits:
    """What a pruned axis has to keep to; None is no limit."""

    residual: float | None = None
    chord: float | None = None
    length: float | None = None
    ratio: float | None = None
    height: float | None = None
    retract: int | None = None
    #: By the noise of each ring; no parameter, only part of the default.
    noise: bool = False

    def __post_init__(self) -> None:
        for name in ("residual", "chord", "length", "ratio", "height"):
            if getattr(self, name) is not None:
                object.__setattr__(self, name, number(getattr(self, name), name, low=0.0))
        if self.retract is not None:
            count(self.retract, "retract")
        if all(getattr(self, limit.name) is None for limit in fields(self) if limit.name != "noise"):
            object.__setattr__(self, "residual", RESIDUAL)
            object.__setattr__(self, "noise", True)


def prune(skeleton: Skeleton, limits: Limits) -> Skeleton:
    """`skeleton` with the axis that is left by the limits."""
    if skeleton.axis_mask is None:
        raise ValueError(f"the axis of method {skeleton.method!r} has edges that are not dual; it cannot be pruned")
    diagram, mask = skeleton.diagram, np.array(skeleton.axis_mask)
    if limits.noise:
        mask = _core.without_hairs(diagram.arrays, skeleton.ring_mask, mask, limits.residual or 0.0)
    elif limits.residual is not None:
        mask = _peeled(skeleton, mask, skeleton._sides[2], limits.residual)
    if limits.height is not None:
        mask = _core.without_bumps(diagram.arrays, skeleton.ring_mask, mask, limits.height)
        if limits.residual is not None:
            # What a bump held on to may be a hair.
            mask = _peeled(skeleton, mask, skeleton._sides[2], limits.residual)
    if limits.chord is not None:
        mask = _peeled(skeleton, mask, diagram.delaunay.lengths, limits.chord)
    for by_radius, least in ((False, limits.length), (True, limits.ratio)):
        if least is not None:
            mask = _without_branches(skeleton, mask, by_radius, least)
    crust = skeleton.crust
    for _ in range(limits.retract or 0):
        shorter, sites = _retracted(skeleton, mask, crust.vertices)
        if np.array_equal(shorter, mask):  # Nothing is left to go back.
            break
        mask, crust = shorter, PlanarGraph(sites, crust.edges)
    axis = PlanarGraph(diagram.vertices, _core.axis_edges(diagram.arrays, mask))
    pruned = replace(skeleton, crust=crust, axis=axis, axis_mask=mask)
    # What depends on the samples alone is not found twice.
    known = ("radius", "ring_mask", "_sides")
    vars(pruned).update({name: vars(skeleton)[name] for name in known if name in vars(skeleton)})
    return pruned


def _peeled(skeleton: Skeleton, mask: Mask, worth: NDArray[np.float64], least: float) -> Mask:
    """The axis without what is worth less, but for what holds a component together.

    Where noise leaves a gap in a ring, the axis inside and the one around it hang together: an edge that crosses a ring
    holds nothing.
    """
    crossing = skeleton._sides[1]
    kept = _core.peeled(skeleton.diagram.arrays, mask & ~crossing, worth, least)
    return np.asarray(kept | (mask & crossing & (worth >= least)))


def _drawn(skeleton: Skeleton, mask: Mask) -> tuple[NDArray[np.intp], NDArray[np.int32]]:
    """The rows of masked dual edges that are drawn, and their ends: finite, with a length, by representatives."""
    representative = _core.representatives(skeleton.diagram.arrays)
    duals = skeleton.diagram.dual_edges
    ends = np.where(duals < 0, -1, representative[duals])
    rows = np.flatnonzero(mask & (duals >= 0).all(axis=1) & (ends[:, 0] != ends[:, 1]))
    return rows, np.ascontiguousarray(ends[rows], dtype=np.int32)


def _without_branches(skeleton: Skeleton, mask: Mask, by_radius: bool, least: float) -> Mask:
    rows, ends = _drawn(skeleton, mask)
    kept = _core.branches(skeleton.diagram.vertices, ends, skeleton.radius, by_radius, least)
    left = mask.copy()
    left[rows[~kept]] = False
    return left


def _retracted(skeleton: Skeleton, mask: Mask, sites: NDArray[np.float64]) -> tuple[Mask, NDArray[np.float64]]:
    """One step back of every leaf: the axis left, and the sites with those at the tips on their parents' circles."""
    diagram = skeleton.diagram
    rows, ends = _drawn(skeleton, mask)
    degrees = np.bincount(ends.ravel(), minlength=len(diagram.vertices))
    leaf = degrees[ends] == 1
    # A line of one edge has no parent to go back to.
    going = leaf.any(axis=1) & ~leaf.all(axis=1)
    side = leaf[going].argmax(axis=1)
    duals, pair = diagram.dual_edges[rows[going]], diagram.edges[rows[going]]
    each = np.arange(len(side))
    corners, parents = diagram.triangles[duals[each, side]], duals[each, 1 - side]
    # The sample at the tip is the corner that the axis edge does not part from another.
    middle = corners[(corners[:, :, None] != pair[:, None, :]).all(axis=2)]
    left, moved = mask.copy(), sites.copy()
    left[rows[going]] = False
    step = sites[middle] - diagram.vertices[parents]
    moved[middle] = diagram.vertices[parents] + step * (skeleton.radius[parents] / np.hypot(*step.T))[:, None]
    return left, moved
