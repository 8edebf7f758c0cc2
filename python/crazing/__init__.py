"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""

from crazing import sample

__all__ = ["sample"]
