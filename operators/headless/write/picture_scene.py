"""The temporary scene of a picture: its objects, look, light and camera."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import pi, radians

import bpy
import numpy as np
from mathutils import Euler, Matrix, Vector

from .... import core
from ....core.geometry.frames import moved
from ....core.steps.arrays import Float32Array
from ...bridge.mesh.attributes import corner_vertices, read_attribute, write_ints
from ...bridge.mesh.points import is_cloud, normals_of, positions_of
from ...bridge.parts.materials import discard_unused, our_materials, own_materials
from ...bridge.parts.read import find_parts_on
from ...bridge.stored.names import NORMAL_LAYER
from .render_engine import RenderEngine

# Angle of the camera above the horizon.
_ELEVATION = radians(22.0)
_FOCAL_LENGTH = 70.0  # mm on a 36 mm sensor: little perspective, as in portraits
_MARGIN = 1.08
_CYCLES_SAMPLES = 16
# Direction of the lamp, as seen from the camera: over the left shoulder.
_LAMP = (radians(-35.0), radians(-30.0), 0.0)


@contextmanager
def picture_scene(objects: Sequence[bpy.types.Object]) -> Iterator[bpy.types.Scene]:
    """Make a scene with copies of `objects`, a camera and a lamp; remove it at the end.

    The copies share the meshes. The objects themselves may be hidden, and have
    modifiers that change the faces. Point clouds become meshes of splats.
    """
    scene = bpy.data.scenes.new("Picture")
    camera = bpy.data.cameras.new("Picture")
    lamp = bpy.data.lights.new("Picture", "SUN")
    world = bpy.data.worlds.new("Picture")
    copies, splats = [], []
    for obj in objects:
        mesh = obj.data
        if is_cloud(obj):
            mesh = splat_mesh(obj)
            splats.append(mesh)
        copy = bpy.data.objects.new(obj.name, mesh)
        copy.matrix_world = obj.matrix_world
        copies.append(copy)
    scene.camera = bpy.data.objects.new("Picture", camera)
    sun = bpy.data.objects.new("Sun", lamp)
    for obj in (*copies, scene.camera, sun):
        scene.collection.objects.link(obj)
    scene.world = world
    try:
        yield scene
    finally:
        ours = [*copies, *splats, scene.camera, sun, camera, lamp, world]
        bpy.data.batch_remove(ours)
        discard_unused(our_materials())
        bpy.data.scenes.remove(scene)


def splat_mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return a new mesh with the splats of a point cloud, in the colors of its parts.

    The mesh is empty if the cloud was not decomposed.
    """
    points = positions_of(obj).astype(np.float64)
    normals = read_attribute(obj.data, NORMAL_LAYER, "FLOAT_VECTOR", "POINT")
    if normals is None:
        normals = normals_of(obj)
    mesh = bpy.data.meshes.new(obj.name)
    found = find_parts_on(obj)
    if normals is None or found is None:
        return mesh
    kept, _, targets = core.thinned_splats(points, normals.astype(np.float64))
    mesh.from_pydata(targets.vertices, [], targets.triangles.tolist())
    for material in own_materials(found.identities, {}):
        mesh.materials.append(material)
    write_ints(mesh.polygons, "material_index", found.labels[kept])
    return mesh


def set_up_engine(scene: bpy.types.Scene, engine: RenderEngine) -> None:
    """Set the engine of a picture's scene, and how it draws."""
    render = scene.render
    render.engine = engine
    render.film_transparent = True
    render.image_settings.file_format = "PNG"
    render.image_settings.color_mode = "RGBA"
    scene.view_settings.view_transform = "Standard"
    if engine == "CYCLES":
        _set_up_cycles(scene)
    else:
        _set_up_workbench(scene)


def _set_up_workbench(scene: bpy.types.Scene) -> None:
    """Draw materials' colors, with soft shadows in creases."""
    scene.display.render_aa = "8"
    shading = scene.display.shading
    shading.light = "STUDIO"
    shading.studio_light = "paint.sl"  # the brightest: it changes colors least
    shading.color_type = "MATERIAL"
    shading.show_specular_highlight = False
    shading.show_cavity = True
    shading.cavity_type = "WORLD"
    shading.cavity_valley_factor = 0.8
    shading.show_shadows = True
    shading.shadow_intensity = 0.3


def _set_up_cycles(scene: bpy.types.Scene) -> None:
    """Make Cycles quick, and light the scene."""
    scene.cycles.device = "CPU"
    scene.cycles.samples = _CYCLES_SAMPLES
    scene.cycles.use_denoising = False
    scene.cycles.max_bounces = 2
    lamp = _lamp_of(scene).data
    lamp.energy = 2.5
    lamp.angle = radians(20.0)
    scene.world.color = (0.6, 0.6, 0.6)
    # Blender 5.0 and later take the color from nodes, whose names may be translated.
    for node in scene.world.node_tree.nodes if scene.world.node_tree else ():
        if node.type == "BACKGROUND":
            node.inputs["Color"].default_value = (0.6, 0.6, 0.6, 1.0)


def face_points(objects: Sequence[bpy.types.Object]) -> Float32Array:
    """Return the vertices of all faces in world space, (N, 3)."""
    found = []
    for obj in objects:
        points = positions_of(obj)[np.unique(corner_vertices(obj.data))]
        matrix = np.array(obj.matrix_world, dtype=np.float32)
        found.append(moved(points, matrix))
    return np.concatenate(found)


def aim_camera(scene: bpy.types.Scene, turn: float, points: Float32Array) -> None:
    """Move the camera and the lamp of a picture's scene so that all points show.

    The outermost point decides at each edge of the frame. In camera space, with slope
    t of the edge, x + t z must not exceed a bound there. The bounds of two opposite
    edges give the camera's distance and shift.

    Parameters
    ----------
    scene : Scene
    turn : float
        Angle of the camera about the vertical axis, in radians.
    points : (N, 3) float32
        In world space.
    """
    camera = scene.camera
    camera.data.lens = _FOCAL_LENGTH
    rotation = Euler((pi / 2 - _ELEVATION, 0.0, turn)).to_matrix()
    x, y, z = (points @ np.array(rotation, dtype=np.float32)).T.astype(float)
    slope = camera.data.sensor_width / 2 / camera.data.lens / _MARGIN
    right, left = (x + slope * z).max(), (x - slope * z).min()
    top, bottom = (y + slope * z).max(), (y - slope * z).min()
    width = max(right - left, top - bottom)
    eye = Vector(((right + left) / 2, (top + bottom) / 2, width / (2 * slope)))
    camera.matrix_world = Matrix.Translation(rotation @ eye) @ rotation.to_4x4()
    distances = eye.z - z
    camera.data.clip_start = max(distances.min() * 0.5, distances.max() * 1e-5)
    camera.data.clip_end = distances.max() * 2.0
    lamp_rotation = rotation @ Euler(_LAMP).to_matrix()
    _lamp_of(scene).matrix_world = lamp_rotation.to_4x4()


def _lamp_of(scene: bpy.types.Scene) -> bpy.types.Object:
    """Return the lamp of a picture's scene."""
    return next(obj for obj in scene.objects if obj.type == "LIGHT")
