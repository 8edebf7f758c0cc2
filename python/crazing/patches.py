"""Patches: a smooth field by which plates are finer here and coarser there."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

#: Waves that are added up: enough that their sum is nearly normal.
WAVES = 32
#: The longest wave is so many times the shortest.
SPAN = 2.0


@dataclass(frozen=True, eq=False)
class Patches:
    """A sum of waves, with mean 0 and standard deviation 1 over all its phases.

    Attributes
    ----------
    turns : (WAVES, 2) float64
        Turns a data unit along x and y; whole ones a period on a torus.
    starts : (WAVES,) float64
        Turns at the origin.
    """

    turns: NDArray[np.float64]
    starts: NDArray[np.float64]

    @classmethod
    def of(cls, size: float, period: tuple[float, float] | None, seed: np.random.Generator) -> Patches:
        """Patches about `size` across, data units; a wave that no period holds is the longest one that it does."""
        words = seed.bit_generator.random_raw(3 * WAVES).reshape(3, WAVES)
        angle, length, starts = (words >> np.uint64(11)) * 2.0**-53
        # A patch is half a wave.
        rate = SPAN ** (length - 0.5) / (2 * size)
        turns = rate[:, None] * np.column_stack([np.cos(2 * np.pi * angle), np.sin(2 * np.pi * angle)])
        if period is not None:
            whole = np.rint(turns * period)
            none = ~whole.any(axis=1)
            along = np.abs(turns[none] * period).argmax(axis=1)
            whole[none, along] = 1.0
            turns = whole / period
        return cls(turns, starts)

    def over(
        self, u: NDArray[np.float64], v: NDArray[np.float64], matrix: NDArray[np.float64], centre: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """(len(v), len(u)) the field at ``matrix @ (u, v) + centre``: one product, as every wave is one of two."""
        turns, starts = self.turns @ matrix, self.turns @ centre + self.starts
        across = np.exp(2j * np.pi * np.outer(turns[:, 0], u))
        down = np.exp(2j * np.pi * (np.outer(v, turns[:, 1]) + starts))
        return np.asarray((down @ across).real * (2 / WAVES) ** 0.5)
