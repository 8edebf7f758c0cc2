"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""

from crazing import sample, steps
from crazing._core import __version__
from crazing.centerline import centerline
from crazing.compare import Comparison, compare
from crazing.crack import Crack
from crazing.dataset import Dataset, LabelledImage, dataset
from crazing.diagram import Diagram, diagram
from crazing.edit import edit
from crazing.errors import CrazingError, DegenerateInputError, InternalError
from crazing.files import save_png
from crazing.fit import fit
from crazing.graph import PlanarGraph
from crazing.material import Material
from crazing.maze import Maze, maze
from crazing.maze_statistics import MazeStatistics
from crazing.measure import measure
from crazing.preview import preview
from crazing.quad_edge import QuadEdge
from crazing.recipe import Recipe, crack, preset, presets
from crazing.render import Style, render
from crazing.rerun import rerun
from crazing.shade import shade
from crazing.skeleton import Skeleton, crust, curve, medial_axis, nested, poles
from crazing.statistics import CrackStatistics
from crazing.streaming import write_texture
from crazing.study import Study, compare_sizes
from crazing.targets import Targets, targets
from crazing.texture import Texture, TexturePlan, texture, texture_plan
from crazing.versions import algorithm_version, show_versions

__all__ = [
    "Comparison",
    "Crack",
    "CrackStatistics",
    "CrazingError",
    "Dataset",
    "DegenerateInputError",
    "Diagram",
    "InternalError",
    "LabelledImage",
    "Material",
    "Maze",
    "MazeStatistics",
    "PlanarGraph",
    "QuadEdge",
    "Recipe",
    "Skeleton",
    "Study",
    "Style",
    "Targets",
    "Texture",
    "TexturePlan",
    "__version__",
    "algorithm_version",
    "centerline",
    "compare",
    "compare_sizes",
    "crack",
    "crust",
    "curve",
    "dataset",
    "diagram",
    "edit",
    "fit",
    "maze",
    "measure",
    "medial_axis",
    "nested",
    "poles",
    "preset",
    "presets",
    "preview",
    "render",
    "rerun",
    "sample",
    "save_png",
    "shade",
    "show_versions",
    "steps",
    "targets",
    "texture",
    "texture_plan",
    "write_texture",
]


def __dir__() -> list[str]:
    """What is public: the rooms inside are not for completion."""
    return __all__
