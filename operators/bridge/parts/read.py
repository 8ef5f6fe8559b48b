"""Read the parts of an object: the part of each face, and the names of parts."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ..mesh.layers import layers_of
from ..stored.identity import Identity, usual_identities
from ..stored.names import PART_LAYER
from ..stored.record import identities_of, record_of
from ..stored.restore import read_restore


def part_labels(obj: bpy.types.Object) -> NDArray[np.int64] | None:
    """Return the part of each face, None if the object has no parts of ours."""
    labels = layers_of(obj).faces(PART_LAYER)
    if labels is None or read_restore(obj.data) is None:
        return None
    if len(labels) != len(obj.data.polygons):  # it was a point cloud then
        return None
    # Blender gives any number to faces that the user adds.
    return np.maximum(labels, 0).astype(np.int64)


def part_identities(obj: bpy.types.Object, n_parts: int) -> tuple[Identity, ...]:
    """Return the identities of an object's parts: as noted, then the usual ones."""
    noted = identities_of(record_of(obj))
    return (noted + usual_identities(n_parts)[len(noted) :])[:n_parts]
