"""The collections that hulls are in: one for each object, made by us."""

from __future__ import annotations

import bpy

from ..homes import bring_into_view_layer, new_collection, takes_more
from ..stored.names import HULL_TAG
from .listed import hulls_of


def hull_collections() -> list[bpy.types.Collection]:
    """Return the collections that we made for hulls, and can change."""
    return [c for c in bpy.data.collections if HULL_TAG in c and c.is_editable]


def own_collection(obj: bpy.types.Object) -> bpy.types.Collection | None:
    """Return our collection that holds hulls of an object, and of no other one."""
    own = set(hulls_of(obj))
    for collection in hull_collections() if own else ():
        hulls = {each for each in collection.objects if HULL_TAG in each}
        if hulls and hulls <= own and takes_more(collection):
            return collection
    return None


def collection_for(
    obj: bpy.types.Object, former: bpy.types.Collection | None
) -> bpy.types.Collection:
    """Return the collection for new hulls of an object: the former one, or a new one.

    The user may have instanced, excluded, colored or renamed the former.
    """
    name = f"{obj.name} hulls"
    if former is None:
        collection = new_collection(obj, name)
    else:
        collection = former
        bring_into_view_layer(collection, obj)
        if collection.name == f"{collection[HULL_TAG]} hulls":
            collection.name = name
    collection[HULL_TAG] = obj.name
    return collection


def remove_empty_collections(kept: bpy.types.Collection | None) -> None:
    """Remove the collections that we made for hulls, but `kept`, that hold nothing."""
    for collection in hull_collections():
        if collection == kept or collection.all_objects or collection.children:
            continue
        bpy.data.collections.remove(collection)
