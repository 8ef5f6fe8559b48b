"""Objects that have parts: which part each face is of, and what parts are called."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ..mesh.layers import layers_of
from ..mesh.points import is_cloud
from ..read.target import refusal
from ..stored.identity import Identity, usual_identities
from ..stored.record import identities_of, record_of
from ..stored.restore import has_parts, read_restore
from .erase import PART_LAYER


def decomposed_refusal(obj: bpy.types.Object | None) -> str | None:
    """Return why the parts of an object cannot be used, None if they can."""
    reason = refusal(obj)
    if reason is None and not has_parts(obj):
        return f"{obj.name} has no parts; press Decompose first"
    return reason


def parts_refusal(obj: bpy.types.Object | None) -> str | None:
    """Return why the parts of an object's faces cannot be used, None if they can."""
    reason = decomposed_refusal(obj)
    if reason is None and is_cloud(obj):
        return f"{obj.name} has no faces; give it a surface first"
    return reason


def object_mode_refusal(obj: bpy.types.Object | None) -> str | None:
    """Return the same for what undo in Edit Mode could not bring back."""
    reason = parts_refusal(obj)
    if reason is None and obj.mode != "OBJECT":
        return "Edit Mode could not undo this; switch to Object Mode"
    return reason


def part_labels(obj: bpy.types.Object) -> NDArray[np.int64] | None:
    """Return the part of each face, None if the object has no parts of ours."""
    labels = layers_of(obj).faces(PART_LAYER)
    if labels is None or read_restore(obj.data) is None:
        return None
    if len(labels) != len(obj.data.polygons):  # the points had no faces then
        return None
    # Faces added since carry whatever Blender gave them.
    return np.maximum(labels, 0).astype(np.int64)


def part_identities(obj: bpy.types.Object, n_parts: int) -> tuple[Identity, ...]:
    """Return who the parts of an object are, the first ones as noted."""
    noted = identities_of(record_of(obj))
    return (noted + usual_identities(n_parts)[len(noted) :])[:n_parts]
