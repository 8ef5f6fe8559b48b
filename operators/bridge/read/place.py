"""Where an object is by now, also before Blender has updated the scene."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix

# A place that differs by less, as a share, differs by rounding.
_ROUNDING = 1e-5


def place_now(obj: bpy.types.Object) -> Matrix:
    """Return the place of an object, (4, 4), as its properties and parents tell it now.

    Blender brings `matrix_world` up to date with its next update, in scenes that are
    shown, and never for objects that no scene has. A script may not have waited for
    that. To update here instead would call all handlers, again and again if one of
    them asks for a place, and is forbidden in drivers.

    Where constraints, bones, vertices or paths place an object, only Blender can tell:
    its last update counts.
    """
    place, above = Matrix(), obj
    while not _placed_by_blender(above):
        place = above.matrix_basis @ place
        if above.parent is None:
            return _known_or(place, obj)
        place, above = above.matrix_parent_inverse @ place, above.parent
    return _known_or(above.matrix_world @ place, obj)


def _placed_by_blender(obj: bpy.types.Object) -> bool:
    """Return whether more than an object's properties and its parent's place counts."""
    if any(not each.mute for each in obj.constraints):
        return True
    if obj.parent is None:
        return False
    on_parent = obj.parent_type in {"BONE", "VERTEX", "VERTEX_3"}
    return on_parent or leads_children(obj.parent)


def leads_children(obj: bpy.types.Object) -> bool:
    """Return whether an object is a curve that its children follow as their path."""
    return bool(obj.type == "CURVE" and obj.data.use_path)


def _known_or(place: Matrix, obj: bpy.types.Object) -> Matrix:
    """Return the place that Blender knows, to the last digit, unless it is another."""
    known = np.array(obj.matrix_world, dtype=np.float64)
    with np.errstate(invalid="ignore"):  # infinite minus infinite
        far = np.linalg.norm(np.array(place, dtype=np.float64) - known, axis=0)
    near = far <= _ROUNDING * np.linalg.norm(known, axis=0)
    return obj.matrix_world if near.all() else place
