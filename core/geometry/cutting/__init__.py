"""Polygons cut into triangles, and large faces along seams of a finer mesh."""
