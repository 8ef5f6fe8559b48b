"""Geometry of the input: meshes, point clouds, samples and face graphs."""
