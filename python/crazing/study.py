"""Two skeleton methods on one contour, sampled more and more finely."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import panels
from crazing.arguments import count, found
from crazing.compare import Comparison, compare
from crazing.extras import require
from crazing.record import Record
from crazing.sample import from_image

if TYPE_CHECKING:
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False, repr=False)
class Study(Record):
    """Comparisons of two methods at several sizes; printed, it is a table with a line for each size and method.

    Attributes
    ----------
    comparisons : tuple of Comparison
        One a size, in the order asked for.

    Examples
    --------
    >>> import numpy as np, crazing as cz
    >>> image = np.zeros((40, 40))
    >>> image[10:30, 5:35] = 1
    >>> len(cz.compare_sizes(image, [30, 60]).comparisons)
    2
    """

    comparisons: tuple[Comparison, ...]

    @property
    def sizes(self) -> tuple[int, ...]:
        """How many samples each comparison has.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> cz.compare_sizes(np.pad(np.ones((9, 9)), 3), [24, 12]).sizes
        (24, 12)
        """
        return tuple(len(comparison.first.diagram.site_of) for comparison in self.comparisons)

    @property
    def table(self) -> list[dict[str, Any]]:
        """One mapping a size and method: `samples`, `method`, and the rows of `Comparison.table`.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> row = cz.compare_sizes(np.pad(np.ones((9, 9)), 3), [24]).table[0]
        >>> row["samples"], row["method"], row["crust edges"]
        (24, 'one-step', 24)
        """
        return [row for size, each in zip(self.sizes, self.comparisons, strict=True) for row in _rows(size, each)]

    def plot(self) -> Figure:
        """Draws a row of three panels for each size, as `Comparison.plot` does, with Matplotlib.

        Returns
        -------
        matplotlib.figure.Figure
            Not one of pyplot; saving it is left to the caller.

        Raises
        ------
        ImportError
            If Matplotlib is not installed.

        Examples
        --------
        >>> import numpy as np, crazing as cz
        >>> len(cz.compare_sizes(np.pad(np.ones((9, 9)), 3), [24, 12]).plot().axes)
        6
        """
        figure: Figure = require("matplotlib.figure", "plot").Figure(
            figsize=(panels.INCHES, 5.0 * len(self.comparisons)), layout="constrained"
        )
        grid = figure.subplots(len(self.comparisons), 3, squeeze=False)
        for axes, size, comparison in zip(grid, self.sizes, self.comparisons, strict=True):
            comparison.plot(axes)
            axes[0].set_title(f"{size} samples, {comparison.first.method}")
        return figure

    def __str__(self) -> str:
        table = self.table
        heads = list(table[0])
        lines = [heads, *([_text(row[head]) for head in heads] for row in table)]
        columns = [[line[i] for line in lines] for i in range(len(heads))]
        return "\n".join(_aligned(columns, row) for row in range(len(lines)))

    __repr__ = __str__


def _rows(size: int, comparison: Comparison) -> Iterator[dict[str, Any]]:
    for i, skeleton in enumerate((comparison.first, comparison.second)):
        yield {"samples": size, "method": skeleton.method, **{row[0]: row[1 + i] for row in comparison.table}}


def _aligned(columns: list[list[str]], row: int) -> str:
    return "  ".join(f"{column[row]:>{max(map(len, column))}}" for column in columns)


def _text(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def compare_sizes(
    image: ArrayLike,
    sizes: Sequence[int] | NDArray[np.integer[Any]],
    first: str = "one-step",
    second: str = "edge-filter",
    *,
    level: float | Sequence[float] = 0.5,
) -> Study:
    """Compares two skeleton methods on the contour of an image, for each of several numbers of samples.

    Parameters
    ----------
    image : array_like
        As for :func:`crazing.sample.from_image`.
    sizes : sequence of int
        Numbers of samples, each 3 or more.
    first, second : str
        Methods of `medial_axis`.
    level : float or sequence of float
        Brightness of the contour, or of several.

    Returns
    -------
    Study
        One comparison a size; `print` shows a table.

    Raises
    ------
    TypeError, ValueError
        If there is no size, or an argument is not what is listed above.
    CrazingError
        If there is no contour.
    ImportError
        If contourpy, of the extra `image`, is not installed.

    Notes
    -----
    Source: thesis, section 6.1, which has 192, 209, 383 and 1043 samples of one leaf.

    Examples
    --------
    >>> import numpy as np, crazing as cz
    >>> print(cz.compare_sizes(np.pad(np.ones((9, 9)), 3), [24, 12]))
    samples       method  crust edges  ...
         24     one-step           24  ...
         24  edge-filter           ...
         12     one-step           12  ...
    """
    if not np.iterable(sizes):
        raise TypeError(f"sizes is {found(sizes)}; a list of numbers of samples is wanted")
    numbers = [count(size, f"sizes[{i}]", low=3) for i, size in enumerate(sizes)]
    if not numbers:
        raise ValueError("sizes is empty; one number of samples or more is wanted")
    return Study(tuple(compare(from_image(image, level=level, n=n), first, second) for n in numbers))
