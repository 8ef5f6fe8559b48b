"""Arrays from and to Blender's meshes and point clouds."""
