"""Ray casters: Blender's BVH tree."""
