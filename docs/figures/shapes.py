"""The solid shapes of the figures: Blender's primitives, and shapes built here."""

from __future__ import annotations

from itertools import pairwise
from math import cos, radians, sin

import bmesh
import bpy
import numpy as np
from scipy.spatial import ConvexHull

# Elements of the bear: center and radius; mirrored ones have both signs of x.
_BEAR = [
    ((0, 0, 0), 2.1),
    ((0, -0.1, 2.2), 1.8),
    ((0, -1.1, 2.0), 0.8),
    *(((s * 1.0, 0, 3.15), 0.9) for s in (-1, 1)),
    *(
        ((s * (1.3 + t), -0.3 * t, 0.6 - 0.1 * t), 0.8)
        for s in (-1, 1)
        for t in (0, 0.6, 1.2)
    ),
    *(
        ((s * (0.8 + 0.2 * t), -0.6 * t, -1.1 - t), 0.95)
        for s in (-1, 1)
        for t in (0, 0.7, 1.4)
    ),
]
# Joints of the dog: place and radius of the skin; then its bones.
_DOG = {
    "hip": ((0, 1.3, 0), 0.5),
    "chest": ((0, -1.0, 0.1), 0.55),
    "neck": ((0, -1.7, 0.9), 0.3),
    "head": ((0, -1.9, 1.35), 0.45),
    "nose": ((0, -2.8, 1.2), 0.22),
    "tail": ((0, 2.1, 0.6), 0.16),
    "tip": ((0, 2.6, 1.3), 0.1),
}
_BONES = ["hip chest", "chest neck", "neck head", "head nose", "hip tail", "tail tip"]
# Boxes of the chair: center and size.
_CHAIR = [
    ((0, 0, 0), (2, 2, 0.3)),
    ((0, 0.9, 1.3), (2, 0.3, 2.3)),
    *(((x, y, -1.1), (0.3, 0.3, 1.9)) for x in (-0.75, 0.75) for y in (-0.75, 0.75)),
]
# The fingers of the hand: root, tip and radius, thumb first.
FINGERS = [
    ((-0.95, 0, 0.1), (-2.15, 0, 1.2), 0.27),
    ((-0.62, 0, 1.2), (-1.0, 0, 3.1), 0.24),
    ((-0.05, 0, 1.35), (-0.08, 0, 3.5), 0.25),
    ((0.5, 0, 1.25), (0.8, 0, 3.15), 0.24),
    ((1.0, 0, 0.95), (1.85, 0, 2.6), 0.21),
]


def suzanne() -> bpy.types.Object:
    """Return Blender's monkey with two subdivisions, turned towards the camera."""
    bpy.ops.mesh.primitive_monkey_add()
    return _subdivided(bpy.context.object, 2)


def bear() -> bpy.types.Object:
    """Return a bear of metaballs."""
    ball = bpy.data.metaballs.new("Bear")
    ball.resolution = ball.render_resolution = 0.09
    for center, radius in _BEAR:
        element = ball.elements.new()
        element.co, element.radius = center, radius
    added(ball)
    bpy.ops.object.convert(target="MESH")
    return bpy.context.object


def dog() -> bpy.types.Object:
    """Return a dog of bones and a skin modifier."""
    joints, bones = dict(_DOG), [tuple(bone.split()) for bone in _BONES]
    for x in (-0.7, 0.7):
        for end, y in (("hip", 1.4), ("chest", -1.1)):
            knee, paw = f"{end} {x} knee", f"{end} {x} paw"
            joints[knee] = ((x * 0.75, y, -0.55), 0.24)
            joints[paw] = ((x, y, -2.0), 0.2)
            bones += [(end, knee), (knee, paw)]
    names = list(joints)
    mesh = bpy.data.meshes.new("Dog")
    edges = [(names.index(a), names.index(b)) for a, b in bones]
    mesh.from_pydata([joints[name][0] for name in names], edges, [])
    obj = added(mesh)
    obj.modifiers.new("Skin", "SKIN").use_smooth_shade = False
    for vertex, name in zip(mesh.skin_vertices[0].data, names, strict=True):
        vertex.radius = (joints[name][1],) * 2
    mesh.skin_vertices[0].data[0].use_root = True
    return _subdivided(obj, 3)


def chair() -> bpy.types.Object:
    """Return a chair of boxes that run into each other."""
    return boxes(_CHAIR)


def boxes(of: list[tuple], cuts: int = 11) -> bpy.types.Object:
    """Return boxes, given by center and size, as one mesh with closed shells."""
    build = bmesh.new()
    for center, size in of:
        made = bmesh.ops.create_cube(build, size=1.0)["verts"]
        bmesh.ops.scale(build, vec=size, verts=made)
        bmesh.ops.translate(build, vec=center, verts=made)
    bmesh.ops.subdivide_edges(build, edges=build.edges, cuts=cuts, use_grid_fill=True)
    return _built(build, "Boxes")


