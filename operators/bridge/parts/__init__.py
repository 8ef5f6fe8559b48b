"""Parts as Blender's data: groups, materials, attributes, objects."""
