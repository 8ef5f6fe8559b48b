"""Objects rendered by Workbench, with a line of text below."""

from __future__ import annotations

import tempfile
from math import pi, radians
from pathlib import Path

import bpy
import numpy as np
from image import BACKGROUND
from mathutils import Euler, Matrix, Vector

FROM_ABOVE = 90.0  # degrees: for flat shapes
_MARGIN = 1.06
_SHARP = radians(40.0)  # edges with a larger angle stay edges
_TEXT_HEIGHT = 34  # pixels
_TEXT_COLOR = (0.03, 0.03, 0.03, 1.0)


def panel(
    objects: list[bpy.types.Object],
    text: str = "",
    size: int = 400,
    turn: float = 35.0,
    elevation: float = 22.0,
) -> np.ndarray:
    """Return a square view of objects, with text below, (H, W, 3) in sRGB.

    Parameters
    ----------
    turn, elevation : float
        Where the camera stands, in degrees; at turn 0 it looks along +Y.
    """
    for obj in objects:
        if obj.type == "MESH":
            obj.data.shade_smooth()
            obj.data.set_sharp_from_angle(angle=_SHARP)
    rotation = Euler((pi / 2 - radians(elevation), 0.0, radians(turn))).to_matrix()
    flat = elevation == FROM_ABOVE
    pixels = _render(objects, rotation, (size, size), flat)
    return np.concatenate([pixels, caption(text, size)]) if text else pixels


def caption(text: str, width: int) -> np.ndarray:
    """Return a line of text, (H, W, 3)."""
    curve = bpy.data.curves.new("Text", "FONT")
    curve.body, curve.align_x, curve.align_y = text, "CENTER", "CENTER"
    material = bpy.data.materials.new("Text")
    material.diffuse_color = _TEXT_COLOR
    curve.materials.append(material)
    obj = bpy.data.objects.new("Text", curve)
    scale = width / _TEXT_HEIGHT * 1.55  # in heights of a letter
    pixels = _render([obj], Matrix.Identity(3), (width, _TEXT_HEIGHT), True, scale)
    bpy.data.batch_remove([obj, curve, material])
    return pixels


def _render(
    objects: list[bpy.types.Object],
    rotation: Matrix,
    size: tuple[int, int],
    flat: bool,
    scale: float | None = None,
) -> np.ndarray:
    """Return a view along -Z of `rotation`: all objects, or `scale` units wide."""
    scene = bpy.data.scenes.new("Figure")
    camera = bpy.data.cameras.new("Figure")
    camera.type, camera.clip_end = "ORTHO", 1000.0
    scene.camera = bpy.data.objects.new("Figure", camera)
    for obj in (*objects, scene.camera):
        scene.collection.objects.link(obj)
    middle = Vector()
    if scale is None:
        bpy.context.window.scene = scene
        scene.view_layers[0].update()
        low, high = _bounds(scene, rotation)
        middle = rotation @ Vector((low + high) / 2)
        scale = float((high - low)[:2].max()) * _MARGIN
    camera.ortho_scale = scale
    away = rotation @ Vector((0, 0, 400))
    scene.camera.matrix_world = Matrix.Translation(middle + away) @ rotation.to_4x4()
    _set_up(scene, size, flat)
    try:
        with tempfile.TemporaryDirectory() as folder:
            scene.render.filepath = str(Path(folder, "view.png"))
            bpy.ops.render.render(write_still=True, scene=scene.name)
            return _read(scene.render.filepath)
    finally:
        bpy.data.batch_remove([scene.camera, camera])
        bpy.data.scenes.remove(scene)


def _bounds(scene: bpy.types.Scene, rotation: Matrix) -> tuple[np.ndarray, np.ndarray]:
    """Return the least and largest coordinates in the camera's axes."""
    depsgraph = scene.view_layers[0].depsgraph
    depsgraph.update()
    found = []
    for obj in scene.objects:
        if obj.type == "CAMERA":
            continue
        mesh = obj.evaluated_get(depsgraph).to_mesh()
        places = np.empty(len(mesh.vertices) * 3, dtype=np.float32)
        mesh.vertices.foreach_get("co", places)
        matrix = np.array(rotation.to_4x4().inverted() @ obj.matrix_world)
        found.append(places.reshape(-1, 3) @ matrix[:3, :3].T + matrix[:3, 3])
    places = np.concatenate(found)
    return places.min(axis=0), places.max(axis=0)


def _set_up(scene: bpy.types.Scene, size: tuple[int, int], flat: bool) -> None:
    """Choose Workbench, with the light and the colors of the other pictures."""
    render = scene.render
    render.engine = "BLENDER_WORKBENCH"
    render.resolution_x, render.resolution_y = size
    render.film_transparent = True
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGBA"
    scene.view_settings.view_transform = "Standard"
    scene.display.render_aa = "16"
    shading = scene.display.shading
    shading.color_type = "MATERIAL"
    shading.light = "FLAT" if flat else "STUDIO"
    if flat:
        return
    shading.studio_light = "paint.sl"
    shading.show_specular_highlight = False
    shading.show_cavity = True
    shading.cavity_type = "WORLD"
    shading.cavity_valley_factor = 0.8


def _read(path: str) -> np.ndarray:
    """Return a rendered file over the background, the upper row first."""
    image = bpy.data.images.load(path)
    width, height = image.size
    pixels = np.array(image.pixels, dtype=np.float32).reshape(height, width, 4)[::-1]
    bpy.data.images.remove(image)
    opacity = pixels[..., 3:]
    return pixels[..., :3] * opacity + BACKGROUND * (1.0 - opacity)
