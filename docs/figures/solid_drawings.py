"""The figures of solids and clouds, one function each, by the name of their file."""

from __future__ import annotations

import bmesh
import bpy
import extension
import numpy as np
import shapes
from image import below, beside, resized
from panels import BLUE, GREEN, RED, paint, parts
from points import sampled, seen_by_scanner
from render import caption, panel
from scipy.interpolate import CubicSpline
from scipy.spatial import cKDTree

# Radius and height along the profile of the vase.
_VASE = [
    (0.6, 0.0), (0.44, 0.4), (0.62, 0.75), (1.05, 1.3), (1.22, 1.9), (1.02, 2.5),
    (0.6, 2.95), (0.4, 3.35), (0.44, 3.65), (0.68, 3.95),
]  # fmt: skip


def gallery() -> np.ndarray:
    """Draw Suzanne, a bear, a dog and a chair (fig. 15)."""
    turns = (22, 22, 35, 35)
    makers = (shapes.suzanne, shapes.bear, shapes.dog, shapes.chair)
    return beside(
        [parts(make(), "", 400, turn) for make, turn in zip(makers, turns, strict=True)]
    )


def line_of_sight() -> np.ndarray:
    """Draw what a picked point sees, in green (fig. 2)."""
    picks = (
        (shapes.bear(), (0.0, -1, 0.0), (-0.4, 1, 0.0)),
        (_torus(), (0.9, -1, 0.6), (0.0, 1, -0.55)),
        (shapes.hand(), (0.15, -1, 0.3), (0, 1, 0)),
    )
    panels = []
    for obj, aim, direction in picks:
        way = np.array(direction) / np.linalg.norm(direction)
        origin = np.array(aim) - 10 * way
        point, places, normals, visible = extension.seen_from(obj, origin, way, 8000)
        faces = obj.data.polygons
        centers = np.array([face.center for face in faces])
        facing = np.array([face.normal for face in faces])
        # The nearest sample of the same side: thin walls have two.
        tree = cKDTree(np.hstack([places, normals * 0.1]))
        _, nearest = tree.query(np.hstack([centers, facing * 0.1]))
        paint(obj, BLUE, GREEN)
        faces.foreach_set("material_index", visible[nearest].astype(np.int32))
        mark = _ball(point, max(obj.dimensions) * 0.022)
        panels.append(panel([obj, mark], size=400, turn=20))
    return beside(panels)


def matrices() -> np.ndarray:
    """Draw a shape, its matrices of lines of sight, and its embedding (fig. 7)."""
    rows = []
    for text, parameters in (
        ("all pairs", {"sight": "ALL_PAIRS"}),
        ("rays in a cone", {"sight": "CONE", "samples": 1200}),
    ):
        obj = shapes.dog()
        shape = parts(obj, f"the parts: {text}", 300, parts=6, **parameters)
        row = [shape]
        for kind, name in (
            ("SIGHT", "lines of sight"),
            ("DISTANCES", "distances in the embedding"),
            ("SCATTER", "the embedding"),
        ):
            pixels = resized(extension.picture(obj, kind), 300, kind == "SCATTER")
            row.append(np.concatenate([pixels, caption(name, 300)]))
        rows.append(beside(row))
    return below(rows)


def clouds() -> np.ndarray:
    """Draw a cloud, its splats, and a scan from one side (figs. 1, 8 and 9)."""
    solid = shapes.dog()
    whole = sampled(solid, 6000)
    extension.decompose(whole, parts=7)
    splats = _splat_object(whole)
    towards = np.array((0.57, -0.82, 0.37))  # where the scanner stands
    seen = seen_by_scanner(solid, towards)
    scan = sampled(solid, 12000, keep=seen)
    extension.decompose(scan, parts=7)
    partial = _splat_object(scan)
    close = panel([splats], size=1500)[360:740, 60:440]
    return beside(
        [
            panel([splats], "all around", 380),
            np.concatenate([close, caption("its splats, from near", 380)]),
            panel([partial], "a scan, from the scanner", 380),
            panel([partial], "the same, from behind", 380, turn=215),
        ]
    )


def quality() -> np.ndarray:
    """Draw shapes with their quality before and after (fig. 10)."""
    text = "ψ {psi_before:.2f} → {psi:.2f}"
    vase = _vase()
    return beside(
        [
            parts(shapes.suzanne(), text, 300, 22),
            parts(shapes.bear(), text, 300, 22),
            parts(shapes.dog(), text, 300),
            parts(shapes.chair(), text, 300),
            parts(vase, text, 300),
        ]
    )


