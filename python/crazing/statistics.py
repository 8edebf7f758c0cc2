"""What a crack pattern measures: the numbers, their names and symbols, and how near they come to a target."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol, TypeAlias

from crazing.record import Record

#: A mean and a standard deviation, or more (a count) that is not read.
Target: TypeAlias = "tuple[float, ...] | list[float]"

#: Poisson-Voronoi vertices whose largest angle is 155 degrees or more: the T share of a pattern without any T.
VORONOI_T_SHARE = 0.348

#: Symbols under which the statistics are published.
SYMBOLS = {
    "i_nodes": "fI",
    "y_nodes": "fY",
    "x_nodes": "fX",
    "mean_degree": "mean_deg",
    "connections_per_branch": "C_B",
    "t_share": "fT_of_deg3",
    "largest_angle": "maxang_med",
    "smallest_angle": "minang_med",
    "near_right": "ang_near90",
    "near_even": "ang_near120",
    "angle_sd": "ang_sd",
    "mosaic_n": "n_bar",
    "mosaic_v": "v_bar",
    "loops_per_junction": "loops_per_junction",
    "dead_end_length": "deadend_len_frac",
    "bridge_length": "bridge_len_frac",
    "intensity": "P21",
    "cells": "n_cells",
    "cells_per_junction": "cells_per_junction",
    "cell_cv": "cell_area_cv",
    "cell_log_sd": "cell_area_logsd",
    "segment_length": "seg_len_mean",
    "segment_cv": "seg_len_cv",
    "tortuosity": "tortuosity",
    "orientation": "S2",
    "box_dimension": "boxdim_skel",
    "width": "w_mean",
    "width_cv": "w_cv",
    "width_ratio": "w_p95_p50",
    "taper": "taper_ratio",
    "area_fraction": "area_frac",
}

#: What a score is the mean over: the numbers that do not follow the size of the picture.
SCORED = (
    "i_nodes",
    "x_nodes",
    "t_share",
    "near_right",
    "loops_per_junction",
    "dead_end_length",
    "tortuosity",
    "segment_cv",
    "cell_cv",
    "orientation",
    "width_ratio",
    "box_dimension",
    "roughness",
)

#: Deviations below this part of the mean are taken for too small: overlapping patches of one picture are no sample.
LEAST_DEVIATION = 0.12
#: The most that one statistic adds to a score.
CAP = 4.0


class Measured(Protocol):
    """What has targets that were measured: :class:`crazing.Targets`."""

    @property
    def measured(self) -> Mapping[str, Target]:
        """Mean and deviation by name."""


@dataclass(frozen=True, eq=False, repr=False)
class CrackStatistics(Record):
    """What a crack pattern measures; printed, it is a table. Made by :func:`crazing.measure`.

    A node is a vertex that 1 segment (I node), 3 (Y, T among them) or more (X) end at; a junction has 3 or more. A
    segment is a line between two nodes. NaN stands where there is nothing to measure. Lengths have the unit of what
    was measured: pixels for a mask.

    Attributes
    ----------
    nodes, junctions : float
        Their numbers, those on the border left out.
    i_nodes, y_nodes, x_nodes : float
        Parts of the nodes that are free tips, that join three segments, and more. Sanderson and Nixon 2015.
    mean_degree : float
        Mean number of segments at a node.
    connections_per_branch : float
        Connected ends of a segment, 0 to 2: (3 Y + 4 X) / half of (I + 3 Y + 4 X), an X counting its own number of
        segments. Sanderson and Nixon 2015.
    t_share : float
        Part of the junctions of three whose largest angle is 155 degrees or more. Exact Poisson-Voronoi has .348, its
        raster .24: see `t_excess`.
    largest_angle, smallest_angle : float
        Medians over junctions of three, degrees.
    near_right, near_even : float
        Parts of the angles at junctions of three within 90 +- 20 and within 120 +- 15 degrees.
    angle_sd : float
        Their standard deviation, degrees.
    mosaic_n : float
        Mean number of corners of cells at a junction: a T has 2. Domokos et al. 2020.
    mosaic_v : float
        Mean number of corners of a cell, 2 n / (n - p - 1) with p the part of the junctions that are no T. All-T
        patterns are at (2, 4), Voronoi at (3, 6).
    components, loops : float
        Pieces, and independent loops: edges - vertices + pieces.
    loops_per_junction : float
        0 for a tree, near .5 for a mosaic.
    dead_end_length, bridge_length : float
        Parts of the length that lie in segments with a free tip, and in segments that lie on no loop.
    length, intensity : float
        Total length; over the area it is P21 of Dershowitz and Herda 1992.
    cells, cells_per_junction : float
        Faces closed all round by cracks.
    cell_area, cell_cv, cell_log_sd : float
        Mean area of the cells; its standard deviation over the mean; standard deviation of its logarithm.
        Poisson-Voronoi cells have CV .53 (Ferenc and Neda 2007); those that a picture cuts are left out.
    segments : float
        Number of segments.
    segment_length, segment_cv : float
        Mean length between two junctions, and its standard deviation over the mean.
    tortuosity : float
        Mean of length over chord of those of them whose chord is a third of their mean length or more.
    orientation : float
        S2, the length of the mean of exp(2 i angle), weighted with length: 0 without, 1 with one direction.
    direction : float
        The direction most length runs in, degrees from the x axis, 0 to 180.
    roughness : float
        Root mean square of the second difference of positions along a segment over its lag, mean of three lags.
    box_dimension : float
        Slope of log boxes met over log size, five sizes.
    width, width_cv, width_ratio : float
        Mean width weighted with length; its standard deviation over the mean; 95th percentile over median.
    taper : float
        Mean width of the outer quarter of segments with a free tip over that of the rest of them.
    area_fraction : float
        Part of the picture that is crack.
    """

    nodes: float
    junctions: float
    i_nodes: float
    y_nodes: float
    x_nodes: float
    mean_degree: float
    connections_per_branch: float
    t_share: float
    largest_angle: float
    smallest_angle: float
    near_right: float
    near_even: float
    angle_sd: float
    mosaic_n: float
    mosaic_v: float
    components: float
    loops: float
    loops_per_junction: float
    dead_end_length: float
    bridge_length: float
    length: float
    intensity: float
    cells: float
    cells_per_junction: float
    cell_area: float
    cell_cv: float
    cell_log_sd: float
    segments: float
    segment_length: float
    segment_cv: float
    tortuosity: float
    orientation: float
    direction: float
    roughness: float
    box_dimension: float
    width: float
    width_cv: float
    width_ratio: float
    taper: float
    area_fraction: float

    @property
    def t_excess(self) -> float:
        """How far the T share lies above that of exact Poisson-Voronoi vertices: 0 there, 1 where all are T.

        Examples
        --------
        >>> import crazing as cz
        >>> wall = cz.PlanarGraph([[0, 0], [1, 0], [2, 0], [1, 1]], [[0, 1], [1, 2], [1, 3]])
        >>> cz.measure(wall).t_excess
        1.0
        """
        return (self.t_share - VORONOI_T_SHARE) / (1 - VORONOI_T_SHARE)

    def to_dict(self, *, symbols: bool = False) -> dict[str, float]:
        """The statistics by name, in the order of the table.

        Parameters
        ----------
        symbols : bool, optional
            Use the symbols under which they are published (fI, fT_of_deg3, S2 ...) where there are any.

        Returns
        -------
        dict of str to float
            Numbers of things are whole.

        Examples
        --------
        >>> import crazing as cz
        >>> cross = cz.PlanarGraph([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]], [[0, 1], [0, 2], [0, 3], [0, 4]])
        >>> cz.measure(cross).to_dict(symbols=True)["fX"]
        0.2
        """
        names = [field.name for field in dataclasses.fields(self)]
        return {SYMBOLS.get(name, name) if symbols else name: getattr(self, name) for name in names}

    def deviations(self, targets: Mapping[str, Target] | Measured) -> dict[str, float]:
        """How far each statistic lies from its target, in deviations of the target.

        Parameters
        ----------
        targets : mapping of str to (mean, standard deviation), or Targets
            By name or symbol; others are passed over. A deviation below 12 % of the mean counts as that. Of a target
            of 0 without deviation all else is infinitely far.

        Returns
        -------
        dict of str to float
            (value - mean) / deviation by name, in the order of the table; without those that are NaN on either side.

        Raises
        ------
        ValueError
            If a target is no pair of numbers.

        Examples
        --------
        >>> import crazing as cz
        >>> cross = cz.PlanarGraph([[0, 0], [1, 0], [-1, 0], [0, 1], [0, -1]], [[0, 1], [0, 2], [0, 3], [0, 4]])
        >>> cz.measure(cross).deviations({"fX": (0.1, 0.05)})
        {'x_nodes': 2.0}
        """
        found, targets = {}, _table(targets)
        for name, value in self.to_dict().items():
            pair = targets.get(name, targets.get(SYMBOLS.get(name, name)))
            if pair is not None:
                mean, spread = _pair(name, pair)
                found[name] = _apart(value - mean, max(spread, LEAST_DEVIATION * abs(mean)))
        return {name: value for name, value in found.items() if not math.isnan(value)}

    def score(self, targets: Mapping[str, Target] | Measured) -> float:
        """How far the pattern is from a target: 0 is the same; patches of one painting score about .5 to one another.

        Parameters
        ----------
        targets : mapping of str to (mean, standard deviation), or Targets
            By name or symbol. Only what does not follow the size of the picture is compared: shares of nodes, T share,
            right angles, loops, dead ends, tortuosity, variation of segments and cells, orientation, widths, box
            dimension and roughness. A target without cells (NaN) leaves them out.

        Returns
        -------
        float
            Mean over those statistics of |difference| / max(deviation, 12 % of the mean), each at most 4; a statistic
            that has a target and cannot be measured counts 4.

        Raises
        ------
        ValueError
            If no target is among what is compared, or one is no pair of numbers.

        Examples
        --------
        >>> import crazing as cz
        >>> painting = {"fI": (0.137, 0.021), "loops_per_junction": (0.341, 0.022), "tortuosity": (1.032, 0.004)}
        >>> thesis = cz.measure(cz.crack(n=300, rng=1))
        >>> thesis.score(painting) > 2
        True
        """
        targets = _table(targets)
        known = {name: targets.get(name, targets.get(SYMBOLS.get(name, name))) for name in SCORED}
        wanted = [name for name, pair in known.items() if pair is not None and not math.isnan(_pair(name, pair)[0])]
        if not wanted:
            raise ValueError(f"targets has none of what is compared: {', '.join(SCORED)}")
        found = self.deviations(targets)
        return sum(min(abs(found.get(name, CAP)), CAP) for name in wanted) / len(wanted)

    def __str__(self) -> str:
        rows = [(name, SYMBOLS.get(name, ""), _text(value)) for name, value in self.to_dict().items()]
        columns = [max(map(len, column)) for column in zip(*rows, strict=True)]
        return "\n".join(
            f"{name:{columns[0]}}  {symbol:{columns[1]}}  {value:>{columns[2]}}" for name, symbol, value in rows
        )

    __repr__ = __str__


def _table(targets: Mapping[str, Target] | Measured) -> Mapping[str, Target]:
    """The pairs by name: as they are, or those of a preset's targets."""
    table = targets if isinstance(targets, Mapping) else getattr(targets, "measured", None)
    if not isinstance(table, Mapping):
        raise TypeError(f"targets is {type(targets).__name__}; pairs by name are wanted, or what crazing.targets gives")
    return table


def _pair(name: str, pair: Any) -> tuple[float, float]:
    try:
        mean, spread = (float(value) for value in list(pair)[:2])
    except (TypeError, ValueError):
        raise ValueError(f"targets[{name!r}] is {pair!r}; a mean and a standard deviation are wanted") from None
    return mean, spread


def _apart(difference: float, deviation: float) -> float:
    if deviation == 0:
        return difference * math.inf if difference else 0.0
    return difference / deviation


def _text(value: float) -> str:
    if math.isnan(value):
        return "-"
    is_whole = math.isfinite(value) and value == int(value) and abs(value) >= 2
    return str(int(value)) if is_whole else f"{value:.4g}"
