"""Work on a cut mesh beside its geometry: it stays, and untouched meshes come back."""

import bpy
import numpy as np
import pytest
from hand_made import activate, face_values
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.cuts.whole_mesh import (
    edited_since_cut,
    is_cut,
)

FACE_SETS = ".sculpt_face_set"


def cut(seams="CUT", **changes):
    settings = {"samples": 200, "containers": "HOLLOW", "parts": 2, **changes}
    assert bpy.ops.wcd.decompose(seams=seams, **settings) == {"FINISHED"}


def add_keys(obj):
    """Give an object a shape key, keyframed, with a driver on another setting."""
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="smile").keyframe_insert("value", frame=1)
    smile(obj).driver_add("slider_max").driver.expression = "2.0"


def smile(obj):
    return obj.data.shape_keys.key_blocks["smile"]


def draw_face_sets(obj):
    mesh = obj.data
    sets = mesh.attributes.get(FACE_SETS)
    sets = sets or mesh.attributes.new(FACE_SETS, "INT", "FACE")
    values = np.arange(len(mesh.polygons), dtype=np.int32) + 5
    sets.data.foreach_set("value", values)
    return values.tolist()


def keyframe(obj):
    smile(obj).keyframe_insert("value", frame=20)


def keyframe_mesh(obj):
    obj.data.keyframe_insert('["pipeline"]', frame=1)


def drive(obj):
    smile(obj).driver_add("value").driver.expression = "0.5"


def widen_slider(obj):
    smile(obj).slider_min = -1


def mute(obj):
    smile(obj).mute = True


def subdivide(obj):
    obj.modifiers.new("Multires", "MULTIRES")
    bpy.ops.object.multires_subdivide(modifier="Multires", mode="SIMPLE")


def test_an_untouched_cut_mesh_comes_back_with_its_animation(angle):
    add_keys(angle)
    draw_face_sets(angle)
    action = angle.data.shape_keys.animation_data.action
    before, value = snapshot(angle), smile(angle).value
    cut()
    assert not edited_since_cut(angle)
    bpy.ops.wcd.face_sets()
    assert not edited_since_cut(angle)
    smile(angle).value = 0.25
    action.name = "Renamed"
    assert not edited_since_cut(angle)
    smile(angle).value = value
    bpy.ops.wcd.clear()
    assert snapshot(angle) == before
    animation = angle.data.shape_keys.animation_data
    assert animation.action == action
    assert len(animation.drivers) == 1


@pytest.mark.parametrize("work", [keyframe, keyframe_mesh, drive, widen_slider, mute])
def test_work_on_shape_keys_and_animation_is_an_edit(angle, work):
    angle.shape_key_add(name="Basis")
    angle.shape_key_add(name="smile")
    angle.data["pipeline"] = 1.0
    cut()
    n_faces, mesh = len(angle.data.polygons), angle.data
    assert not edited_since_cut(angle)
    work(angle)
    assert edited_since_cut(angle)
    bpy.ops.wcd.clear()
    assert angle.data == mesh
    assert len(mesh.polygons) == n_faces
    assert not is_cut(angle)


def test_a_new_run_keeps_keyframes_that_were_set_on_cut_faces(angle):
    angle.shape_key_add(name="Basis")
    angle.shape_key_add(name="smile")
    cut()
    keyframe(angle)
    action = angle.data.shape_keys.animation_data.action
    cut("KEEP")
    assert angle.data.shape_keys.animation_data.action == action


@pytest.mark.parametrize("over_ours", [False, True])
def test_face_sets_drawn_on_cut_faces_are_an_edit(angle, over_ours):
    cut()
    if over_ours:
        bpy.ops.wcd.face_sets()
        assert not edited_since_cut(angle)
    drawn = draw_face_sets(angle)
    assert edited_since_cut(angle)
    bpy.ops.wcd.clear()
    assert face_values(angle.data, FACE_SETS).tolist() == drawn


