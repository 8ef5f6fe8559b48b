"""What shapes are: meshes, points, samples, graphs of faces."""
