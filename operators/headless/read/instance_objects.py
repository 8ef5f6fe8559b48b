"""Objects in place of instances: their names, and where they are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import bpy
from mathutils import Matrix

from ...bridge.homes import homes_of
from ...bridge.stored.record import forget_result
from ..shear import has_shear, put_below
from .numbering import unnumbered

# Bytes of a name: Blender 4.2 allows 63, and those of hulls get longer.
_LONGEST_NAME = 48


@dataclass(frozen=True)
class Instance:
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
        return f"{self.instancer.name} {unnumbered(shown)}"


def add_objects(found: Sequence[Instance]) -> None:
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
        homes = homes_of(each.instancer) or [bpy.context.scene.collection]
        for collection in homes:
            collection.objects.link(obj)


def _object(each: Instance, name: str) -> bpy.types.Object:
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
    if has_shear(matrix):
        put_below(obj, instancer, matrix)
    else:
        obj.matrix_basis = matrix
