"""Voronoi curves, skeletons, mazes and crack textures, computed in Rust."""