def overlap() -> np.ndarray:
    """Draw parts that overlap in volume (fig. 11)."""
    bars = [((0, 0, 0), (5, 0.7, 0.6)), ((0.1, 0, 0.1), (0.6, 5, 0.7))]
    obj = shapes.boxes([*bars, ((-0.1, 0.1, 0), (0.5, 0.5, 5))])
    whole = parts(obj, "three bars through each other: {k} parts", 400)
    apart = _separated(obj)
    return beside([whole, panel(apart, "the parts, moved apart", 400)])


def fingers() -> np.ndarray:
    """Draw a whole person, and a hand, on one level and by default (figs. 13c, 14)."""
    panels = []
    for levels, name in ((1, "Levels 1"), (0, "Levels Auto")):
        obj = shapes.figure()
        record = extension.decompose(obj, levels=levels)
        if levels == 0:
            text = f"{record['k']} parts, {name}"
            panels.insert(0, panel([obj], text, 420, turn=0, elevation=5))
        large = panel([obj], size=2400, turn=0, elevation=5)
        middle = 2400 // 2 - 440
        close = large[middle - 190 : middle + 190, 2010:2390]
        panels.append(np.concatenate([close, caption(f"a hand, {name}", 380)]))
    return beside(panels)


def containers() -> np.ndarray:
    """Draw a cup as a hollow thing and as a filled one (fig. 14)."""
    return beside(
        [
            parts(_cup(), "Containers hollow: {k} parts", 380, containers="HOLLOW"),
            parts(_cup(), "Containers filled: {k} part", 380),
        ]
    )


def sheets() -> np.ndarray:
    """Draw a thin table top seen from above and from below (fig. 14)."""
    top = [((0, 0, 0), (5, 3, 0.08))]
    legs = [((x, y, -1.3), (0.3, 0.3, 2.6)) for x in (-2, 2) for y in (-1.1, 1.1)]
    obj = shapes.boxes([*top, *legs], cuts=31)
    above = parts(obj, "{k} parts", 380)
    return beside([above, panel([obj], "from below", 380, elevation=-25)])


def _vase() -> bpy.types.Object:
    """Return a vase without a hollow."""
    radii, heights = CubicSpline(np.arange(len(_VASE)), _VASE)(
        np.linspace(0, len(_VASE) - 1, 60)
    ).T
    caps = [
        np.column_stack([np.linspace(0, 1, 8)[:-1] * r, np.full(7, h)])
        for r, h in ((radii[0], heights[0]), (radii[-1], heights[-1]))
    ]
    side = np.column_stack([radii, heights])
    return shapes.turned([*caps[0], *side, *caps[1][::-1]])


def _cup() -> bpy.types.Object:
    """Return a cup of thin walls."""
    steps = np.linspace(0, 1, 18)
    outer = [(0.8 + 0.25 * t, 2.2 * t) for t in steps]
    inner = [(0.75 + 0.25 * t, 0.08 + 2.12 * t) for t in steps[::-1]]
    floor = [(t * 0.8, 0.0) for t in steps[:-1:3]]
    bottom = [(t * 0.75, 0.08) for t in steps[:-1:3]][::-1]
    return shapes.turned([*floor, *outer, *inner, *bottom], 72)


def _torus() -> bpy.types.Object:
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=32, major_radius=1.0, minor_radius=0.36
    )
    return bpy.context.object


def _ball(place: np.ndarray, radius: float) -> bpy.types.Object:
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, radius=radius, location=place)
    paint(bpy.context.object, RED)
    return bpy.context.object


def _splat_object(cloud: bpy.types.Object) -> bpy.types.Object:
    return bpy.data.objects.new("Splats", extension.splats(cloud))


def _separated(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Return an object for each of three parts, side by side in the picture."""
    labels = extension.parts_of_faces(obj)
    found = []
    for part, way in enumerate((-4.3, 0, 3)):
        copy = bpy.data.objects.new("Part", obj.data.copy())
        doomed = np.flatnonzero(labels != part)
        _delete_faces(copy.data, doomed)
        copy.location = (way * 0.82, way * 0.57, 0)
        found.append(copy)
    return found


def _delete_faces(mesh: bpy.types.Mesh, doomed: np.ndarray) -> None:
    build = bmesh.new()
    build.from_mesh(mesh)
    build.faces.ensure_lookup_table()
    faces = [build.faces[i] for i in doomed]
    bmesh.ops.delete(build, geom=faces, context="FACES")
    build.to_mesh(mesh)
    build.free()


FIGURES = {
    each.__name__: each
    for each in (
        gallery, line_of_sight, matrices, clouds, quality, overlap, fingers, containers,
        sheets,
    )
}  # fmt: skip
