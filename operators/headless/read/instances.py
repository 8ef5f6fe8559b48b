"""Instances become objects: of collections, vertices, faces, particles and nodes.

Only what Blender shows becomes an object: instances of instances, but not the empties
between them. Linked data becomes local first; the library itself is only read.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import bpy
from mathutils import Matrix

from ....core.errors import DecompositionError
from ...bridge.hulls.hull_objects import is_hull
from ...bridge.stored.record import forget_result
from .evaluated import EvaluatedMeshes, everything_shown, give_mesh
from .numbering import plain_name

# Modifiers that make instances.
_INSTANCING = {"NODES", "PARTICLE_SYSTEM"}
# Bytes of a name: Blender 4.2 allows 63, and those of hulls get longer.
_LONGEST_NAME = 48
# Largest difference between a matrix and its location, rotation and scale, as a share.
_NO_SHEAR = 1e-5


@dataclass(frozen=True)
class _Instance:
    """An instance that Blender shows.

    Attributes
    ----------
    instancer : Object
        The object of the scene that makes it.
    source : Object
        The object that it shows.
    place : tuple of int
        Its place among those of the instancer.
    mesh : Mesh or None
        Its mesh, if that is not the one of `source`.
    is_copy : bool
        Whether it shows `source` itself, and not something that nodes made.
    matrix : Matrix
        In world space.
    """

    instancer: bpy.types.Object
    source: bpy.types.Object
    place: tuple[int, ...]
    mesh: bpy.types.Mesh | None
    is_copy: bool
    matrix: Matrix

    @property
    def title(self) -> str:
        """Name of the object to be made, without a number."""
        shown = self.source if self.is_copy or self.mesh is None else self.mesh
        return f"{self.instancer.name} {plain_name(shown)}"


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
            f"{path.name} links objects of {lost[0]} that cannot be found; put that"
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
    found: list[_Instance] = []
    instancers: dict[bpy.types.Object, _Own] = {}
    made = EvaluatedMeshes()
    with everything_shown() as layers:
        for _, depsgraph in layers:
            new = [
                each
                for each in _instances(depsgraph, made, with_modifiers)
                if each.instancer not in instancers
            ]
            instancers |= _own_of({each.instancer for each in new}, depsgraph, made)
            found += new
    _add_objects(found)
    notes = {}
    for instancer, own in instancers.items():
        if own.mesh:
            notes[instancer.name_full] = give_mesh(instancer, own.mesh)
        _stop(instancer, own.is_shown)
    for scene in bpy.data.scenes:
        for layer in scene.view_layers:
            layer.update()  # computes where the new objects are
    return notes


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
) -> list[_Instance]:
    """Return the instances that a view layer shows."""
    found = []
    meshes: dict[int, bpy.types.Mesh] = {}
    for each in depsgraph.object_instances:
        obj = each.object
        source = obj.original
        if not each.is_instance or obj.type == "EMPTY" or is_hull(source):
            continue
        if not each.matrix_world.determinant():
            continue  # a scale of zero: nothing of it shows
        own = source.evaluated_get(depsgraph).data
        is_copy = obj.data is None or obj.data == own
        mesh = None
        applied = _kinds(source) if with_modifiers else _kinds(source) & _INSTANCING
        if not is_copy or (obj.type == "MESH" and applied):
            stands_for_curve = source.type != "MESH" and obj.data.name == own.name
            if obj.type != "MESH" or stands_for_curve or not obj.data.polygons:
                continue
            key = obj.data.as_pointer()
            if key not in meshes:
                meshes[key] = made.of(obj)
            mesh = meshes[key]
        found.append(
            _Instance(
                each.parent.original,
                source,
                tuple(each.persistent_id),
                mesh,
                is_copy,
                each.matrix_world.copy(),
            )
        )
    return found


def _kinds(obj: bpy.types.Object) -> set[str]:
    """Return the kinds of modifiers that have an effect in the viewport."""
    return {modifier.type for modifier in obj.modifiers if modifier.show_viewport}


def _add_objects(found: Sequence[_Instance]) -> None:
    """Add an object for each instance, beside its instancer."""
    found = sorted(found, key=lambda each: (each.title, each.place))
    totals, counts = Counter(each.title for each in found), Counter[str]()
    for each in found:
        total = totals[each.title]
        counts[each.title] += 1
        ending = f" {counts[each.title]:0{len(str(total))}d}" if total > 1 else ""
        title = each.title.encode()[: _LONGEST_NAME - len(ending)]
        name = title.decode(errors="ignore").rstrip() + ending
        obj = _object(each, name)
        homes = each.instancer.users_collection or [bpy.context.scene.collection]
        for collection in homes:
            collection.objects.link(obj)


def _object(each: _Instance, name: str) -> bpy.types.Object:
    """Return an object that is where an instance was."""
    if each.is_copy:
        obj = each.source.copy()
        obj.name = name
        obj.parent = None
        obj.constraints.clear()
        obj.animation_data_clear()
        forget_result(obj)  # it tells of the hulls of `source`
        obj.instance_type = "NONE"
        if each.mesh:
            obj.modifiers.clear()
            obj.data = each.mesh
    else:
        obj = bpy.data.objects.new(name, each.mesh)
    _move(obj, each.matrix, each.instancer)
    return obj


def _move(obj: bpy.types.Object, matrix: Matrix, instancer: bpy.types.Object) -> None:
    """Give an object without a parent its matrix in world space.

    Location, rotation and scale have no shear. An object with shear becomes a child of
    the instancer, because the matrix between parent and child may have it.
    """
    obj.delta_location = obj.delta_rotation_euler = (0.0, 0.0, 0.0)
    obj.delta_rotation_quaternion = (1.0, 0.0, 0.0, 0.0)
    obj.delta_scale = (1.0, 1.0, 1.0)
    obj.matrix_basis = matrix
    location, rotation, scale = matrix.decompose()
    rows = zip(Matrix.LocRotScale(location, rotation, scale), matrix, strict=True)
    shear = max((a.to_3d() - b.to_3d()).length for a, b in rows)
    if shear > _NO_SHEAR * max(map(abs, scale)):
        obj.matrix_basis = Matrix()
        obj.parent = instancer
        obj.matrix_parent_inverse = instancer.matrix_world.inverted_safe() @ matrix


def _stop(instancer: bpy.types.Object, is_shown: bool) -> None:
    """Let an object make no more instances; leave it out if they are all it shows.

    Points are where instances go, and not a point cloud.
    """
    instancer.instance_type = "NONE"
    instancer.instance_collection = None
    is_mesh = instancer.type == "MESH"
    _remove(instancer, {"PARTICLE_SYSTEM"} if is_mesh else {"NODES"})
    only_points = is_mesh and not instancer.data.polygons
    if only_points or instancer.type == "POINTCLOUD" or not is_shown:
        for collection in instancer.users_collection:
            collection.objects.unlink(instancer)


def _remove(obj: bpy.types.Object, kinds: Iterable[str]) -> None:
    """Remove the modifiers of some kinds from an object."""
    for modifier in [each for each in obj.modifiers if each.type in kinds]:
        obj.modifiers.remove(modifier)
