"""Meshes as Blender shows them: with modifiers, shape keys and Geometry Nodes."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

import bpy

from ...bridge.homes import layer_collections, objects_in, view_layers
from ...bridge.parts.erase import erase_parts
from ...bridge.parts.materials import discard_unused
from ...bridge.read.shown_mesh import new_mesh_of, shown_modifiers
from ...bridge.stored.restore import has_parts
from ...bridge.views.node_modifiers import remove_views


class EvaluatedMeshes:
    """Makes meshes of evaluated objects; equal ones are made once and shared."""

    def __init__(self) -> None:
        self._known: dict[tuple[str, int], list[bpy.types.Mesh]] = {}

    def of(
        self, evaluated: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None = None
    ) -> bpy.types.Mesh:
        """Return a mesh of the file that equals that of an evaluated object.

        For the parameters, see `new_mesh_of`.
        """
        mesh = new_mesh_of(evaluated, depsgraph)
        kind = (evaluated.data.name, len(mesh.polygons))
        alike = self._known.setdefault(kind, [])
        for known in alike:
            same = known.unit_test_compare(mesh=mesh) == "Same"
            if same and list(known.materials) == list(mesh.materials):
                bpy.data.meshes.remove(mesh)
                return known
        alike.append(mesh)
        return mesh


@contextmanager
def everything_shown() -> Iterator[list[bpy.types.ViewLayer]]:
    """Show all that is hidden, and give the view layers; hide it again at the end.

    Blender evaluates neither modifiers nor instances of what is hidden.
    """
    layers = view_layers()
    hidden = [
        owner
        for owners in (bpy.data.collections, bpy.data.objects)
        for owner in owners
        if owner.hide_viewport and owner.is_editable
    ]
    hidden += [
        collection
        for layer in layers
        for collection in layer_collections(layer)
        if collection.hide_viewport
    ]
    by_eye = [
        (obj, layer)
        for layer in layers
        for obj in layer.objects
        if obj.hide_get(view_layer=layer)
    ]
    for owner in hidden:
        owner.hide_viewport = False
    for obj, layer in by_eye:
        obj.hide_set(False, view_layer=layer)
    for layer in layers:
        layer.update()
    try:
        yield layers
    finally:
        for obj, layer in by_eye:
            obj.hide_set(True, view_layer=layer)
        for owner in hidden:
            owner.hide_viewport = True


def apply_modifiers(objects: Iterable[bpy.types.Object]) -> dict[str, str]:
    """Give meshes the shape that Blender shows; return what was applied, by object.

    Modifiers and shape keys are removed. Parts of ours are removed first, and exploded
    views, which are modifiers. Objects that shared a mesh still do if they look alike.
    """
    chosen = []
    for obj in objects:
        remove_views(obj)
        keys = getattr(obj.data, "shape_keys", None)
        if obj.type == "MESH" and (keys or shown_modifiers(obj)):
            if has_parts(obj):
                discard_unused(erase_parts(obj))
            chosen.append(obj)
    made, meshes = EvaluatedMeshes(), {}
    with everything_shown() as layers:
        for layer in layers:
            there = objects_in(layer)
            for obj in chosen:
                if obj in there and obj not in meshes:
                    evaluated = obj.evaluated_get(layer.depsgraph)
                    meshes[obj] = made.of(evaluated, layer.depsgraph)
    return {obj.name_full: give_mesh(obj, mesh) for obj, mesh in meshes.items()}


def give_mesh(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> str:
    """Give an object its evaluated mesh and remove its modifiers; return a note."""
    former, has_modifiers = obj.data, bool(shown_modifiers(obj))
    applied = ["modifiers"] if has_modifiers else []
    applied += ["shape keys"] if former.shape_keys else []
    n_before, n_after = len(former.polygons), len(mesh.polygons)
    obj.modifiers.clear()
    obj.data = mesh
    if former.users == 0:
        name = former.name
        bpy.data.meshes.remove(former)
        mesh.name = name
    outcome = f"{n_before:,} faces became {n_after:,}; the parts are on the new ones"
    if n_after == n_before:
        outcome = f"the parts are on the {n_after:,} faces as they are shown"
    if n_after == 0:
        outcome = f"{n_before:,} faces became none"
    return f"Its {' and '.join(applied)} were applied: {outcome}."
