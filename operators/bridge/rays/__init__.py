"""Ray casters: Blender's BVH tree and Embree."""
