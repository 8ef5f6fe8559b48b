"""How long the sides of what is read of an object are, told quickly: panels draw it."""

from __future__ import annotations

import bpy
import numpy as np

from ....core.steps.arrays import Float32Array, FloatArray
from ..mesh.attributes import vertex_positions
from ..stored.record import EVALUATED
from .evaluated import which_mesh
from .shown_mesh import differs
from .stretching import scaling, sheared_scale


def half_side_of(obj: bpy.types.Object, mesh: str) -> float | None:
    """Return half of the longest side of the mesh that is read, in the scene.

    The box that Blender knows is that of what is seen. So the vertices of the mesh
    itself are read where it differs: a million take 10 ms.

    Parameters
    ----------
    obj : bpy.types.Object
        Of any type.
    mesh : {'ORIGINAL', 'EVALUATED'}

    Returns
    -------
    float or None
        0 if nothing has a size. None if it is not known: nodes may make instances,
        which are read and are in no box, and views of ours are made of nodes. Nor
        does a box before shear tell the one after it.
    """
    sheared = sheared_scale(np.array(obj.matrix_world, dtype=np.float64)[:3, :3])
    if sheared is not None:
        if obj.type != "MESH" or which_mesh(mesh, obj) == EVALUATED:
            return None
        matrix = scaling(*sheared).astype(np.float32)
        return float(_sides_of(vertex_positions(obj.data) @ matrix).max()) / 2
    sides = _sides(obj, mesh)
    if sides is None:
        return None
    scale = np.abs(np.array(obj.matrix_world.to_scale(), dtype=np.float64))
    return float((sides * scale).max()) / 2


def _sides(obj: bpy.types.Object, mesh: str) -> FloatArray | None:
    """Return the lengths of the sides, (3,), in object space; None if not known."""
    has_nodes = obj.type == "MESH" and any(
        each.show_viewport and each.type == "NODES" for each in obj.modifiers
    )
    if which_mesh(mesh, obj) == EVALUATED:
        return None if has_nodes else np.ptp(np.array(obj.bound_box), axis=0)
    if has_nodes or differs(obj):
        return _sides_of(vertex_positions(obj.data))
    return np.ptp(np.array(obj.bound_box), axis=0)


def _sides_of(places: Float32Array) -> FloatArray:
    """Return the lengths of the sides of the box around vertices (V, 3)."""
    if not len(places):
        return np.zeros(3)
    # One axis after the other: NumPy takes eight times as long for all at once.
    return np.array([np.ptp(places[:, axis]) for axis in range(3)], dtype=np.float64)