def test_faces_under_sculpted_details_are_not_cut(angle):
    angle.modifiers.new("Multires", "MULTIRES")
    cut()  # there are no details yet
    bpy.ops.wcd.clear()
    bpy.ops.object.multires_subdivide(modifier="Multires", mode="SIMPLE")
    with pytest.raises(RuntimeError, match=r"has a Multires .* Keep Faces for Seams"):
        cut()
    cut("KEEP")
    assert not is_cut(angle)


def bind(obj, kind, target):
    """Give an object a modifier that is bound to its vertices, or those of another."""
    activate(obj)
    modifier = obj.modifiers.new("Bound", kind)
    if kind == "SURFACE_DEFORM":
        modifier.target = target
    elif kind == "MESH_DEFORM":
        modifier.object = target
        modifier.precision = 3  # Blender takes ten seconds for the usual 5
    elif kind == "CORRECTIVE_SMOOTH":
        modifier.rest_source = "BIND"
    else:
        obj.vertex_groups.new(name="Anchors").add([0, 3], 1.0, "REPLACE")
        modifier.vertex_group = "Anchors"
    bpy.context.view_layer.update()
    name = kind.lower().replace("_", "")
    assert getattr(bpy.ops.object, f"{name}_bind")(modifier="Bound") == {"FINISHED"}
    bpy.context.view_layer.update()


def bind_to_a_cage(kind):
    def bound(obj):
        bpy.ops.mesh.primitive_cube_add(size=12)
        bind(obj, kind, bpy.context.active_object)

    return bound


def be_a_cage(obj):
    bpy.ops.mesh.primitive_cube_add(size=0.5, location=(2, 0.5, 0.5))
    bind(bpy.context.active_object, "MESH_DEFORM", obj)
    activate(obj)


BOUND = [
    *map(bind_to_a_cage, ["SURFACE_DEFORM", "MESH_DEFORM", "LAPLACIANDEFORM"]),
    bind_to_a_cage("CORRECTIVE_SMOOTH"),
    be_a_cage,
]


@pytest.mark.parametrize("work", BOUND)
def test_faces_that_a_modifier_is_bound_to_are_not_cut(angle, work):
    work(angle)
    with pytest.raises(RuntimeError, match=r"modifier Bound of .* Keep Faces for Seam"):
        cut()
    cut("KEEP")
    assert not is_cut(angle)


@pytest.mark.parametrize("work", BOUND)
def test_a_modifier_that_is_bound_to_cut_faces_keeps_them(angle, work):
    cut()
    mesh = angle.data
    work(angle)
    assert edited_since_cut(angle)
    bpy.ops.wcd.clear()
    assert angle.data == mesh


def test_details_sculpted_on_cut_faces_are_an_edit(angle):
    cut()
    subdivide(angle)
    assert edited_since_cut(angle)
    mesh = angle.data
    bpy.ops.wcd.clear()
    assert angle.data == mesh


def keep_always(obj):
    obj.data.use_fake_user = True


def mark_as_asset(obj):
    obj.data.asset_mark()
    obj.data.asset_data.description = "Mine"


def refer_to_mesh(obj):
    bpy.context.scene["mine"] = obj.data


@pytest.mark.parametrize("tie", [keep_always, mark_as_asset, refer_to_mesh])
@pytest.mark.parametrize("again", ["CUT", "KEEP"])
def test_a_mesh_that_is_not_used_by_objects_alone_comes_back_itself(angle, tie, again):
    tie(angle)
    mesh, n_users = angle.data, angle.data.users
    cut()
    cut(again, parts=3)
    bpy.ops.wcd.clear()
    assert angle.data == mesh
    assert bpy.data.meshes[:] == [mesh]
    assert (mesh.name, mesh.users) == ("L", n_users)


def test_whole_faces_that_another_object_shows_stay_there(angle):
    mesh = angle.data
    cut()
    other = bpy.data.objects.new("Other", mesh)
    bpy.ops.wcd.clear()
    assert other.data == mesh != angle.data
    assert len(angle.data.polygons) == len(mesh.polygons)
