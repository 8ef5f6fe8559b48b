"""Move the 3D viewport to points."""

from __future__ import annotations

import math

import bpy
import numpy as np
from mathutils import Vector
from numpy.typing import NDArray

from ....core.geometry.frames import moved
from .known import corner_faces, corner_vertices
from .points import is_cloud, positions_of

# How much wider the view is than what it frames.
_MARGIN = 1.1


def points_of_parts(
    obj: bpy.types.Object, members: NDArray[np.bool_]
) -> NDArray[np.float64]:
    """Return the corners of some faces, or some points, in world space, (N, 3)."""
    places = positions_of(obj).astype(np.float64)
    if is_cloud(obj):
        places = places[members]
    else:
        vertices = corner_vertices(obj.data)
        places = places[vertices[members[corner_faces(obj.data)]]]
    return moved(places, np.array(obj.matrix_world))


def frame_points(space: bpy.types.SpaceView3D, points: NDArray[np.float64]) -> None:
    """Move a view so that it shows points, from the side it shows now."""
    if len(points) == 0:
        return
    region = space.region_3d
    low, high = points.min(axis=0), points.max(axis=0)
    radius = max(float(np.linalg.norm(high - low)) / 2, 10 * space.clip_start)
    if region.view_perspective == "CAMERA":
        region.view_perspective = "PERSP"
    region.view_location = Vector((low + high) / 2)
    # The sensor of a viewport is 72 mm wide, twice that of a camera.
    region.view_distance = _MARGIN * radius / math.sin(math.atan(36 / space.lens))
