"""Find an object again, as when the computation on it is done."""

from __future__ import annotations

from dataclasses import dataclass, field

import bpy
import numpy as np

from ....core.errors import DecompositionError
from ....core.steps.arrays import Float32Array, FloatArray
from ..mesh.layers import flush_edits
from ..mesh.points import count_points, is_cloud, positions_of
from ..refusals import CONVERTIBLE, WORKED_ON
from .converting import digest_of_shown
from .shape import scene_unit, stretch

# A scale that differs by less, as a share, differs by rounding, as after a turn.
_SAME_SCALE = 1e-4


def object_with(uid: int, name: str = "") -> bpy.types.Object | None:
    """Return the object with a `session_uid`, None if it is gone.

    Files have thousands of objects, so it is looked up first by the name that it has
    probably.
    """
    obj = bpy.data.objects.get(name)
    if obj is not None and obj.session_uid == uid:
        return obj
    return next((each for each in bpy.data.objects if each.session_uid == uid), None)


@dataclass(frozen=True, eq=False)
class ShapeThen:
    """The shape that an object had in the scene, wherever it was.

    It is told by the mesh, which has what was done in Edit Mode once there is a target.

    Attributes
    ----------
    places : (V, 3) float32
        Its vertices, or points, in its own space.
    scale : (3, 3) float
        From its own space to the proportions and the size that it had.
    """

    places: Float32Array
    scale: FloatArray

    @classmethod
    def of(cls, obj: bpy.types.Object) -> ShapeThen:
        """Return the shape that an object has now; raise if it has no proper place."""
        return cls(positions_of(obj), stretch(obj) * scene_unit(obj))

    def is_of(self, obj: bpy.types.Object) -> bool:
        """Return whether an object has the same shape still."""
        scale, most = stretch(obj) * scene_unit(obj), np.abs(self.scale).max()
        if np.abs(scale - self.scale).max() > _SAME_SCALE * most:
            return False
        return np.array_equal(positions_of(obj), self.places)


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
    shape : ShapeThen or None
        Its shape, if the object must still have it.
    """

    object_uid: int
    data_uid: int
    state: tuple[int, int] | str
    shape: ShapeThen | None = field(default=None, compare=False)

    @classmethod
    def of(cls, obj: bpy.types.Object, with_shape: bool = False) -> Target:
        """Return the target that an object is now."""
        state = _state(obj)
        shape = ShapeThen.of(obj) if with_shape else None
        return cls(obj.session_uid, obj.data.session_uid, state, shape)

    def find(self) -> bpy.types.Object:
        """Return the object, or raise if it is gone or has changed."""
        obj = object_with(self.object_uid)
        known = obj is not None and obj.type in WORKED_ON | CONVERTIBLE
        if obj is None or not known or Target.of(obj) != self:
            raise DecompositionError(
                "The mesh was changed or deleted meanwhile; start again."
            )
        if self.shape is not None and not self.shape.is_of(obj):
            raise DecompositionError(
                "The shape or scale was changed meanwhile; start again."
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
