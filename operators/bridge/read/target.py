"""Find an object again, as when the computation on it is done."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ....core.errors import DecompositionError
from ..mesh.layers import flush_edits
from ..mesh.points import count_points, is_cloud
from ..refusals import CONVERTIBLE, WORKED_ON
from .converting import digest_of_shown


def object_with(uid: int, name: str = "") -> bpy.types.Object | None:
    """Return the object with a `session_uid`, None if it is gone.

    Files have thousands of objects, so it is looked up first by the name that it has
    probably.
    """
    obj = bpy.data.objects.get(name)
    if obj is not None and obj.session_uid == uid:
        return obj
    return next((each for each in bpy.data.objects if each.session_uid == uid), None)


@dataclass(frozen=True)
class Target:
    """What tells whether an object is still the one that was read.

    The object itself is not kept: undo and deletion leave such references dangling.

    Attributes
    ----------
    object_uid, data_uid : int
        The `session_uid` of the object and of its data.
    state : tuple of int, or str
        Numbers of vertices and faces, or the fingerprint of a curve.
    """

    object_uid: int
    data_uid: int
    state: tuple[int, int] | str

    @classmethod
    def of(cls, obj: bpy.types.Object) -> Target:
        """Return the target that an object is now."""
        return cls(obj.session_uid, obj.data.session_uid, _state(obj))

    def find(self) -> bpy.types.Object:
        """Return the object, or raise if it is gone or has changed."""
        obj = object_with(self.object_uid)
        known = obj is not None and obj.type in WORKED_ON | CONVERTIBLE
        if obj is None or not known or Target.of(obj) != self:
            raise DecompositionError(
                "The mesh was changed or deleted meanwhile; start again."
            )
        return obj


def _state(obj: bpy.types.Object) -> tuple[int, int] | str:
    """Return what shows that the faces or points of an object are other ones."""
    flush_edits(obj)
    if obj.type in CONVERTIBLE:
        return digest_of_shown(obj)
    if is_cloud(obj):
        return count_points(obj), 0
    return len(obj.data.vertices), len(obj.data.polygons)
