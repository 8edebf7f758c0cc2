"""What makes a maze hard, in numbers."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from crazing.maze import Maze


@dataclass(frozen=True)
class MazeStatistics:
    """Counts of a maze. Made by :attr:`crazing.Maze.statistics`.

    Attributes
    ----------
    cells : int
        Cells; of a maze within a shape those that have a door.
    dead_ends : int
        Cells with one open door.
    junctions : int
        Cells with three open doors or more.
    solution : int
        Cells on the way between the `ends`; 0 when there is none.
    winding : float
        Length of that way over the straight distance between its ends.
    """

    cells: int
    dead_ends: int
    junctions: int
    solution: int
    winding: float


def statistics(maze: Maze) -> MazeStatistics:
    """Those of a maze."""
    sides, open_doors = maze.sides, maze.open if maze.plan is None else maze.plan.open
    doors = np.bincount(sides[open_doors].ravel(), minlength=maze.size)
    cells = maze.size if maze.plan is None else int((np.bincount(sides[sides >= 0], minlength=maze.size) > 0).sum())
    counts = cells, int((doors == 1).sum()), int((doors > 2).sum())
    if not maze.ends:
        return MazeStatistics(*counts, 0, 1.0)
    way = maze.solve(*maze.ends)
    line = maze.path(way)
    ends = line.vertices[[0, -1]] if maze.diagram.period is None else maze.centres[way[[0, -1]]]
    straight = float(np.linalg.norm(ends[1] - ends[0]))
    return MazeStatistics(*counts, len(way), line.length / straight if straight else 1.0)
