"""Guibas and Stolfi's quad-edge: operators over the edge table of a diagram."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crazing import arguments
from crazing.record import Record

if TYPE_CHECKING:
    from crazing.diagram import Diagram


@dataclass(frozen=True, eq=False, repr=False)
class QuadEdge(Record):
    """Guibas and Stolfi's quad-edge over a diagram.

    Quarter-edge ``q = 4 * k + r`` is edge `k` turned by `r` quarters: `r` = 0 runs from ``edges[k, 0]`` to
    ``edges[k, 1]``, 1 is its dual from the right to the left, 2 and 3 are these two reversed. All operators take and
    give arrays of quarter-edges.

    Attributes
    ----------
    diagram : Diagram
        Whose edges these are.
    links : (4 m,) int32
        `onext` of every quarter-edge.

    Examples
    --------
    >>> import crazing as cz
    >>> quad = cz.diagram([(0, 0), (1, 0), (0, 1)]).quad_edge
    >>> bool((quad.rot(quad.onext(quad.rot(quad.onext(quad.all)))) == quad.all).all())
    True
    """

    diagram: Diagram
    links: NDArray[np.int32]

    @property
    def all(self) -> NDArray[np.int32]:
        """Every quarter-edge, (4 m,) int32."""
        return np.arange(len(self.links), dtype=np.int32)

    def rot(self, q: ArrayLike) -> NDArray[np.int32]:
        """The dual, from the right to the left.

        Parameters
        ----------
        q : array_like of int
            Quarter-edges.

        Returns
        -------
        ndarray of int32
            Quarter-edges.
        """
        q = quarters(q, self.links)
        return (q & ~3) | ((q + 1) & 3)

    def sym(self, q: ArrayLike) -> NDArray[np.int32]:
        """The same edge the other way.

        Parameters
        ----------
        q : array_like of int
            Quarter-edges.

        Returns
        -------
        ndarray of int32
            Quarter-edges.
        """
        return quarters(q, self.links) ^ 2

    def onext(self, q: ArrayLike) -> NDArray[np.int32]:
        """The next quarter-edge counter-clockwise about the same origin.

        Parameters
        ----------
        q : array_like of int
            Quarter-edges.

        Returns
        -------
        ndarray of int32
            Quarter-edges.
        """
        found: NDArray[np.int32] = self.links[quarters(q, self.links)]
        return found

    def origin(self, q: ArrayLike) -> NDArray[np.int32]:
        """Where it starts.

        Parameters
        ----------
        q : array_like of int
            Quarter-edges.

        Returns
        -------
        ndarray of int32
            Sites where `q` is even, Voronoi vertices (or -1, infinity) where it is odd.
        """
        q = quarters(q, self.links)
        k, r = q >> 2, q & 3
        dual: NDArray[np.int32] = self.diagram.dual_edges[k, r >> 1]
        return np.where(r & 1, dual, self.diagram.edges[k, r >> 1])

    def __repr__(self) -> str:
        return f"QuadEdge({len(self.links)} quarter-edges)"


def quarters(q: ArrayLike, links: NDArray[np.int32]) -> NDArray[np.int32]:
    """`q` as an int32 array of quarter-edges that exist."""
    array = arguments.regular(q, "q")
    if array.dtype.kind not in "iu" and array.size:
        raise TypeError(f"quarter-edges have dtype {array.dtype}; integers are wanted")
    if array.size and not (array.min() >= 0 and array.max() < len(links)):
        wrong = array.min() if array.min() < 0 else array.max()
        raise ValueError(f"a quarter-edge is {wrong}; 0 to {len(links) - 1} are wanted")
    return np.asarray(array, dtype=np.int32)
