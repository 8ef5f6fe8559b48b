"""Meshes of few, large faces at random, and what cutting their faces must keep.

Layers of theirs are linear functions of the position, so that values at new corners are
known.
"""

import bmesh
import bpy
import numpy as np
from mathutils import Matrix, Vector

_FIELD = np.array([[0.03, 0.02, -0.02, 0.5], [0.01, -0.03, 0.02, 0.5]])


def low_poly(seed):
    """Return a new active object: boxes pushed out of each other, or a prism."""
    rng = np.random.default_rng(seed)
    bm = bmesh.new()
    _prism(bm, rng) if seed % 3 == 0 else _limbs(bm, rng)
    if rng.random() < 0.3:
        bmesh.ops.triangulate(bm, faces=bm.faces)
    if rng.random() < 0.5:  # four corners are in no plane then
        for vertex in bm.verts:
            vertex.co += Vector(rng.normal(0, 0.04, 3))
    if rng.random() < 0.2:
        bmesh.ops.delete(bm, geom=[bm.faces[:][-1]], context="FACES_ONLY")
    mesh = bpy.data.meshes.new(f"Low {seed}")
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new(mesh.name, mesh)
    bpy.context.collection.objects.link(obj)
    for each in bpy.context.view_layer.objects:
        each.select_set(each == obj)
    bpy.context.view_layer.objects.active = obj
    _give_layers(obj, rng)
    return obj


def _prism(bm, rng):
    """Make a prism whose ends are polygons of many corners: a comb or a zigzag."""
    n_teeth = int(rng.integers(1, 4))
    outline, depth = [(0.0, 0.0)], rng.uniform(0.6, 1.2)
    outline.append((2.0 * n_teeth + 1, 0.0))
    for tooth in reversed(range(n_teeth + 1)):
        height = depth + rng.uniform(0.8, 3)
        outline += [(2.0 * tooth + 1, height), (2.0 * tooth, height)]
        if tooth:
            outline += [(2.0 * tooth, depth), (2.0 * tooth - 1, depth)]
    bottom = bm.faces.new([bm.verts.new((x, y, 0)) for x, y in outline])
    _pushed(bm, bottom, Vector((0, 0, rng.uniform(0.5, 1.5))))
    bm.faces.new(bm.verts[: len(outline)][::-1])


def _pushed(bm, face, away):
    """Return a copy of a face farther out; walls lead there. The face itself goes.

    Blender's own extrusion numbers faces anew each time.
    """
    low = face.verts[:]
    high = [bm.verts.new(vertex.co + away) for vertex in low]
    bm.faces.remove(face)
    for one, other in zip(range(-1, len(low) - 1), range(len(low)), strict=True):
        bm.faces.new([low[one], low[other], high[other], high[one]])
    bm.verts.ensure_lookup_table()
    return bm.faces.new(high)


def _limbs(bm, rng):
    """Make a box with limbs of two boxes each."""
    bmesh.ops.create_cube(bm, size=2)
    bm.faces.ensure_lookup_table()
    for face in [bm.faces[i] for i in rng.permutation(6)[: rng.integers(2, 5)]]:
        for _ in range(2):
            face.normal_update()
            face = _pushed(bm, face, face.normal * rng.uniform(0.8, 2.2))
            center = face.calc_center_median()
            turn = Matrix.Rotation(rng.normal(0, 0.3), 3, Vector(rng.normal(0, 1, 3)))
            size = rng.uniform(0.45, 0.9)
            for vertex in face.verts:
                vertex.co = center + size * (turn @ (vertex.co - center))


