"""Mesh objects that carry the parts of something that cannot carry them itself.

This is a curve, text, surface or metaball, or a mesh whose modifiers make other faces.
A carrier is made when its source is read, so that a curve is converted once. It is in
no collection until it gets its parts; Blender never saves it like that.
"""

from __future__ import annotations

import bpy
from mathutils import Matrix

from ..homes import homes_of
from ..parts.erase import erase_parts
from ..parts.materials import discard
from ..refusals import CONVERTIBLE
from ..stored.names import CARRIER_TAG, HIDDEN_TAG
from .converting import converted
from .evaluated import SeenMesh
from .shown_mesh import evaluated_copy


def carrier_for(
    obj: bpy.types.Object, seen: SeenMesh | None = None
) -> bpy.types.Object:
    """Return the object to be read: a mesh itself, or a new carrier.

    Parameters
    ----------
    obj : bpy.types.Object
    seen : SeenMesh, optional
        The mesh as it is seen, if that is read.

    Raises
    ------
    DecompositionError
        If no faces can be made of a curve.
    """
    if not _needs_carrier(obj, seen):
        return obj
    mesh = evaluated_copy(obj) if obj.type == "MESH" else converted(obj)
    carrier = bpy.data.objects.new(mesh.name, mesh)
    carrier[CARRIER_TAG] = obj.name
    carrier.parent = obj
    # Blender computes no matrices of objects that are in no collection.
    carrier.matrix_world = obj.matrix_world
    erase_parts(carrier)  # they came with the mesh that is seen
    return carrier


def _needs_carrier(obj: bpy.types.Object, seen: SeenMesh | None) -> bool:
    return obj.type in CONVERTIBLE or (seen is not None and not seen.corresponds)


def placed_carrier(
    obj: bpy.types.Object, seen: SeenMesh | None = None
) -> bpy.types.Object:
    """Return the object to be written to: a mesh itself, or its carrier.

    The carrier is placed beside its source, instead of an earlier one, and becomes the
    active object; the source is hidden. The carrier is made again if undo has removed
    it meanwhile.
    """
    if not _needs_carrier(obj, seen):
        return obj
    waiting = [child for child in obj.children if is_waiting(child)]
    carrier = waiting[0] if waiting else carrier_for(obj, seen)
    for child in obj.children:
        if CARRIER_TAG in child and child != carrier:
            _show_source(child)
            discard([child])
    carrier.name = carrier.data.name = f"{obj.name} parts"
    carrier.matrix_basis = Matrix()
    for collection in homes_of(obj):
        collection.objects.link(carrier)
    bpy.context.view_layer.update()
    # The user may look at another view layer since the computation began.
    shown = bpy.context.view_layer.objects
    if carrier.name in shown:
        obj.select_set(False)
        carrier.select_set(True)
        shown.active = carrier
    _hide_source(carrier)
    return carrier


def _hide_source(carrier: bpy.types.Object) -> None:
    """Hide the source of a carrier, and note on it how that was shown."""
    source = carrier.parent
    there = source.name in bpy.context.view_layer.objects
    carrier[HIDDEN_TAG] = [there and not source.hide_get(), not source.hide_render]
    if there:
        source.hide_set(True)
    source.hide_render = True


def _show_source(carrier: bpy.types.Object) -> None:
    """Show the source of a carrier as it was before."""
    source, was_shown = carrier.parent, carrier.get(HIDDEN_TAG)
    if source is None or was_shown is None:
        return
    in_view, in_render = was_shown
    if in_view and source.name in bpy.context.view_layer.objects:
        source.hide_set(False)
    if in_render:
        source.hide_render = False


def clear_carrier(carrier: bpy.types.Object) -> None:
    """Remove a carrier, and show its source again, which gets selected.

    A carrier that has children of the user's, or has lost its source, stays.
    """
    source, layer = carrier.parent, bpy.context.view_layer.objects
    if source is None:
        return
    _show_source(carrier)
    if not carrier.children:
        discard([carrier])
    if source.name in layer:
        source.select_set(True)
        layer.active = source


def discard_waiting() -> None:
    """Remove the carriers that got no parts."""
    for obj in [obj for obj in bpy.data.objects if is_waiting(obj)]:
        discard([obj])


def is_waiting(obj: bpy.types.Object) -> bool:
    """Return whether an object is a carrier without parts so far."""
    return CARRIER_TAG in obj and obj.users == 0
