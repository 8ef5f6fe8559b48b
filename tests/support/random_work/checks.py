"""Objects for random work on parts, and what must always hold for them."""

import json

import bmesh
import bpy
import numpy as np
from edited import check_in_step
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.parts.materials import is_ours
from weak_convex_decomposition.operators.bridge.stored import names


def bone(x=0.0):
    """Return a new active object: a bar with a knob at each end, 58 faces."""
    bm = bmesh.new()
    bmesh.ops.create_grid(bm, x_segments=6, y_segments=2, size=1)
    for vertex in bm.verts:
        vertex.co.y *= 0.2 + 0.8 * (abs(vertex.co.x) > 0.5)
    bmesh.ops.solidify(bm, geom=bm.faces[:], thickness=0.4)
    bm.verts.index_update()
    # Blender makes the sides in an order that is another one each time.
    corners = [[vertex.index for vertex in face.verts] for face in bm.faces]
    starts = [each.index(min(each)) for each in corners]
    faces = [c[at:] + c[:at] for c, at in zip(corners, starts, strict=True)]
    mesh = bpy.data.meshes.new("Bone")
    mesh.from_pydata([vertex.co for vertex in bm.verts], [], sorted(faces))
    bm.clear()
    bm.from_mesh(mesh)
    bm.to_mesh(mesh)  # or Blender 5.0 crashes: it loads the edges without flags
    bm.free()
    obj = bpy.data.objects.new("Bone", mesh)
    obj.location.x = x
    bpy.context.collection.objects.link(obj)
    only(obj)
    return obj


def only(*objects):
    """Select objects, and nothing else; the first is the active one."""
    for each in bpy.context.view_layer.objects:
        each.select_set(each in objects)
    bpy.context.view_layer.objects.active = objects[0]


def bodies(without_faces=False):
    """Return the objects that can have parts, by name."""
    there = [o for o in bpy.context.view_layer.objects if names.HULL_TAG not in o]
    fit = (o for o in there if without_faces or o.data.polygons)
    return sorted(fit, key=lambda o: o.name)


def attempt(operator, **options):
    """Run an operator; an error must be a sentence, and no traceback."""
    said = ""
    try:
        operator("EXEC_DEFAULT", True, **options)
    except RuntimeError as error:
        said = str(error)
    assert "Traceback" not in said, said
    _mark_separated()


def check_body(obj):
    """Check that all that is known of an object's parts tells of the same ones."""
    figures = figures_of(obj)
    if figures is None:
        record = json.loads(obj.get(names.RESULT, "{}"))
        assert not {"parts", "psi"} & record.keys()
        assert names.PART_LAYER not in obj.data.attributes
        return
    identities, labels = figures.identities, figures.labels
    assert np.bincount(labels).tolist() == figures.measured_on[:, 0].tolist()
    for values in zip(*((i.number, i.name) for i in identities), strict=True):
        assert len(set(values)) == len(identities), values
    if figures.problem:
        return
    entries = figures.record["parts"]
    assert [e["faces"] for e in entries] == np.bincount(labels).tolist()
    assert [e["name"] for e in entries] == [i.name for i in identities]
    rows = {row.number: row for row in obj.wcd_parts}
    for identity in identities:
        assert rows[identity.number].name == identity.name
        assert np.allclose(rows[identity.number].color, identity.color)
    if not obj.data.is_editmode:
        check_in_step(obj)


def _mark_separated():
    """Mark the objects that parts became; copies keep the mark in other files, too."""
    for obj in bodies():
        if any(" parts" in each.name for each in obj.users_collection):
            obj["separated"] = True


def check_cleared(obj):
    """Check that nothing of ours is left on an object."""
    assert not [a.name for a in obj.data.attributes if "wcd" in a.name]
    # Where parts were separated, their materials are the user's.
    assert "separated" in obj or not any(map(is_ours, obj.data.materials))
    assert "wcd" not in obj
    assert not obj.vertex_groups
    assert not any(edge.use_seam for edge in obj.data.edges)
    assert not [key for key in obj.data.keys() if "wcd" in key]  # noqa: SIM118


def check_file_cleared():
    """Check that no hulls, collections, node groups or images of ours are left."""
    tags = {names.HULL_TAG, names.EXPLODE_TAG, names.ISOLATE_TAG, names.IMAGE_TAG}
    kinds = ("objects", "collections", "node_groups", "images")
    every = [each for kind in kinds for each in getattr(bpy.data, kind)]
    assert not [each for each in every if tags & set(each.keys())]