def turned(profile: list[tuple[float, float]], segments: int = 64) -> bpy.types.Object:
    """Return the solid of a profile of (radius, height) turned around Z.

    The profile runs counter-clockwise as seen with the axis at its left, and begins and
    ends on the axis.
    """
    angles = np.linspace(0, 2 * np.pi, segments, endpoint=False)
    vertices, rings = [], []
    for radius, height in profile:
        on_axis = radius < 1e-6
        first = len(vertices)
        around = angles[:1] if on_axis else angles
        vertices += [(radius * cos(a), radius * sin(a), height) for a in around]
        rings.append([first] * segments if on_axis else range(first, len(vertices)))
    faces = []
    for low, high in pairwise(rings):
        for i in range(segments):
            j = (i + 1) % segments
            corners = (low[i], low[j], high[j], high[i])
            faces.append(tuple(dict.fromkeys(corners)))  # triangles at the axis
    mesh = bpy.data.meshes.new("Turned")
    mesh.from_pydata(vertices, [], faces)
    return added(mesh)


def fused(of: list[list[tuple]], voxel: float) -> bpy.types.Object:
    """Return convex pieces, each around balls (center, radius), as one surface."""
    build = bmesh.new()
    turn = np.arange(200) * np.pi * (3 - 5**0.5)
    height = np.linspace(-1, 1, 200)
    around = np.sqrt(1 - height**2)
    sphere = np.stack([around * np.cos(turn), around * np.sin(turn), height], axis=1)
    for balls in of:
        places = np.concatenate([sphere * radius + center for center, radius in balls])
        verts = [build.verts.new(place) for place in places]
        for triangle in ConvexHull(places).simplices:
            build.faces.new([verts[i] for i in triangle])
    bmesh.ops.delete(
        build, geom=[v for v in build.verts if not v.link_faces], context="VERTS"
    )
    bmesh.ops.recalc_face_normals(build, faces=build.faces)
    obj = _built(build, "Fused")
    remesh = obj.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", voxel
    smooth = obj.modifiers.new("Smooth", "SMOOTH")
    smooth.factor, smooth.iterations = 0.5, 4
    return _applied(obj)


def hand() -> bpy.types.Object:
    """Return a hand: a palm, a wrist and five fingers."""
    corners = ((-0.55, 0, 1.05), (0.9, 0, 0.8), (0.55, 0, -0.5), (-0.7, 0, -0.2))
    palm = [(corner, 0.32) for corner in corners]
    wrist = [((0, 0, 0), 0.4), ((-0.05, 0, -1.3), 0.38)]
    fingers = [[(root, radius * 1.05), (tip, radius)] for root, tip, radius in FINGERS]
    return fused([palm, wrist, *fingers], voxel=0.045)


def figure() -> bpy.types.Object:
    """Return a person with arms stretched out, whose hands have fingers."""
    pieces = [
        [((-0.3, 0, 0.1), 0.45), ((0.3, 0, 0.1), 0.45), ((0, 0, 1.0), 0.55)],
        [((-0.45, 0, 1.7), 0.4), ((0.45, 0, 1.7), 0.4), ((0, 0, 0.8), 0.5)],
        [((0, 0, 1.9), 0.26), ((0, 0, 2.3), 0.26)],
        [((0, 0, 2.75), 0.48), ((0, -0.05, 2.95), 0.5)],
    ]
    for side in (-1, 1):
        wrist = np.array((side * 3.1, 0, 1.75))
        out = np.array((side, 0, 0))
        ankle = (side * 0.62, 0, -3.0)
        pieces += [
            [((side * 0.36, 0, 0), 0.38), (ankle, 0.2)],
            [(ankle, 0.2), ((side * 0.7, -0.5, -3.06), 0.15)],
            [((side * 0.6, 0, 1.75), 0.3), (wrist, 0.17)],
            [(wrist, 0.17), (wrist + out * 0.35, 0.25)],
        ]
        for angle in (-85, -36, -12, 12, 36):
            way = np.array((side * cos(radians(angle)), 0, sin(radians(angle))))
            length = 0.6 if angle == -85 else 1.0
            root = wrist + out * 0.3
            pieces.append([(root, 0.09), (root + way * length, 0.07)])
    return fused(pieces, voxel=0.035)


def added(data: bpy.types.ID) -> bpy.types.Object:
    """Return a new active object for some data."""
    obj = bpy.data.objects.new(data.name, data)
    bpy.context.collection.objects.link(obj)
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def _built(build: bmesh.types.BMesh, name: str) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    build.to_mesh(mesh)
    build.free()
    return added(mesh)


def _subdivided(obj: bpy.types.Object, levels: int) -> bpy.types.Object:
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = levels
    return _applied(obj)


def _applied(obj: bpy.types.Object) -> bpy.types.Object:
    """Apply all modifiers and the scale."""
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.transform_apply(location=False, rotation=False)
    return obj