def _give_layers(obj, rng):
    """Give an object a UV map, colors, weights, a shape key, creases and seams."""
    mesh = obj.data
    places = np.array([vertex.co for vertex in mesh.vertices])
    corners = places[[loop.vertex_index for loop in mesh.loops]]
    uv, colors = expected(corners)
    layer = mesh.uv_layers.new(name="UVMap")
    layer.data.foreach_set("uv", uv.astype(np.float32).ravel())
    layer = mesh.color_attributes.new("Color", "FLOAT_COLOR", "CORNER")
    layer.data.foreach_set("color", colors.astype(np.float32).ravel())
    group = obj.vertex_groups.new(name="Weight")
    for number, weight in enumerate(expected(places)[0][:, 0].tolist()):
        group.add([number], weight, "REPLACE")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Twice")
    key.data.foreach_set("co", (2 * places + 1).astype(np.float32).ravel())
    for name, kind, domain in (
        ("crease_edge", float, "EDGE"),
        ("Number", int, "FACE"),
        ("uv_seam", bool, "EDGE"),
    ):
        data_type = {float: "FLOAT", int: "INT", bool: "BOOLEAN"}[kind]
        attribute = mesh.attributes.new(name, data_type, domain)
        values = rng.integers(0, 2, len(attribute.data))
        if domain == "FACE":
            values = np.arange(len(values))
        attribute.data.foreach_set("value", values.astype(kind))
    materials = [bpy.data.materials.new(name) for name in ("One", "Two")]
    for material in materials:
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", rng.integers(0, 2, len(mesh.polygons)))
    if rng.random() < 0.4:
        normals = [loop.vector for loop in mesh.corner_normals]
        tilted = [(Vector((0.1, 0.2, 0.3)) + vector).normalized() for vector in normals]
        mesh.normals_split_custom_set(tilted)
    mesh.update()


def expected(places):
    """Return the values of UV maps and of colors at some places."""
    uv = places @ _FIELD[:, :3].T + _FIELD[:, 3]
    return uv, np.concatenate([uv, uv], axis=1)


def figures(obj):
    """Return what cuts must not change: areas, volume, lengths and what they carry."""
    mesh = obj.data
    bm = bmesh.new()
    bm.from_mesh(mesh)
    uv = bm.loops.layers.uv["UVMap"]
    crease = bm.edges.layers.float["crease_edge"]
    lengths = np.zeros((5, 3))
    for edge in bm.edges:
        kind = min(len(edge.link_faces), 4)
        flags = (kind != 2, edge[crease], edge.seam)
        lengths[kind] += [edge.calc_length() * float(flag) for flag in flags]
    corners = bm.calc_loop_triangles()
    places = np.array([[loop.vert.co for loop in each] for each in corners])
    crosses = np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0])
    found = {
        "euler": len(bm.verts) - len(bm.edges) + len(bm.faces),
        "area": np.linalg.norm(crosses, axis=1).sum() / 2,
        "volume": (places[:, 0] * crosses).sum() / 6,
        "lengths": lengths,
        "uv": sum(_uv_area([loop[uv].uv for loop in f.loops]) for f in bm.faces),
    }
    bm.free()
    if mesh.has_custom_normals:  # one for all corners of a face
        found["normals"] = _face_normals(mesh)
    return found


def _face_normals(mesh):
    """Return the normal that all corners of each whole face have."""
    numbers = np.array([each.value for each in mesh.attributes["Number"].data])
    normals = np.array([each.vector for each in mesh.corner_normals])
    faces = np.repeat(numbers, [len(polygon.vertices) for polygon in mesh.polygons])
    means = np.zeros((int(numbers.max()) + 1, 3))
    np.add.at(means, faces, normals)
    means /= np.bincount(faces)[:, None]
    assert np.abs(normals - means[faces]).max() < 0.01
    return means


def _uv_area(corners):
    """Return the signed area of a polygon of a UV map."""
    x, y = np.array(corners).T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def check_kept(obj, before, n_faces):
    """Check the figures of an object whose faces were cut, and its layers."""
    for name, value in figures(obj).items():
        near = 0.02 if name == "normals" else 1e-4  # Blender rounds normals
        assert np.allclose(value, before[name], rtol=1e-4, atol=near), name
    mesh = obj.data
    places = np.array([vertex.co for vertex in mesh.vertices])
    corners = places[[loop.vertex_index for loop in mesh.loops]]
    uv, colors = expected(corners)
    layer = np.array([each.uv for each in mesh.uv_layers["UVMap"].data])
    assert np.allclose(layer, uv, atol=1e-4)
    layer = np.array([each.color for each in mesh.color_attributes["Color"].data])
    assert np.allclose(layer, colors, atol=1e-4)
    group = obj.vertex_groups["Weight"]
    weights = [group.weight(number) for number in range(len(places))]
    assert np.allclose(weights, expected(places)[0][:, 0], atol=1e-4)
    key = np.array([each.co for each in mesh.shape_keys.key_blocks["Twice"].data])
    assert np.allclose(key, 2 * places + 1, atol=1e-4)
    numbers = {each.value for each in mesh.attributes["Number"].data}
    assert numbers == set(range(n_faces))
