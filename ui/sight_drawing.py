"""Draw lines of sight over the viewports."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader
from mathutils import Matrix

from ..core.geometry.frames import frames
from ..core.results.views import View
from ..core.steps.arrays import FloatArray
from ..operators.bridge.read.target import object_with
from ..operators.viewport import sight_overlay
from .clipping import clipped_shader, draw_clipped

_SEEN = (0.1, 0.85, 0.25, 1.0)
_HIDDEN = (0.1, 0.3, 1.0, 1.0)
_POINT = (1.0, 0.1, 0.1, 1.0)
_RAY = (0.3, 1.0, 0.45, 0.35)
_MOST_RAYS = 250
# Discs at samples: corners; radius, as a share of the distance of samples; height above
# the surface, as a share of the radius.
_CORNERS = 8
_RADIUS = 0.2
_HEIGHT = 0.2


def stop() -> None:
    """Forget what was made to be drawn."""
    _batches.cache_clear()


def draw() -> None:
    """Draw the overlay over a viewport, if there is one."""
    overlay = sight_overlay.current
    if overlay is None or overlay.view is None:
        return
    obj = object_with(overlay.object_uid)
    space = bpy.context.space_data
    if (
        obj is None
        or not space.overlay.show_overlays
        or not obj.visible_get(viewport=space)
    ):
        return
    shader = clipped_shader()
    gpu.state.blend_set("ALPHA")
    to_object = Matrix(np.linalg.inv(overlay.stretch).tolist()).to_4x4()
    to_world = obj.matrix_world @ to_object
    with gpu.matrix.push_pop():
        gpu.matrix.multiply_matrix(to_world)
        for batch, color, depth_test in _batches(overlay.view):
            gpu.state.depth_test_set(depth_test)
            shader.uniform_float("color", color)
            draw_clipped(batch, shader, to_world)
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("NONE")


# Viewports are drawn many times a second, mostly with the same view.
@lru_cache(maxsize=1)
def _batches(view: View) -> list[tuple[Any, tuple[float, ...], str]]:
    """Return what is drawn, with its color and depth test."""
    shader = clipped_shader()
    radius = _radius(view)
    discs = _discs(view.places, view.normals, radius)
    ends = view.places[view.visible]
    ends = ends[:: len(ends) // _MOST_RAYS + 1]
    rays = np.stack([np.broadcast_to(view.point, ends.shape), ends], axis=1)
    ball = _discs(np.tile(view.point, (3, 1)), np.eye(3), 1.5 * radius, lifted=False)
    kinds = (
        ("TRIS", discs[~view.visible], _HIDDEN, "LESS_EQUAL"),
        ("TRIS", discs[view.visible], _SEEN, "LESS_EQUAL"),
        ("LINES", rays, _RAY, "NONE"),
        ("TRIS", ball, _POINT, "NONE"),
    )
    return [
        (
            batch_for_shader(
                shader, kind, {"pos": corners.reshape(-1, 3).astype(np.float32)}
            ),
            color,
            depth_test,
        )
        for kind, corners, color, depth_test in kinds
        if len(corners)
    ]


def _radius(view: View) -> float:
    """Return the radius of discs, from the mean distance of samples."""
    extent = np.linalg.norm(np.ptp(view.places, axis=0))
    return float(_RADIUS * extent / np.sqrt(len(view.places)))


def _discs(
    places: FloatArray, normals: FloatArray, radius: float, lifted: bool = True
) -> FloatArray:
    """Return the triangles of discs on a surface, (N, corners, 3, 3)."""
    first, second = frames(normals)
    turns = 2 * np.pi * np.arange(_CORNERS + 1) / _CORNERS
    around = radius * (
        first[:, None] * np.cos(turns)[:, None]
        + second[:, None] * np.sin(turns)[:, None]
    )
    middles = places + (_HEIGHT * radius * normals if lifted else 0.0)
    rims = middles[:, None] + around
    hubs = np.broadcast_to(middles[:, None], rims[:, 1:].shape)
    return np.stack([hubs, rims[:, :-1], rims[:, 1:]], axis=2)
