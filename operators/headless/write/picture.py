"""Pictures of parts in their colors, rendered without a window."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import pi, radians
from pathlib import Path

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector
from numpy.typing import NDArray

from ...bridge.mesh.corners import corner_vertices
from ...bridge.mesh.points import is_cloud
from ...bridge.parts.materials import discard_unused, our_materials
from ..quiet import quiet_blender
from .models import replacing, told
from .render_engine import RenderEngine
from .splat_mesh import splat_mesh

_ELEVATION = radians(22.0)
# Turns about the vertical axis: three quarters from the front, and from behind.
_VIEWS = (radians(35.0), radians(215.0))
_FOCAL_LENGTH = 70.0  # mm on a 36 mm sensor: little perspective, as in portraits
_MARGIN = 1.08
_BACKGROUND = 0.96
_CYCLES_SAMPLES = 16


def save_picture(
    path: Path,
    objects: Sequence[bpy.types.Object],
    engine: RenderEngine,
    size: int = 900,
) -> None:
    """Write a picture of `objects` from the front and the back, side by side.

    A scene of its own is rendered and removed again: cameras, lights and settings of
    the file play no role. Each view is a square of `size` pixels.
    """
    with (
        told(path, "rendered or written"),
        replacing(path) as unfinished,
        quiet_blender(),
    ):
        views = _render(objects, engine, size)
        _write_png(unfinished, np.concatenate(views, axis=1))


def _render(
    objects: Sequence[bpy.types.Object], engine: RenderEngine, size: int
) -> list[NDArray[np.float32]]:
    """Return the view of `objects` from each side, (height, width, 4) in sRGB."""
    with _temporary_scene(objects) as scene, tempfile.TemporaryDirectory() as folder:
        _set_up(scene, engine)
        scene.render.resolution_x = scene.render.resolution_y = size
        coordinates = _coordinates([o for o in scene.objects if o.type == "MESH"])
        scene.render.filepath = str(Path(folder, "view.png"))
        views = []
        for turn in _VIEWS:
            _aim(scene, turn, coordinates)
            bpy.ops.render.render(write_still=True, scene=scene.name)
            views.append(_pixels(Path(scene.render.filepath)))
        return views


@contextmanager
def _temporary_scene(
    objects: Sequence[bpy.types.Object],
) -> Iterator[bpy.types.Scene]:
    """Give a scene with stand-ins for `objects`, a camera and a lamp."""
    scene = bpy.data.scenes.new("Picture")
    camera = bpy.data.cameras.new("Picture")
    lamp = bpy.data.lights.new("Picture", "SUN")
    world = bpy.data.worlds.new("Picture")
    stand_ins, made = [], []
    for obj in objects:
        # Not the object itself: it may be hidden, and has modifiers that the parts
        # do not know of.
        mesh = obj.data
        if is_cloud(obj):
            mesh = splat_mesh(obj)
            made.append(mesh)
        stand_in = bpy.data.objects.new(obj.name, mesh)
        stand_in.matrix_world = obj.matrix_world
        stand_ins.append(stand_in)
    scene.camera = bpy.data.objects.new("Picture", camera)
    sun = bpy.data.objects.new("Sun", lamp)
    for obj in (*stand_ins, scene.camera, sun):
        scene.collection.objects.link(obj)
    scene.world = world
    try:
        yield scene
    finally:
        ours = [*stand_ins, *made, scene.camera, sun, camera, lamp, world]
        bpy.data.batch_remove(ours)
        discard_unused(our_materials())
        bpy.data.scenes.remove(scene)


def _set_up(scene: bpy.types.Scene, engine: RenderEngine) -> None:
    """Choose engine and look."""
    render = scene.render
    render.engine = engine
    render.film_transparent = True
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGBA"
    scene.view_settings.view_transform = "Standard"
    if engine == "CYCLES":
        _set_up_cycles(scene)
        return
    scene.display.render_aa = "8"
    shading = scene.display.shading
    shading.light = "STUDIO"
    shading.studio_light = "paint.sl"  # the brightest: colors stay what they are
    shading.color_type = "MATERIAL"
    shading.show_specular_highlight = False
    shading.show_cavity = True
    shading.cavity_type = "WORLD"
    shading.cavity_valley_factor = 0.8
    shading.show_shadows = True
    shading.shadow_intensity = 0.3


def _set_up_cycles(scene: bpy.types.Scene) -> None:
    """Choose what makes Cycles quick, and light the scene."""
    scene.cycles.device = "CPU"
    scene.cycles.samples = _CYCLES_SAMPLES
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 2
    lamp = next(obj for obj in scene.objects if obj.type == "LIGHT")
    lamp.data.energy = 2.5
    lamp.data.angle = radians(20.0)
    scene.world.color = (0.6, 0.6, 0.6)
    if scene.world.node_tree:  # from Blender 5.0 on the color is in the nodes
        background = scene.world.node_tree.nodes["Background"]
        background.inputs["Color"].default_value = (0.6, 0.6, 0.6, 1.0)


def _coordinates(objects: Sequence[bpy.types.Object]) -> NDArray[np.float32]:
    """Return the corners of all faces in world space, (N, 3)."""
    found = []
    for obj in objects:
        positions = np.empty(len(obj.data.vertices) * 3, dtype=np.float32)
        obj.data.vertices.foreach_get("co", positions)
        corners = positions.reshape(-1, 3)[np.unique(corner_vertices(obj.data))]
        matrix = np.array(obj.matrix_world, dtype=np.float32)
        found.append(corners @ matrix[:3, :3].T + matrix[:3, 3])
    return np.concatenate(found)


def _aim(scene: bpy.types.Scene, turn: float, coordinates: NDArray[np.float32]) -> None:
    """Look from one side, with all coordinates just in the frame.

    For each edge of the frame the coordinate farthest out decides. With slope t of
    the edge, x + t z is bounded by it; both bounds give the distance and the shift.
    """
    camera = scene.camera
    camera.data.lens = _FOCAL_LENGTH
    rotation = Euler((pi / 2 - _ELEVATION, 0.0, turn)).to_matrix()
    x, y, z = (coordinates @ np.array(rotation, dtype=np.float32)).T.astype(float)
    slope = camera.data.sensor_width / 2 / camera.data.lens / _MARGIN
    right, left = (x + slope * z).max(), (x - slope * z).min()
    top, bottom = (y + slope * z).max(), (y - slope * z).min()
    eye = Vector(
        (
            (right + left) / 2,
            (top + bottom) / 2,
            max(right - left, top - bottom) / (2 * slope),
        )
    )
    camera.matrix_world = Matrix.Translation(rotation @ eye) @ rotation.to_4x4()
    distances = eye.z - z
    camera.data.clip_start = max(distances.min() * 0.5, distances.max() * 1e-5)
    camera.data.clip_end = distances.max() * 2.0
    for obj in scene.objects:
        if obj.type == "LIGHT":  # over the left shoulder
            obj.matrix_world = (
                rotation @ Euler((radians(-35.0), radians(-30.0), 0.0)).to_matrix()
            ).to_4x4()


def _pixels(path: Path) -> NDArray[np.float32]:
    """Return the pixels of a PNG file as they are stored, bottom row first."""
    image = bpy.data.images.load(str(path))
    try:
        pixels = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(pixels)
        return pixels.reshape(image.size[1], image.size[0], -1)
    finally:
        bpy.data.images.remove(image)


def _write_png(path: Path, pixels: NDArray[np.float32]) -> None:
    """Write RGBA pixels over the background to a PNG file."""
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
