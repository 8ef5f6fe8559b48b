"""Find hulls that nobody has any more, as after their object was joined to another."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import bpy

from ..homes import homes_of
from ..stored.names import HULL_TAG, RESULT
from ..stored.noted_hulls import figures_on, noted_hulls
from ..stored.record import record_if_ours
from .hull_collections import hull_collections
from .listed import hulls_of, listed_hulls


def lost_hulls() -> list[bpy.types.Object]:
    """Return the hulls whose object is gone from the file.

    They are in a collection that we made, and no object notes them. A hull is the
    user's if the user put it into another collection, joined something to it, or works
    on it.
    """
    found = [
        hull
        for collection in hull_collections()
        if _object_is_gone(collection)
        for hull in _without_object(collection)
    ]
    noted = set().union(*map(noted_by, bpy.data.objects)) if found else set()
    return [hull for hull in dict.fromkeys(found) if hull.name not in noted]


def hulls_to_clear() -> Callable[[bpy.types.Object], bool]:
    """Return what tells whether our collections hold hulls of an object, or lost ones.

    It looks at the file once: panels ask many times a second, and files have thousands
    of objects.
    """
    there = (each for c in hull_collections() for each in c.objects)
    owners = {each.parent for each in there if HULL_TAG in each}
    some_are_lost = bool(lost_hulls())
    return lambda obj: HULL_TAG not in obj and (some_are_lost or obj in owners)


def leave_to_user(obj: bpy.types.Object) -> None:
    """Let hulls be the user's from now on that the user took or joined something to.

    So are copies of hulls: the object notes no more hulls than we made.
    """
    entries = noted_hulls(record_if_ours(obj))
    listed = listed_hulls(obj, entries).values()
    for hull in hulls_of(obj):
        if has_more(hull) or (entries and hull not in listed):
            del hull[HULL_TAG]
    noted = noted_by(obj)
    for collection in hull_collections():
        if collection[HULL_TAG] == obj.name:
            for hull in list(_without_object(collection)):
                if hull.name in noted:
                    del hull[HULL_TAG]


def _object_is_gone(collection: bpy.types.Collection) -> bool:
    """Return whether the object that a collection was made for is gone.

    Another one may have its name now: that has no hulls, or the hulls may be its own.
    """
    name = collection[HULL_TAG]
    return name not in bpy.data.objects or not noted_by(bpy.data.objects[name])


def _without_object(collection: bpy.types.Collection) -> Iterator[bpy.types.Object]:
    """Yield the hulls in a collection that have no object, and are in it alone."""
    for hull in collection.objects:
        if HULL_TAG not in hull or RESULT in hull or not hull.is_editable:
            continue
        if _n_more(hull) != 0:
            continue
        if hull.parent is None and all(HULL_TAG in each for each in homes_of(hull)):
            yield hull


def has_more(hull: bpy.types.Object) -> bool:
    """Return whether a hull has more than we made, as after a join of other objects."""
    return _n_more(hull) > 0


def _n_more(hull: bpy.types.Object) -> int:
    """Return how many more vertices a hull has than we made."""
    n_vertices: int = len(hull.data.vertices)
    return n_vertices - int(figures_on(hull).get("vertices", n_vertices))


def noted_by(obj: bpy.types.Object) -> set[str]:
    """Return the names of the hulls that an object notes."""
    return {hull["name"] for hull in noted_hulls(record_if_ours(obj))}
