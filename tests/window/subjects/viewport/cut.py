"""Shapes of few, large faces, which are cut: Solid, wireframe and the UV editor.

The pictures show one row: L, T, plus, house and a figure of blocks.
"""

from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
from hand_made import activate
from mathutils import Vector
from weak_convex_decomposition.operators.bridge.mesh.attributes import (
    read_floats,
    read_ints,
)

L = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 4), (0, 4)]
T = [(1, 0), (2, 0), (2, 3), (3, 3), (3, 4), (0, 4), (0, 3), (1, 3)]
PLUS = [(1, 0), (2, 0), (2, 1.5), (3, 1.5), (3, 2.5), (2, 2.5)]
PLUS += [(2, 4), (1, 4), (1, 2.5), (0, 2.5), (0, 1.5), (1, 1.5)]
# A wall with a roof that stands out over it.
HOUSE = [(0.5, 0), (2.5, 0), (2.5, 2), (3, 2), (1.5, 3.5), (0, 2), (0.5, 2)]
# Cells of the figure, from its feet to its head, by the edges of their rows.
WIDTHS = (0, 0.8, 1.2, 1.8, 2.2, 3)
HEIGHTS = (0, 1.6, 2.5, 3, 3.2, 4)
ROWS = ((1, 3), (1, 2, 3), (0, 1, 2, 3, 4), (2,), (2,))


def blocks(rows, widths, heights, depth):
    """Return the corners and faces of cells that are joined to one skin."""
    full = np.zeros((len(widths) + 1, len(heights) + 1), dtype=bool)
    for row, columns in enumerate(rows, 1):
        full[np.add(columns, 1), row] = True
    faces, places = [], {}

    def corner(x, y, z):
        key = x, y, z
        return places.setdefault(key, len(places))

    for i, j in np.argwhere(full).tolist():
        x, z = i - 1, j - 1
        ring = [(x, z), (x + 1, z), (x + 1, z + 1), (x, z + 1)]
        faces.append([corner(a, 0, c) for a, c in ring])
        faces.append([corner(a, 1, c) for a, c in reversed(ring)])
        beside = (full[i, j - 1], full[i + 1, j], full[i, j + 1], full[i - 1, j])
        for side, covered in enumerate(beside):
            if not covered:
                (a, b), (c, d) = ring[side], ring[(side + 1) % 4]
                faces.append(
                    [corner(a, 0, b), corner(a, 1, b), corner(c, 1, d), corner(c, 0, d)]
                )
    corners = [(widths[x], y * depth, heights[z]) for x, y, z in places]
    return corners, faces


def extruded(outline, depth=1.0):
    """Return the corners and faces of a prism; its ends are single faces."""
    n = len(outline)
    corners = [(x, y, z) for y in (0.0, depth) for x, z in outline]
    sides = [(i, i + n, (i + 1) % n + n, (i + 1) % n) for i in range(n)]
    return corners, [list(range(n)), list(range(n, 2 * n))[::-1], *sides]


SHAPES = {
    "L": extruded(L),
    "T": extruded(T),
    "Plus": extruded(PLUS),
    "House": extruded(HOUSE, 2.5),
    "Figure": blocks(ROWS, WIDTHS, HEIGHTS, 0.6),
}


# On Auto, the figure's head stays on its body: they hide little from each other.
GIVEN = {"Figure": 6}
# The house loses its eaves: all other points of it see each other.
N_PARTS = {"L": 2, "T": 3, "Plus": 3, "House": 3, "Figure": 6}


def add_shape(name, place):
    """Add a shape with UVs in a tile of its own."""
    corners, faces = SHAPES[name]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    obj.location.x = 4.0 * place
    bm = bmesh.new()
    bm.from_mesh(mesh)
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    bm.to_mesh(mesh)
    bm.free()
    activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(island_margin=0.03)
    bpy.ops.object.mode_set(mode="OBJECT")
    for corner in mesh.uv_layers.active.data:
        corner.uv += Vector((1.1 * (place % 2), 1.1 * (place // 2)))
    return obj


def uvs_of(obj):
    """Return the lowest and the highest corner of an object's UVs."""
    uvs = np.array([corner.uv for corner in obj.data.uv_layers.active.data])
    return np.array([uvs.min(axis=0), uvs.max(axis=0)])


def check(obj, tile):
    """Check that parts are those of the name, without specks, and UVs in their tile."""
    assert len(obj.wcd_parts) == N_PARTS[obj.name], obj.name
    labels = read_ints(obj.data.attributes["wcd_part"].data, "value")
    areas = read_floats(obj.data.polygons, "area")
    assert np.bincount(labels, areas)[np.unique(labels)].min() > 0.05 * areas.sum()
    assert np.allclose(uvs_of(obj), tile, atol=1e-5)


def steps(hands):
    with hands.context():
        for obj in list(bpy.data.objects):
            bpy.data.objects.remove(obj)
        bpy.context.view_layer.update()
        objects = [add_shape(name, place) for place, name in enumerate(SHAPES)]
        tiles = [uvs_of(obj) for obj in objects]
        for obj in objects:
            activate(obj)
            bpy.ops.wcd.decompose(seams="CUT", parts=GIVEN.get(obj.name, 0))
    for obj, tile in zip(objects, tiles, strict=True):
        check(obj, tile)
        obj.select_set(True)
    hands.window.workspace = bpy.data.workspaces["UV Editing"]
    yield 0.5
    space = hands.area.spaces.active
    space.overlay.show_wireframes, space.overlay.show_floor = True, False
    space.shading.color_type = "MATERIAL"
    with hands.context():
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
    hands.look()
    yield from shown(hands, objects)
    with hands.context():
        for obj in objects:
            obj.select_set(True)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
    yield 0.5
    area = next(a for a in hands.window.screen.areas if a.type == "IMAGE_EDITOR")
    region = next(r for r in area.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=hands.window, area=area, region=region):
        bpy.ops.image.view_selected()
    yield 0.5
    hands.picture("uv", area)


def shown(hands, objects):
    """Take pictures of the row in Solid and in wireframe."""
    for obj in objects:
        obj.select_set(False)
    area = hands.area
    row = SimpleNamespace(
        x=area.x + area.width // 6,
        y=area.y + int(0.36 * area.height),
        width=area.width * 5 // 6 - 70,
        height=int(0.24 * area.height),
    )
    for name in ("SOLID", "WIREFRAME"):
        hands.area.spaces.active.shading.type = name
        yield 0.5
        hands.picture(name.lower(), row)
