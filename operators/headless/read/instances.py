"""Instances become objects: of collections, vertices, faces, particles and nodes.

Only what Blender shows becomes an object: instances of instances, but not the empties
between them. Linked data becomes local first; the library itself is only read.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy

from ....core.errors import DecompositionError
from ...bridge.homes import view_layers
from ...bridge.hulls.listed import is_hull
from .evaluated import EvaluatedMeshes, everything_shown, give_mesh
from .instance_objects import Instance, add_objects

# Modifiers that make instances.
_INSTANCING = {"NODES", "PARTICLE_SYSTEM"}


def check_libraries(path: Path) -> None:
    """Check that all linked objects are there.

    Raises
    ------
    DecompositionError
        If a library is missing, or does not have them any more.
    """
    owners = (bpy.data.objects, bpy.data.meshes, bpy.data.collections)
    lost = sorted(
        Path(each.library.filepath).name
        for each in (each for owner in owners for each in owner)
        if each.library and each.is_missing
    )
    if lost:
        raise DecompositionError(
            f"{path} links objects of {lost[0]} that cannot be found; put that"
            " file back in its place, or relocate it in Blender."
        )


def make_all_local() -> None:
    """Make everything local that is linked from libraries."""
    if bpy.data.libraries:
        bpy.ops.object.make_local(type="ALL")


def realize_instances(with_modifiers: bool) -> dict[str, str]:
    """Make an object of each instance, and stop the instancing.

    Parameters
    ----------
    with_modifiers : bool
        Apply the modifiers of what is instanced. Those that may make instances in
        their turn are always applied.

    Returns
    -------
    dict of str
        What was applied to instancers, by their names.
    """
    found: list[Instance] = []
    instancers: dict[bpy.types.Object, _Own] = {}
    made = EvaluatedMeshes()
    with everything_shown() as layers:
        for layer in layers:
            depsgraph = layer.depsgraph
            new = [
                each
                for each in _instances(depsgraph, made, with_modifiers)
                if each.instancer not in instancers
            ]
            instancers |= _own_of({each.instancer for each in new}, depsgraph, made)
            found += new
    # Nothing shows of those with a scale of zero.
    add_objects([each for each in found if each.matrix.determinant()])
    notes = {}
    for instancer, own in instancers.items():
        if own.mesh:
            notes[instancer.name_full] = give_mesh(instancer, own.mesh)
        _stop(instancer)
    _update_places()  # of the new objects, and of children of what is left out
    left_out = [obj for obj, own in instancers.items() if _shows_nothing(obj, own)]
    if left_out:
        _leave_out(left_out)
        _update_places()
    return notes


def _update_places() -> None:
    """Compute where all objects are."""
    for layer in view_layers():
        layer.update()


@dataclass(frozen=True)
class _Own:
    """What an instancer shows beside its instances.

    Attributes
    ----------
    is_shown : bool
        Whether it shows itself at all.
    mesh : Mesh or None
        Its mesh, if that is what nodes made of it.
    """

    is_shown: bool
    mesh: bpy.types.Mesh | None


def _own_of(
    instancers: set[bpy.types.Object],
    depsgraph: bpy.types.Depsgraph,
    made: EvaluatedMeshes,
) -> dict[bpy.types.Object, _Own]:
    """Return what each instancer shows beside its instances in a view layer."""
    shown = {
        each.object.original
        for each in depsgraph.object_instances
        if not each.is_instance
    }
    return {
        obj: _Own(
            obj in shown,
            made.of(obj.evaluated_get(depsgraph), depsgraph)
            if obj.type == "MESH" and "NODES" in _kinds(obj)
            else None,
        )
        for obj in sorted(instancers, key=lambda obj: obj.name)
    }


def _instances(
    depsgraph: bpy.types.Depsgraph, made: EvaluatedMeshes, with_modifiers: bool
) -> list[Instance]:
    """Return the instances that a view layer shows."""
    found = []
    meshes: dict[int, bpy.types.Mesh] = {}
    for each in depsgraph.object_instances:
        obj = each.object
        source = obj.original
        if not each.is_instance or obj.type == "EMPTY" or is_hull(source):
            continue
        is_copy = obj.data in (None, source.evaluated_get(depsgraph).data)
        mesh = None
        applied = _kinds(source) if with_modifiers else _kinds(source) & _INSTANCING
        if not is_copy or (obj.type == "MESH" and applied):
            if obj.type != "MESH" or _is_surface(obj, source) or not obj.data.polygons:
                continue
            key = obj.data.as_pointer()
            if key not in meshes:
                meshes[key] = made.of(obj)
            mesh = meshes[key]
        found.append(
            Instance(
                each.parent.original,
                source,
                tuple(each.persistent_id),
                mesh,
                is_copy,
                each.matrix_world.copy(),
            )
        )
    return found


def _is_surface(shown: bpy.types.Object, source: bpy.types.Object) -> bool:
    """Return whether an instance is the surface of a curve, text or metaball itself."""
    if source.type == "META":
        return True
    return source.type != "MESH" and shown.data.name == source.data.name


def _kinds(obj: bpy.types.Object) -> set[str]:
    """Return the kinds of modifiers that have an effect in the viewport."""
    return {modifier.type for modifier in obj.modifiers if modifier.show_viewport}


def _stop(instancer: bpy.types.Object) -> None:
    """Let an object make no more instances."""
    instancer.instance_type = "NONE"
    instancer.instance_collection = None
    kind = "PARTICLE_SYSTEM" if instancer.type == "MESH" else "NODES"
    for modifier in [each for each in instancer.modifiers if each.type == kind]:
        instancer.modifiers.remove(modifier)


def _shows_nothing(instancer: bpy.types.Object, own: _Own) -> bool:
    """Return whether instances were all that an object showed.

    Points are where instances go, and not a point cloud.
    """
    only_points = instancer.type == "MESH" and not instancer.data.polygons
    return only_points or instancer.type == "POINTCLOUD" or not own.is_shown


def _leave_out(instancers: Sequence[bpy.types.Object]) -> None:
    """Unlink objects; their children stay where they are, below an empty each.

    Without a parent, children with shear could not keep it.
    """
    parents = {each.parent for each in bpy.data.objects}
    empties = {}
    for obj in [each for each in instancers if each in parents]:
        empties[obj] = bpy.data.objects.new(obj.name, None)
        empties[obj].matrix_basis = obj.matrix_world
    for child in [each for each in bpy.data.objects if each.parent in empties]:
        empty, basis = empties[child.parent], child.matrix_basis.inverted_safe()
        inverse = empty.matrix_basis.inverted_safe() @ child.matrix_world @ basis
        child.parent, child.parent_type = empty, "OBJECT"
        child.matrix_parent_inverse = inverse
    for obj in instancers:
        for collection in obj.users_collection:
            collection.objects.unlink(obj)
            if obj in empties:
                collection.objects.link(empties[obj])
