"""Show parts to other tools: as face sets and as a color attribute."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import Float32Array, Int32Array
from ..mesh.attributes import write_attribute
from ..mesh.layers import EditModeLayers, ObjectModeLayers, layers_of
from ..mesh.points import count_points, is_cloud
from ..parts.palette import UNPAINTED
from ..parts.read import find_parts_on, parts_on
from ..stored.identity import Identity
from ..stored.names import COLOR_LAYER, FACE_SET_LAYER, FACE_SETS, PART_LAYER


def write_face_sets(obj: bpy.types.Object) -> None:
    """Make a face set of each part; Clear restores the former face sets."""
    layers, ours = layers_of(obj), parts_on(obj).face_sets
    if layers.faces(FACE_SET_LAYER) is None:
        before = layers.faces(FACE_SETS)
        layers.set_faces(
            FACE_SET_LAYER, np.zeros_like(ours) if before is None else before
        )
    layers.set_faces(FACE_SETS, ours)
    layers.finish()


def users_face_sets(
    obj: bpy.types.Object, layers: ObjectModeLayers | EditModeLayers
) -> Int32Array | None:
    """Return the face sets that Clear leaves, (P,), None for none.

    They are those from before ours, unless the user drew over ours.
    """
    before, now = layers.faces(FACE_SET_LAYER), layers.faces(FACE_SETS)
    if before is None or now is None:  # to find the parts of large meshes takes long
        return now
    found = find_parts_on(obj)
    is_ours = found is not None and np.array_equal(now, found.face_sets)
    return before if is_ours else now


def write_colors(obj: bpy.types.Object) -> None:
    """Give the corners of faces the colors of their parts."""
    layers, found = layers_of(obj), parts_on(obj)
    layers.set_colors(COLOR_LAYER, _colors(found.identities)[found.labels])
    layers.finish()


def paint_points(
    obj: bpy.types.Object, labels: NDArray[np.integer], identities: Sequence[Identity]
) -> None:
    """Give the points of a cloud the colors of their parts."""
    colors = _colors(identities)[labels]
    write_attribute(obj.data, COLOR_LAYER, "FLOAT_COLOR", "POINT", colors)


def show_colors(obj: bpy.types.Object) -> None:
    """Bring the colors of points, and of corners if they have them, up to date."""
    if is_cloud(obj):
        found = parts_on(obj)
        paint_points(obj, found.labels, found.identities)
    elif shown(obj)[1]:
        write_colors(obj)


def point_colors(obj: bpy.types.Object) -> Float32Array:
    """Return the linear RGBA color of each point of a cloud, (N, 4).

    They are gray if the cloud has no parts.
    """
    found = find_parts_on(obj)
    if found is None:
        return np.tile(np.array(UNPAINTED, np.float32), (count_points(obj), 1))
    return _colors(found.identities)[found.labels]


def shown(obj: bpy.types.Object) -> tuple[bool, bool]:
    """Return whether parts are shown as face sets, and whether as colors."""
    if is_cloud(obj):
        return False, False
    there = obj.data.attributes
    parts = there.get(PART_LAYER)
    of_points = parts is None or parts.domain == "POINT"  # they have got faces since
    return FACE_SET_LAYER in there, COLOR_LAYER in there and not of_points


def show(obj: bpy.types.Object, face_sets: bool, colors: bool) -> None:
    """Show the parts as face sets, as colors, or both."""
    if face_sets:
        write_face_sets(obj)
    if colors:
        write_colors(obj)


def _colors(identities: Sequence[Identity]) -> Float32Array:
    """Return the linear RGBA color of each part, (K, 4)."""
    return np.array([(*each.color, 1.0) for each in identities], dtype=np.float32)
