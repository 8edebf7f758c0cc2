"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""

from crazing.files import save_png
from crazing.render import Style, render

__all__ = ["Style", "render", "save_png"]
