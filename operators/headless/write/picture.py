"""Writes the picture of the parts: .png, rendered from the front and the back."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from math import radians
from pathlib import Path

import bpy
import numpy as np

from ....core.steps.arrays import Float32Array
from ...bridge.read.shape import has_place
from ..files.replacing import explaining, replacing
from ..files.whole import check_whole
from ..quiet import quiet_blender
from .picture_scene import aim_camera, face_points, picture_scene, set_up_engine
from .render_engine import RenderEngine

# Angles about the vertical axis: three quarters from the front, and from behind.
_VIEWS = (radians(35.0), radians(215.0))
# Width and height of each view, in pixels.
SIZE = 900
# Gray behind the objects, in sRGB.
_BACKGROUND = 0.96


def save_picture(
    path: Path, objects: Sequence[bpy.types.Object], engine: RenderEngine
) -> None:
    """Write a picture of `objects` from the front and the back, side by side.

    A temporary scene is rendered: cameras, lights and settings of the file do not
    matter.

    Parameters
    ----------
    path : Path
        File that ends in .png.
    objects : sequence of Object
        Meshes and point clouds.
    engine : {'BLENDER_WORKBENCH', 'CYCLES'}

    Raises
    ------
    DecompositionError
        If the picture cannot be rendered or written.
    """
    with (
        explaining(path, "rendered or written"),
        replacing(path) as unfinished,
        quiet_blender(),
    ):
        views = _render(list(filter(has_place, objects)), engine)
        _write_png(unfinished, np.concatenate(views, axis=1))


def _render(
    objects: Sequence[bpy.types.Object], engine: RenderEngine
) -> list[Float32Array]:
    """Return the view of `objects` from each side, (height, width, 4) in sRGB."""
    with picture_scene(objects) as scene, tempfile.TemporaryDirectory() as folder:
        set_up_engine(scene, engine)
        scene.render.resolution_x = scene.render.resolution_y = SIZE
        points = face_points([obj for obj in scene.objects if obj.type == "MESH"])
        view = Path(folder, "view.png")
        scene.render.filepath = str(view)
        views = []
        for turn in _VIEWS:
            aim_camera(scene, turn, points)
            bpy.ops.render.render(write_still=True, scene=scene.name)
            check_whole(view)
            views.append(_read_png(view))
        return views


def _read_png(path: Path) -> Float32Array:
    """Return the pixels of a PNG file as stored, (height, width, 4), bottom first."""
    image = bpy.data.images.load(str(path))
    try:
        pixels = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(pixels)
        return pixels.reshape(image.size[1], image.size[0], -1)
    finally:
        bpy.data.images.remove(image)


def _write_png(path: Path, pixels: Float32Array) -> None:
    """Write RGBA pixels to a PNG file, on top of the background."""
    opacity = pixels[..., 3:]
    opaque = np.ones_like(pixels)
    opaque[..., :3] = pixels[..., :3] * opacity + _BACKGROUND * (1.0 - opacity)
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("Picture", width, height)
    try:
        image.pixels.foreach_set(opaque.ravel())
        image.filepath_raw = str(path)
        image.file_format = "PNG"
        image.save()
    finally:
        bpy.data.images.remove(image)
