"""Objects with parts and hulls that the user converted to something else."""

import bpy
import pytest
from hand_curves import hand_curve
from hand_made import activate
from random_work.checks import bone

FAST = {"samples": 40, "containers": "HOLLOW", "max_parts": 4, "parts": 3}
_ENUM = bpy.ops.object.convert.get_rna_type().properties["target"].enum_items
TARGETS = [t for t in ("CURVE", "GREASEPENCIL", "POINTCLOUD") if t in _ENUM]


def converted(target):
    """Return an object that was a mesh with parts, hulls, a body and a picture."""
    obj = bone()
    bpy.ops.wcd.decompose(**FAST)
    bpy.ops.wcd.build_hulls(pieces="PARTS", max_error=0.5)
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.show_picture()
    bpy.ops.wcd.explode()  # curves are made of edges with one face
    activate(obj)
    bpy.ops.object.convert(target=target)
    assert (obj.type, len(obj.children)) == (target, 3)
    return obj


def left_on(obj):
    """Return the names under which an object has something of ours."""
    return {key for key in obj.keys() if key.startswith("wcd")}  # noqa: SIM118


def strokes(obj):
    """Return the points of a curve, and None of another type."""
    if obj.type != "CURVE":
        return None
    return [[tuple(p.co) for p in spline.points] for spline in obj.data.splines]


@pytest.mark.parametrize("target", TARGETS)
def test_clear_takes_what_is_left_and_leaves_the_curve(target):
    obj = converted(target)
    data, before = obj.data, strokes(obj)
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert bpy.data.objects[:] == [obj]
    assert (obj.type, obj.data, strokes(obj)) == (target, data, before)
    assert not left_on(obj)
    assert not obj.wcd_parts
    assert not bpy.data.images
    assert not bpy.data.collections
    assert bpy.context.scene.rigidbody_world is None
    assert not bpy.ops.wcd.clear.poll()


@pytest.mark.parametrize("target", TARGETS)
def test_hulls_are_removed_and_the_record_of_parts_stays(target):
    obj = converted(target)
    before = strokes(obj)
    assert bpy.ops.wcd.remove_hulls() == {"FINISHED"}
    assert bpy.data.objects[:] == [obj]
    assert strokes(obj) == before
    assert '"hulls"' not in obj["wcd"]
    assert not bpy.ops.wcd.remove_hulls.poll()
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert not left_on(obj)


def test_a_converted_object_is_cleared_in_object_mode_only():
    obj = converted("CURVE")
    bpy.ops.object.mode_set(mode="EDIT")
    for command in (bpy.ops.wcd.clear, bpy.ops.wcd.remove_hulls):
        with pytest.raises(RuntimeError, match="switch to Object Mode"):
            command()
    assert len(obj.children) == 3


def test_a_curve_of_the_users_is_still_no_mesh():
    hand = hand_curve()
    hand["wcd"] = "the user's"
    for command in (bpy.ops.wcd.clear, bpy.ops.wcd.remove_hulls):
        with pytest.raises(RuntimeError, match="is not a mesh"):
            command()


@pytest.mark.parametrize("command", ["clear", "decompose"])
def test_the_parts_of_a_curve_that_became_a_curve_are_the_users(command):
    hand = hand_curve()
    bpy.ops.wcd.decompose(samples=200, parts=2)
    mine = bpy.context.active_object
    bpy.ops.object.convert(target="CURVE")
    if command == "decompose":
        hand.hide_set(False)
        activate(hand)
        bpy.ops.wcd.decompose(samples=200, parts=2)
        assert bpy.context.active_object not in (hand, mine)
    else:
        bpy.ops.wcd.clear()
        assert not left_on(mine)
        assert not hand.hide_get()
    assert mine.type == "CURVE"
    assert mine.name in bpy.data.objects
    assert "wcd_parts_of" not in mine


def test_hulls_of_a_mesh_that_lost_its_faces_can_be_removed(suzanne):
    bpy.ops.wcd.build_hulls(max_hulls=1, max_error=1.0)
    suzanne.data.clear_geometry()
    assert bpy.ops.wcd.remove_hulls() == {"FINISHED"}
    assert bpy.data.objects[:] == [suzanne]
