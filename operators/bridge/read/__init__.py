"""Objects of Blender become shapes."""
