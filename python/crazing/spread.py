"""Points at even distances along lines: how many each is given, and where they lie."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from crazing.errors import CrazingError

if TYPE_CHECKING:
    from crazing.contour import Contours

#: Fewest points a line is given: with two, a closed line would be gone.
FEWEST = 3
#: Most points in all; sharing them out takes several times their memory.
MOST = 100_000_000


def travelled(lines: Contours) -> NDArray[np.float64]:
    """(k + 1,) distance from the first point of the first line, with no gap between lines.

    Written without `np.hypot` and `np.interp`, whose last bit depends on the platform.
    """
    if not len(lines):
        return np.zeros(1)
    steps = _following(lines) - lines.coords
    squares = steps * steps
    lengths = np.sqrt(squares[:, 0] + squares[:, 1])
    lengths[lines.offsets[1:][~lines.closed] - 1] = 0.0
    return np.concatenate([[0.0], np.cumsum(lengths)])


def _following(lines: Contours) -> NDArray[np.float64]:
    """The point after each; after the last of a line, its first."""
    after = np.roll(lines.coords, -1, axis=0)
    after[lines.offsets[1:] - 1] = lines.coords[lines.offsets[:-1]]
    return after


def shares(length: NDArray[np.float64], n: int) -> NDArray[np.int64]:
    """`n` points shared among lines in proportion to length, 3 or more to a line or none.

    The longest lines are kept, as many as have each a fair share of 3 among themselves; then whole shares are given
    and the rest by largest remainder. Ties go to the line that comes first.

    Parameters
    ----------
    length : (lines,) float64
        Positive; one line or more.
    n : int
        3 or more.

    Returns
    -------
    (lines,) int64
        Points of every line; their sum is `n`.

    Notes
    -----
    Source: the largest-remainder rule of Hamilton, for seats in proportion to votes.

    Examples
    --------
    >>> import numpy as np
    >>> from crazing.spread import shares
    >>> shares(np.array([10.0, 1.0, 20.0]), 10)
    array([3, 0, 7])
    """
    order = np.argsort(-length, kind="stable")
    sums = np.cumsum(length[order])
    # Each line's share among itself and the longer ones: it never grows along the order, and the first is n.
    fair = n * length[order] / sums >= FEWEST
    kept = max(1, int(np.logical_and.accumulate(fair).sum()))
    quota = n * length[order[:kept]] / sums[kept - 1]
    counts = np.floor(quota).astype(np.int64)
    largest = np.argsort(counts - quota, kind="stable")
    counts[largest[: n - int(counts.sum())]] += 1
    result = np.zeros(len(length), dtype=np.int64)
    result[order[:kept]] = counts
    return result


def counts_at(lines: Contours, step: float) -> NDArray[np.int64]:
    """Points of every line that bring its step nearest to `step`; 0 for lines too short for 3 points."""
    length = lines.length
    with np.errstate(over="ignore", divide="ignore"):
        total = float((length / step).sum())
    if not total <= MOST:
        least = float(length.sum()) / MOST
        raise ValueError(f"spacing is {step:g}; at least {least:g} is wanted for lines of {length.sum():g} in all")
    counts = np.rint(length / step).astype(np.int64) + ~lines.closed
    counts[counts < FEWEST] = 0
    if not counts.any():
        longest = float(lines.length.max(initial=0.0))
        raise CrazingError(f"spacing is {step:g}; the longest line, of {longest:g}, is too short for it")
    return counts


def walk(lines: Contours, counts: NDArray[np.int64]) -> NDArray[np.float64]:
    """`counts[j]` points at even distances along line j."""
    along, length = travelled(lines), lines.length
    line = np.repeat(np.arange(len(lines)), counts)
    step = np.arange(len(line)) - np.repeat(np.cumsum(counts) - counts, counts)
    gaps = np.where(lines.closed, counts, counts - 1)[line]
    start, stop = lines.offsets[line], lines.offsets[line + 1]
    distance = along[start] + length[line] * step / gaps
    # The edge that holds the distance; rounding must not lead it into a neighbouring line.
    edge = np.clip(np.searchsorted(along, distance, side="right") - 1, start, stop - 1)
    span = along[edge + 1] - along[edge]
    part = np.divide(distance - along[edge], span, out=np.zeros(len(line)), where=span > 0)
    after = _following(lines)
    return lines.coords[edge] + np.clip(part, 0.0, 1.0)[:, None] * (after[edge] - lines.coords[edge])
