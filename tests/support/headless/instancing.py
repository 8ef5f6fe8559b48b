"""Files with instances, for tests: a rock, and what puts it in several places."""

import bpy
import numpy as np
from hand_made import in_scene

TETRAHEDRON = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
FACES = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]


def add(name, data=None, place=(0, 0, 0), collection=None):
    obj = bpy.data.objects.new(name, data)
    obj.location = place
    (collection or bpy.context.scene.collection).objects.link(obj)
    return obj


def mesh_of(vertices, faces, name="Rock"):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(vertices, [], faces)
    return mesh


def rock():
    return mesh_of(TETRAHEDRON, FACES)


def collection_with_rock(name="Rocks", in_scene=False):
    collection = bpy.data.collections.new(name)
    add("Rock", rock(), (0, 0, 5), collection)
    if in_scene:
        bpy.context.scene.collection.children.link(collection)
    return collection


def instance_of(collection, name, place=(0, 0, 0), within=None):
    empty = add(name, None, place, within)
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    return empty


def scatter(obj, joined=False, source=None):
    """Give an object nodes that put a cube, or `source`, on each of its points."""
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    for direction in ("INPUT", "OUTPUT"):
        tree.interface.new_socket(
            "Geometry", in_out=direction, socket_type="NodeSocketGeometry"
        )
    start, end = (tree.nodes.new(f"NodeGroup{way}put") for way in ("In", "Out"))
    on_points = tree.nodes.new("GeometryNodeInstanceOnPoints")
    shape = tree.nodes.new(
        "GeometryNodeObjectInfo" if source else "GeometryNodeMeshCube"
    )
    if source:
        shape.inputs["Object"].default_value = source
        shape.inputs["As Instance"].default_value = True
    tree.links.new(start.outputs[0], on_points.inputs["Points"])
    made = shape.outputs["Geometry" if source else "Mesh"]
    tree.links.new(made, on_points.inputs["Instance"])
    last = on_points.outputs[0]
    if joined:
        join = tree.nodes.new("GeometryNodeJoinGeometry")
        for output in (start.outputs[0], last):
            tree.links.new(output, join.inputs[0])
        last = join.outputs[0]
    tree.links.new(last, end.inputs[0])
    obj.modifiers.new("Scatter", "NODES").node_group = tree


def saved(path):
    bpy.context.view_layer.update()
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True)
    return path


def boxes(objects):
    """Return the corners of the bounding box of each object in world space, by name."""
    bpy.context.view_layer.update()
    found = {}
    for obj in objects:
        if not obj.data.vertices:
            continue
        points = in_scene(obj)
        low, high = points.min(axis=0), points.max(axis=0)
        found[obj.name] = [*np.round(low, 3).tolist(), *np.round(high, 3).tolist()]
    return found


def box(x, y, z, size=1):
    return [x, y, z, x + size, y + size, z + size]
