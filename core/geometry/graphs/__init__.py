"""Graphs of the input: edges of triangles, faces that touch, patches of faces."""
