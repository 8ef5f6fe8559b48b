"""Where an object is: in which collections and view layers, and below which parent."""

from __future__ import annotations

from collections.abc import Iterator

import bpy
from mathutils import Matrix


def homes_of(obj: bpy.types.Object) -> list[bpy.types.Collection]:
    """Return the collections that hold an object, without those of simulations.

    What belongs to the object goes there, too. What is in the collection of a
    simulation is a rigid body, and may be in no view.
    """
    worlds = [scene.rigidbody_world for scene in bpy.data.scenes]
    simulated = {
        collection
        for world in worlds
        if world
        for collection in (world.collection, world.constraints)
    }
    return [each for each in obj.users_collection if each not in simulated]


def view_layers() -> list[bpy.types.ViewLayer]:
    """Return the view layers of all scenes."""
    return [layer for scene in bpy.data.scenes for layer in scene.view_layers]


def objects_in(layer: bpy.types.ViewLayer) -> set[bpy.types.Object]:
    """Return the objects that a view layer has.

    Names do not tell: a linked object may have the same.
    """
    return set(layer.objects)


def new_collection(obj: bpy.types.Object, name: str) -> bpy.types.Collection:
    """Return a new collection beside an object."""
    home, collection = home_of(obj), bpy.data.collections.new(name)
    home.children.link(collection)
    return collection


def bring_into_view_layer(
    collection: bpy.types.Collection, obj: bpy.types.Object
) -> None:
    """Put a collection beside an object, too, if the present view layer lacks it."""
    home = home_of(obj)
    if collection in home.children[:]:
        return
    if collection not in _shown_in(bpy.context.view_layer):
        home.children.link(collection)


def home_of(obj: bpy.types.Object) -> bpy.types.Collection:
    """Return the collection for something new that has to be seen where an object is.

    It holds the object, too, and the present view layer shows it if it shows one that
    does. It is the scene's collection if nothing can be put into those.
    """
    homes = homes_of(obj)
    if len(homes) > 1:  # else there is no choice, and scenes have many collections
        shown = _shown_in(bpy.context.view_layer)
        here = [each for each in homes if each in shown]
        homes = sorted(here, key=lambda each: not shown[each]) or homes
    return next(filter(takes_more, homes), bpy.context.scene.collection)


def takes_more(collection: bpy.types.Collection) -> bool:
    """Return whether something can be put into a collection.

    Those of libraries take nothing, nor do overrides of them.
    """
    return collection.is_editable and collection.override_library is None


def _shown_in(layer: bpy.types.ViewLayer) -> dict[bpy.types.Collection, bool]:
    """Return the collections of a view layer, and of each whether it is shown."""
    found: dict[bpy.types.Collection, bool] = {}
    for each in layer_collections(layer):
        found[each.collection] = found.get(each.collection, False) or each.is_visible
    return found


def layer_collections(
    layer: bpy.types.ViewLayer,
) -> Iterator[bpy.types.LayerCollection]:
    """Yield the collections of a view layer; one that is linked twice comes twice."""
    waiting = [layer.layer_collection]
    while waiting:
        each = waiting.pop()
        yield each
        waiting.extend(each.children)


def within_parent(obj: bpy.types.Object) -> Matrix:
    """Return the matrix from the space of an object to its parent's, or the scene's."""
    if obj.parent is None:  # Blender keeps the inverse, and does not use it
        return obj.matrix_basis.copy()
    return obj.matrix_parent_inverse @ obj.matrix_basis


def hand_over(
    child: bpy.types.Object, parent: bpy.types.Object | None, within: Matrix
) -> None:
    """Give a child of an object another parent, or none, and leave it in place.

    Its location stays what it is below a parent: that may be animated. A child that
    vertices hold is held by all of the parent: their numbers are others there. The
    matrix `within` is from the space of the former parent to that of `parent`, or of
    the scene.
    """
    inverse = child.matrix_parent_inverse.copy()
    if child.parent_type.startswith("VERTEX"):
        place = child.parent.matrix_world.inverted_safe() @ child.matrix_world
        inverse = place @ child.matrix_basis.inverted_safe()
        child.parent_type = "OBJECT"
    child.parent = parent
    child.matrix_parent_inverse = within @ inverse  # Blender resets it with the parent
    if parent is None:
        child.matrix_basis = within @ inverse @ child.matrix_basis
