"""Decompositions and objects made by hand, so that writing is tested on its own."""

import bpy
import numpy as np
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.find import Decomposition
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.bridge.parts.write import write_parts


def decomposition_of(labels, notes=()):
    """Return a decomposition with these labels and made-up figures."""
    labels = np.asarray(labels, dtype=np.int64)
    counts = np.bincount(labels)
    return Decomposition(
        labels=labels,
        areas=counts / 2,
        ranks=np.linspace(1.0, 0.5, len(counts)),
        psi_before=0.5,
        psi=0.75,
        psi_by_k={1: 0.5, 2: 0.6, len(counts): 0.75},
        best_k=len(counts),
        notes=tuple(notes),
    )


def bands(obj, n_parts):
    """Return labels that cut the faces of an object into bands along x."""
    x = np.array([polygon.center.x for polygon in obj.data.polygons])
    ranks = np.argsort(np.argsort(x, kind="stable"), kind="stable")
    return ranks * n_parts // len(x)


def subdivided_suzanne(levels):
    """Return Blender's monkey with a subdivision applied, as a new active object."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = levels
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    return obj


def mesh_object(name, vertices, faces):
    """Return a new active object with a mesh of these vertices and faces."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    return obj


def activate(obj):
    """Make an object the active and only selected one."""
    for other in list(bpy.context.view_layer.objects):
        other.select_set(False)
    bpy.context.view_layer.objects.active = obj
    if obj is not None:
        obj.select_set(True)
    bpy.context.view_layer.update()


def give_user_data(obj):
    """Give an object groups, weights, slots, materials and properties of the user's."""
    for name in ("Gold", "Skin"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.materials.append(None)
    obj.material_slots[1].link = "OBJECT"
    obj.material_slots[1].material = bpy.data.materials.new("Own")
    obj.active_material_index = 1
    for polygon in obj.data.polygons:
        polygon.material_index = polygon.index % 3
    n_vertices = len(obj.data.vertices)
    for weight, name in ((0.25, "Part 01"), (0.5, "spine")):
        group = obj.vertex_groups.new(name=name)
        group.add(range(0, n_vertices, 3), weight, "REPLACE")
    obj.vertex_groups["spine"].lock_weight = True
    obj.vertex_groups.active_index = 1
    obj["note"] = "mine"
    obj.data["pipeline"] = 7
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="smile")
    attribute = obj.data.attributes.new("dust", "FLOAT", "FACE")
    attribute.data.foreach_set("value", [0.5] * len(obj.data.polygons))


def decompose_by_hand(obj, n_parts, **parameters):
    """Write bands as parts to an object; return their labels."""
    labels = bands(obj, n_parts)
    write_parts(obj, decomposition_of(labels), Parameters(**parameters))
    return labels


def face_values(mesh, name):
    """Return an INT attribute of the faces of a mesh."""
    values = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.attributes[name].data.foreach_get("value", values)
    return values


def in_mode(obj, mode):
    """Bring an object into a mode."""
    if obj.mode != mode:
        bpy.ops.object.mode_set(mode=mode)


def centers(obj):
    """Return the centers of an object's faces as its modifiers leave them."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    return np.array([polygon.center for polygon in mesh.polygons])


def in_scene(obj):
    """Return the vertices of an object in the scene, (V, 3)."""
    return np.array([obj.matrix_world @ vertex.co for vertex in obj.data.vertices])


def areas(mesh):
    return np.array([polygon.area for polygon in mesh.polygons])


def moved_apart(mesh, labels, distance):
    """Return where an exploded view shows the centers of a mesh's faces."""
    there = np.array([polygon.center for polygon in mesh.polygons])
    middle = np.average(there, axis=0, weights=areas(mesh))
    own = np.array(
        [
            np.average(there[mine], axis=0, weights=areas(mesh)[mine])
            for mine in (labels == part for part in range(max(labels) + 1))
        ]
    )
    return there + distance * (own - middle)[labels]


def build_hulls(objects, **settings):
    """Build hulls of objects as the button does; return the hulls."""
    for obj in objects:
        bpy.ops.object.select_all(action="DESELECT")
        obj.select_set(True)
        bpy.context.view_layer.objects.active = obj
        bpy.ops.wcd.build_hulls(**settings)
    return [hull for obj in objects for hull in hulls_of(obj)]


def add_ring(name, scale=(1, 1.5, -0.8)):
    """Return a new closed ring: turned, and by default stretched and mirrored."""
    bpy.ops.mesh.primitive_torus_add(
        location=(1, 2, 0.5),
        rotation=(0.3, 0.5, 1),
        major_segments=24,
        minor_segments=12,
        major_radius=0.4,
        minor_radius=0.15,
    )
    ring = bpy.context.active_object
    ring.name, ring.scale = name, scale
    return ring
