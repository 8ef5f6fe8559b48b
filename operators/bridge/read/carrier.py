"""Mesh objects that carry the parts of something that cannot carry them itself.

This is a curve, text, surface or metaball, or a mesh whose modifiers make other faces.
A carrier is made when its source is read, so that a curve is converted once. It is in
no collection until it gets its parts; Blender never saves it like that.
"""

from __future__ import annotations

import bpy
from mathutils import Matrix

from ..homes import home_of, homes_of, objects_in, takes_more, view_layers
from ..parts.erase import erase_parts
from ..parts.materials import discard
from ..refusals import CONVERTIBLE
from ..stored.long_names import carrier_name
from ..stored.names import CARRIER_TAG, HIDDEN_IN_TAG, HIDDEN_TAG, HULL_TAG
from .converting import converted
from .evaluated import SeenMesh
from .place import leads_children
from .shown_mesh import evaluated_copy


def carrier_for(obj: bpy.types.Object, seen: SeenMesh | None) -> bpy.types.Object:
    """Return the object to be read: a mesh itself, or a new carrier.

    The carrier has the mesh as it is `seen`, if that is read.

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
    carrier[HIDDEN_IN_TAG] = [bpy.context.scene.name, bpy.context.view_layer.name]
    carrier.parent = obj
    # Blender computes no matrices of objects that are in no collection.
    carrier.matrix_world = obj.matrix_world
    erase_parts(carrier)  # they came with the mesh that is seen
    return carrier


def _needs_carrier(obj: bpy.types.Object, seen: SeenMesh | None) -> bool:
    return obj.type in CONVERTIBLE or (seen is not None and not seen.corresponds)


def placed_carrier(obj: bpy.types.Object, seen: SeenMesh | None) -> bpy.types.Object:
    """Return the object to be written to: a mesh itself, or its carrier.

    The carrier is placed beside its source, instead of an earlier one, and is selected
    in place of it; the source is hidden. The carrier is made again if undo has removed
    it meanwhile.
    """
    if not _needs_carrier(obj, seen):
        return obj
    waiting = [child for child in obj.children if is_waiting(child)]
    carrier = waiting[0] if waiting else carrier_for(obj, seen)
    _remove(obj, [each for each in _carriers_of(obj) if each != carrier])
    carrier.name = carrier.data.name = carrier_name(obj.name)
    carrier.data[CARRIER_TAG] = carrier.data.name
    carrier.matrix_basis = Matrix()
    for collection in {home_of(obj), *filter(takes_more, homes_of(obj))}:
        collection.objects.link(carrier)
    _take_place(carrier)
    return carrier


def replaced_carriers(
    obj: bpy.types.Object, seen: SeenMesh | None
) -> list[bpy.types.Object]:
    """Return the carriers that `placed_carrier` removes; their hulls have to go before.

    Carriers that become the user's are not among them.
    """
    if not _needs_carrier(obj, seen):
        return []
    earlier = [child for child in _carriers_of(obj) if not is_waiting(child)]
    return list(filter(_is_ours_alone, earlier))


def _carriers_of(source: bpy.types.Object) -> list[bpy.types.Object]:
    """Return the carriers of a source, with copies of them."""
    return [child for child in source.children if CARRIER_TAG in child]


def _is_ours_alone(carrier: bpy.types.Object) -> bool:
    """Return whether a carrier is no copy, still a mesh, and holds only hulls."""
    only_hulls = all(HULL_TAG in child for child in carrier.children_recursive)
    return only_hulls and carrier.type == "MESH" and not is_copy(carrier)


def _take_place(carrier: bpy.types.Object) -> None:
    """Hide the source of a carrier, note how that was shown, and select the carrier.

    The user may look at another view layer since the computation began.
    """
    source, layer = carrier.parent, _layer_of(carrier)
    layer.update()  # else it has no new object in Blender 4.2
    there = objects_in(layer)
    if carrier in there and leads_children(source):
        _leave_path(carrier)
        layer.update()
    was_shown = source in there and not source.hide_get(view_layer=layer)
    carrier[HIDDEN_TAG] = [was_shown, not source.hide_render]
    if source in there:
        source.select_set(False, view_layer=layer)
        source.hide_set(True, view_layer=layer)
    if carrier in there:
        carrier.select_set(True, view_layer=layer)
        if layer.objects.active in {source, None}:  # none if it was an earlier carrier
            layer.objects.active = carrier
    source.hide_render = True


def _leave_path(carrier: bpy.types.Object) -> None:
    """Put a carrier where its source is, a curve that would lead it along its path."""
    along_path = carrier.matrix_world.inverted_safe()
    carrier.matrix_parent_inverse = along_path @ carrier.parent.matrix_world


def _show_source(carrier: bpy.types.Object) -> None:
    """Show the source of a carrier as it was before."""
    source, was_shown = carrier.parent, carrier.get(HIDDEN_TAG)
    if source is None or was_shown is None:
        return
    in_view, in_render = was_shown
    if in_view and source in objects_in(layer := _layer_of(carrier)):
        source.hide_set(False, view_layer=layer)
    if in_render:
        source.hide_render = False


def _layer_of(carrier: bpy.types.Object) -> bpy.types.ViewLayer:
    """Return the view layer in which the source of a carrier was read, and hidden.

    It is the present one if that is not known: the user may rename it.
    """
    scene, name = carrier[HIDDEN_IN_TAG]
    layers = bpy.data.scenes[scene].view_layers if scene in bpy.data.scenes else {}
    return layers.get(name) or bpy.context.view_layer


def _remove(source: bpy.types.Object, carriers: list[bpy.types.Object]) -> None:
    """Remove carriers of a source, and show it.

    Those that are not ours alone are the user's from now on, and so are all copies.
    """
    copies = filter(is_copy, _carriers_of(source))
    ours = list(filter(_is_ours_alone, carriers))
    others = [each for each in {*carriers, *copies} if each not in ours]
    for carrier in carriers:
        _show_source(carrier)
    discard(ours)
    for each in others:
        _leave_to_user(each)


def is_copy(carrier: bpy.types.Object) -> bool:
    """Return whether the user copied an object to have this one.

    The mesh notes its own name, which a copy of it cannot have. Copies that share the
    mesh have another name. A carrier that the user renamed still has its mesh alone.
    """
    if is_waiting(carrier):
        return False
    mesh = carrier.data
    # Data that the user gave a carrier have no note.
    noted = mesh.get(CARRIER_TAG, carrier_name(carrier[CARRIER_TAG]))
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
    present = bpy.context.view_layer
    active_in = [layer for layer in view_layers() if carrier == layer.objects.active]
    _remove(source, [carrier])
    for layer in {present, *active_in}:
        if source in objects_in(layer):
            source.select_set(True, view_layer=layer)
            if layer in active_in:
                layer.objects.active = source


def discard_waiting() -> None:
    """Remove the carriers that got no parts."""
    for obj in [obj for obj in bpy.data.objects if is_waiting(obj)]:
        discard([obj])


def is_waiting(obj: bpy.types.Object) -> bool:
    """Return whether an object is a carrier without parts so far."""
    return CARRIER_TAG in obj and obj.users == 0
