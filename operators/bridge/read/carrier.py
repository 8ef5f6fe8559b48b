"""Mesh objects that carry the parts of something that cannot carry them itself.

This is a curve, text, surface or metaball, or a mesh whose modifiers make other faces.
A carrier is made when its source is read, so that a curve is converted once. It is in
no collection until it gets its parts; Blender never saves it like that.
"""

from __future__ import annotations

import bpy
from mathutils import Matrix

from ..homes import homes_of, objects_in
from ..parts.erase import erase_parts
from ..parts.materials import discard
from ..refusals import CONVERTIBLE
from ..stored.names import CARRIER_TAG, HIDDEN_IN_TAG, HIDDEN_TAG, HULL_TAG
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
    earlier = [child for child in obj.children if CARRIER_TAG in child]
    _remove(obj, [each for each in earlier if each != carrier])
    carrier.name = carrier.data.name = f"{obj.name} parts"
    carrier.data[CARRIER_TAG] = carrier.data.name
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
    source, layer = carrier.parent, bpy.context.view_layer
    there = source in objects_in(layer)
    was_shown = there and not source.hide_get()
    carrier[HIDDEN_TAG] = [was_shown, not source.hide_render]
    if was_shown:
        carrier[HIDDEN_IN_TAG] = [bpy.context.scene.name, layer.name]
    if there:
        source.hide_set(True)
    source.hide_render = True


def _show_source(carrier: bpy.types.Object) -> None:
    """Show the source of a carrier as it was before."""
    source, was_shown = carrier.parent, carrier.get(HIDDEN_TAG)
    if source is None or was_shown is None:
        return
    in_view, in_render = was_shown
    layer = _layer_of(carrier)
    if in_view and source in objects_in(layer):
        source.hide_set(False, view_layer=layer)
    if in_render:
        source.hide_render = False


def _layer_of(carrier: bpy.types.Object) -> bpy.types.ViewLayer:
    """Return the view layer in which we hid the source of a carrier.

    It is the present one if that is not known: older versions did not note it, and the
    user may rename it.
    """
    scene, name = carrier.get(HIDDEN_IN_TAG, ("", ""))
    layers = bpy.data.scenes[scene].view_layers if scene in bpy.data.scenes else {}
    return layers.get(name) or bpy.context.view_layer


def _remove(source: bpy.types.Object, carriers: list[bpy.types.Object]) -> None:
    """Remove carriers of a source, and show it; some are the user's from now on.

    These are all copies, and carriers that the user converted to something else, or
    that have children of the user's.
    """
    there = [child for child in source.children if CARRIER_TAG in child]
    copies = list(filter(is_copy, there))  # while the carriers are there
    for carrier in carriers:
        _show_source(carrier)
        if carrier in copies:
            continue
        only_hulls = all(HULL_TAG in child for child in carrier.children)
        if only_hulls and carrier.type == "MESH":
            discard([carrier])
        else:
            _leave_to_user(carrier)
    for copy in copies:
        _leave_to_user(copy)


def is_copy(carrier: bpy.types.Object) -> bool:
    """Return whether the user copied an object to have this one.

    The mesh notes its own name, which a copy of it cannot have. Copies that share the
    mesh have another name. A carrier that the user renamed still has its mesh alone.
    """
    if is_waiting(carrier):
        return False
    mesh = carrier.data
    noted = mesh.get(CARRIER_TAG, f"{carrier[CARRIER_TAG]} parts")  # older: no note
    return carrier.name != noted and (mesh.name != noted or mesh.users > 1)


def _leave_to_user(carrier: bpy.types.Object) -> None:
    """Let a carrier be an object like others."""
    for tag in (CARRIER_TAG, HIDDEN_TAG, HIDDEN_IN_TAG):
        carrier.pop(tag, None)
    if carrier.data.users == 1:  # else a carrier may be known by it
        carrier.data.pop(CARRIER_TAG, None)


def clear_carrier(carrier: bpy.types.Object) -> None:
    """Remove a carrier, and show its source again, which gets selected.

    A carrier that has children of the user's, or has lost its source, stays. So does a
    copy, and its source stays hidden for the carrier.
    """
    source = carrier.parent
    if source is None:
        return
    if is_copy(carrier):
        _remove(source, [])
        return
    layers = _layers_with(carrier)
    _remove(source, [carrier])
    for layer in layers:
        if source in objects_in(layer):
            source.select_set(True, view_layer=layer)
            layer.objects.active = source


def _layers_with(carrier: bpy.types.Object) -> list[bpy.types.ViewLayer]:
    """Return the view layers whose active object is a carrier, and the present one."""
    present = bpy.context.view_layer
    layers = [layer for scene in bpy.data.scenes for layer in scene.view_layers]
    return [at for at in layers if at == present or at.objects.active == carrier]


def discard_waiting() -> None:
    """Remove the carriers that got no parts."""
    for obj in [obj for obj in bpy.data.objects if is_waiting(obj)]:
        discard([obj])


def is_waiting(obj: bpy.types.Object) -> bool:
    """Return whether an object is a carrier without parts so far."""
    return CARRIER_TAG in obj and obj.users == 0
