"""Mesh objects that carry the parts of a curve, text, surface or metaball.

A carrier is made when its curve is read, so that the curve is converted once. It is in
no collection until it gets its parts; Blender never saves it like that.
"""

from __future__ import annotations

import bpy
from mathutils import Matrix

from ..parts.materials import discard_unused, is_ours
from ..refusals import CONVERTIBLE
from ..stored.names import CARRIER_TAG
from .converting import converted


def carrier_for(obj: bpy.types.Object) -> bpy.types.Object:
    """Return the object to be read: a mesh itself, or a new carrier of a curve.

    Raises
    ------
    DecompositionError
        If no faces can be made of a curve.
    """
    if obj.type not in CONVERTIBLE:
        return obj
    mesh = converted(obj)
    carrier = bpy.data.objects.new(mesh.name, mesh)
    carrier[CARRIER_TAG] = obj.name
    carrier.parent = obj
    # Blender computes no matrices of objects that are in no collection.
    carrier.matrix_world = obj.matrix_world
    return carrier


def placed_carrier(obj: bpy.types.Object) -> bpy.types.Object:
    """Return the object to be written to: a mesh itself, or the carrier of a curve.

    The carrier is placed beside the curve, instead of an earlier one, and becomes the
    active object. It is made again if undo has removed it meanwhile.
    """
    if obj.type not in CONVERTIBLE:
        return obj
    waiting = [child for child in obj.children if is_waiting(child)]
    carrier = waiting[0] if waiting else carrier_for(obj)
    for child in obj.children:
        if CARRIER_TAG in child and child != carrier:
            _remove(child)
    carrier.name = carrier.data.name = f"{obj.name} parts"
    carrier.matrix_basis = Matrix()
    for collection in obj.users_collection:
        collection.objects.link(carrier)
    bpy.context.view_layer.update()
    # The user may look at another view layer since the computation began.
    shown = bpy.context.view_layer.objects
    if carrier.name in shown:
        obj.select_set(False)
        carrier.select_set(True)
        shown.active = carrier
    return carrier


def discard_waiting() -> None:
    """Remove the carriers that got no parts."""
    for obj in [obj for obj in bpy.data.objects if is_waiting(obj)]:
        _remove(obj)


def is_waiting(obj: bpy.types.Object) -> bool:
    """Return whether an object is a carrier without parts so far."""
    return CARRIER_TAG in obj and obj.users == 0


def _remove(carrier: bpy.types.Object) -> None:
    """Remove a carrier, and its mesh if nothing else uses it."""
    mesh = carrier.data
    materials = {material for material in mesh.materials if is_ours(material)}
    bpy.data.objects.remove(carrier)
    if mesh.users == 0:
        bpy.data.meshes.remove(mesh)
    discard_unused(materials)
