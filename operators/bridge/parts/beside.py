"""Collections beside an object, for what is made of it."""

from __future__ import annotations

import bpy


def new_collection(obj: bpy.types.Object, name: str) -> bpy.types.Collection:
    """Return a new collection where an object is, as far as that can be changed."""
    collection = bpy.data.collections.new(name)
    homes = [c for c in obj.users_collection if c.is_editable]
    (homes[0] if homes else bpy.context.scene.collection).children.link(collection)
    return collection
