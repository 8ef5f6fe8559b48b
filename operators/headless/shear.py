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
from mathutils import Matrix

# Largest difference between a matrix and its location, rotation and scale, as a share.
_NO_SHEAR = 1e-5


def has_shear(matrix: Matrix) -> bool:
    """Return whether a matrix is more than location, rotation and scale."""
    rows = zip(_without_shear(matrix), matrix, strict=True)
    shear = max((a.to_3d() - b.to_3d()).length for a, b in rows)
    return shear > _NO_SHEAR * max(map(abs, matrix.to_scale()))


def _without_shear(matrix: Matrix) -> Matrix:
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
    """Let the meshes of objects hold their shear; take it back at the end.

    Objects with the location, rotation and scale alone of these then look as before.
    """
    former = {obj: obj.data for obj in objects if has_shear(obj.matrix_world)}
    for obj, mesh in former.items():
        matrix = obj.matrix_world
        obj.data = mesh.copy()
        obj.data.transform(_without_shear(matrix).inverted_safe() @ matrix)
    try:
        yield
    finally:
        for obj, mesh in former.items():
            sheared, obj.data = obj.data, mesh
            bpy.data.meshes.remove(sheared)


@contextmanager
def without_parents(objects: Sequence[bpy.types.Object]) -> Iterator[None]:
    """Take objects off their parents, in the same place; put them back at the end.

    The exporter of .glb leaves out what hangs on objects of other scenes, and puts what
    hangs on bones where their armature rests. Unreal takes no hulls with parents.
    """
    before = [(each, _hanging(each)) for each in objects]
    try:
        for obj in objects:
            place = obj.matrix_world.copy()
            obj.parent = None
            obj.matrix_world = place
        bpy.context.view_layer.update()
        yield
    finally:
        for obj, values in before:
            for name, value in values.items():
                setattr(obj, name, value)
        bpy.context.view_layer.update()


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
