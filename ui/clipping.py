"""Keep drawings over a viewport within its Clipping Region (Alt B)."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import bpy
import gpu
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from ..core.geometry.cutting.segments import segments_below
from ..core.steps.arrays import FloatArray
from ..operators.viewport.viewports import clip_planes

# Blender's shader takes so many planes.
_PLANES = 6


def planes_in(matrix: Matrix) -> FloatArray:
    """Return the planes around the viewport's region, (N, 4); none without a region.

    They are in the space that a matrix brings to the world. What is behind one of them,
    at (x, y, z, 1) times it below 0, is left out.
    """
    view = bpy.context.region_data
    planes = clip_planes(bpy.context.space_data, view)
    return np.array([matrix.transposed() @ each for each in planes]).reshape(-1, 4)


def clipped_shader() -> Any:
    """Return Blender's shader of one color; `draw_clipped` has it keep to a region."""
    return gpu.shader.from_builtin("UNIFORM_COLOR", config="CLIPPED")


def draw_clipped(batch: Any, shader: Any, matrix: Matrix) -> None:
    """Draw within the region what is in the space that a matrix brings to the world."""
    planes = planes_in(matrix)
    rows = np.zeros((4 + _PLANES, 4), dtype=np.float32)
    rows[:4] = np.eye(4)  # the shader's own way to the world
    rows[4 : 4 + len(planes)] = planes
    shader.uniform_block("clipPlanes", _buffer(rows.tobytes()))
    gpu.state.clip_distances_set(len(planes))
    batch.draw(shader)
    gpu.state.clip_distances_set(0)


@lru_cache(maxsize=16)  # Blender reads it when it draws
def _buffer(data: bytes) -> Any:
    """Return bytes where the shader reads them."""
    return gpu.types.GPUUniformBuf(data)


def forget() -> None:
    """Forget what was made for the shader."""
    _buffer.cache_clear()


def lines_within(
    ends: NDArray[np.floating], planes: FloatArray
) -> NDArray[np.floating]:
    """Return the ends of what is in front of all planes of lines, (2 N, 3) both.

    For shaders of Blender's that know no planes.
    """
    lines = segments_below(-planes, ends.reshape(-1, 2, 3).astype(np.float64))
    lines = lines[(lines[:, 0] != lines[:, 1]).any(axis=1)]
    return lines.reshape(-1, 3).astype(ends.dtype)
