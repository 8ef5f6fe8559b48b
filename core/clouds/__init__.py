"""What points have in place of faces: normals, splats, neighbors."""
