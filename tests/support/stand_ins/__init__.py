"""Stand-ins for what Blender as a Python module lacks: windows and panels."""
