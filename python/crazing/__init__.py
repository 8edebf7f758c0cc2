"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""

from crazing import sample
from crazing._core import __version__
from crazing.centerline import centerline
from crazing.compare import Comparison, compare
from crazing.crack import Crack, crack
from crazing.diagram import Diagram, QuadEdge, diagram
from crazing.errors import CrazingError, DegenerateInputError, InternalError
from crazing.files import save_png
from crazing.graph import PlanarGraph
from crazing.maze import Maze, MazeStatistics, maze
from crazing.render import Style, render
from crazing.skeleton import Skeleton, crust, curve, medial_axis, nested, poles
from crazing.study import Study, compare_sizes
from crazing.versions import algorithm_version, show_versions

__all__ = [
    "Comparison",
    "Crack",
    "CrazingError",
    "DegenerateInputError",
    "Diagram",
    "InternalError",
    "Maze",
    "MazeStatistics",
    "PlanarGraph",
    "QuadEdge",
    "Skeleton",
    "Study",
    "Style",
    "__version__",
    "algorithm_version",
    "centerline",
    "compare",
    "compare_sizes",
    "crack",
    "crust",
    "curve",
    "diagram",
    "maze",
    "medial_axis",
    "nested",
    "poles",
    "render",
    "sample",
    "save_png",
    "show_versions",
]
