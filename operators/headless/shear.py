"""Places of objects below parents, and shear, which their matrices may hold.

A rotated child of a parent whose scale differs by axis has it. The matrix between
parent and child may hold it. Objects without parents, and nodes of .glb and .fbx, have
location, rotation and scale alone.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix

from ...core.geometry.frames import moved
from ..bridge.mesh.attributes import read_floats, write_floats
from ..bridge.refusals import CONVERTIBLE, WORKED_ON

# Largest difference between a matrix and its location, rotation and scale, as a share.
_NO_SHEAR = 1e-5
# Parents, and ways to hang on them, that nodes of .glb and .fbx tell rightly. Nodes of
# cameras and lights are turned; .fbx has none of lattices, speakers and their like.
_TOLD_PARENTS = {"ARMATURE", "EMPTY", "MESH", *CONVERTIBLE}
_TOLD_TIES = {"OBJECT", "BONE"}


def has_shear(matrix: Matrix) -> bool:
    """Return whether a matrix is more than location, rotation and scale."""
    rows = zip(without_shear(matrix), matrix, strict=True)
    shear = max((a.to_3d() - b.to_3d()).length for a, b in rows)
    return shear > _NO_SHEAR * max(map(abs, matrix.to_scale()))


def without_shear(matrix: Matrix) -> Matrix:
    """Return the location, rotation and scale of a matrix, as Blender tells them."""
    return Matrix.LocRotScale(*matrix.decompose())


def put_below(obj: bpy.types.Object, parent: bpy.types.Object, matrix: Matrix) -> None:
    """Make an object a child of another one, where a matrix says in world space."""
    obj.parent = parent
    obj.matrix_parent_inverse = parent.matrix_world.inverted_safe()
    obj.matrix_basis = matrix
    if has_shear(matrix):
        obj.matrix_basis = Matrix()
        obj.matrix_parent_inverse @= matrix


@contextmanager
def shear_in_meshes(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Let meshes and point clouds hold the shear of objects; take it back at the end.

    Objects with the location, rotation and scale alone of these then look as before.
    """
    shapes = [obj for obj in objects if obj.type in WORKED_ON]
    former = {obj: obj.data for obj in shapes if has_shear(obj.matrix_world)}
    for obj, data in former.items():
        matrix = obj.matrix_world
        obj.data = data.copy()
        _move(obj.data, without_shear(matrix).inverted_safe() @ matrix)
    try:
        yield
    finally:
        for obj, data in former.items():
            sheared, obj.data = obj.data, data
            bpy.data.batch_remove([sheared])


def _move(data: bpy.types.ID, matrix: Matrix) -> None:
    """Move the vertices of a mesh, or the points of a point cloud, by a matrix."""
    if isinstance(data, bpy.types.Mesh):
        data.transform(matrix, shape_keys=True)
        return
    places = read_floats(data.points, "co", 3)
    write_floats(data.points, "co", moved(places, np.array(matrix)))


@contextmanager
def without_parents(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Take objects off their parents, in the same place; put them back at the end.

    Nothing moves them meanwhile: no action, no driver and no constraint.
    """
    before = [(each, _hanging(each)) for each in objects]
    moving = [each for obj in objects for each in _movers(obj) if not each.mute]
    animated = [
        (data, data.action, getattr(data, "action_slot", None))
        for obj in objects
        if (data := obj.animation_data) and data.action
    ]
    try:
        for obj in objects:
            place = obj.matrix_world.copy()
            obj.parent = None
            obj.matrix_world = place
        _mute(moving, True)
        for data, _, _ in animated:
            data.action = None
        bpy.context.view_layer.update()
        yield
    finally:
        for data, action, slot in animated:
            data.action = action
            if slot:  # since Blender 4.4
                data.action_slot = slot
        _mute(moving, False)
        for obj, values in before:
            for name, value in values.items():
                setattr(obj, name, value)
        bpy.context.view_layer.update()


def _movers(obj: bpy.types.Object) -> list[Any]:
    """Return what can move an object and be muted."""
    data = obj.animation_data
    animations = (*data.drivers, *data.nla_tracks) if data else ()
    return [*obj.constraints, *animations]


def _mute(movers: Sequence[Any], muted: bool) -> None:
    """Mute constraints, drivers and tracks, or let them act again."""
    for each in movers:
        each.mute = muted


def _hanging(obj: bpy.types.Object) -> dict[str, Any]:
    """Return how an object hangs on its parent: values to set in their order."""
    return {
        "parent": obj.parent,
        "parent_type": obj.parent_type,
        "parent_bone": obj.parent_bone,
        "parent_vertices": tuple(obj.parent_vertices),
        "matrix_parent_inverse": obj.matrix_parent_inverse.copy(),
        "matrix_basis": obj.matrix_basis.copy(),
    }


@contextmanager
def in_their_places(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Take off their parents the objects that nodes would put elsewhere, or nowhere.

    The exporter of .glb leaves out what hangs on others than `objects`, and writes
    others that hang on them.
    """
    among = set(objects)
    loose = [obj for obj in objects if _is_elsewhere(obj, among)]
    others = [o for o in bpy.data.objects if o.parent in among and o not in among]
    with shear_in_meshes(loose), without_parents([*loose, *others]):
        yield


def _is_elsewhere(obj: bpy.types.Object, among: set[bpy.types.Object]) -> bool:
    """Return whether a node below that of the parent would not be where `obj` is."""
    if obj.parent is None:
        return False
    above = obj.parent.matrix_world
    pose = obj.parent.pose
    if obj.parent_type == "BONE" and pose and obj.parent_bone in pose.bones:
        above = above @ pose.bones[obj.parent_bone].matrix
    if (
        obj.parent not in among
        or obj.parent.type not in _TOLD_PARENTS
        or obj.parent_type not in _TOLD_TIES
        or has_shear(above.inverted_safe() @ obj.matrix_world)
    ):
        return True
    # The node of a parent that comes off has no shear, either.
    return has_shear(above) and _is_elsewhere(obj.parent, among)
