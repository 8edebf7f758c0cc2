"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""

from crazing._core import __version__
from crazing.compare import Comparison, compare
from crazing.graph import PlanarGraph
from crazing.versions import algorithm_version, show_versions

__all__ = [
    "Comparison",
    "PlanarGraph",
    "__version__",
    "algorithm_version",
    "compare",
    "show_versions",
]
