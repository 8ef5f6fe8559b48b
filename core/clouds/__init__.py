"""Surfaces from point clouds: normals, splats and graphs of neighbors."""
