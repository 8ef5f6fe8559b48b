"""Objects whose mesh another object has in Edit Mode are refused in one sentence."""

import bmesh
import bpy
import pytest
from edited import check_in_step
from hand_made import in_mode
from random_work.checks import bone, only
from weak_convex_decomposition.operators.bridge.refusals import refusal
from weak_convex_decomposition.operators.bridge.stored.record import is_rough
from weak_convex_decomposition.operators.running import refine

FAST = {"samples": 40, "containers": "HOLLOW", "max_parts": 4, "parts": 3}
# What needs no mesh, or ends or shows something.
_WITHOUT_MESH = {"choose_part", "tell_quality", "use_preset"}


@pytest.fixture
def twins():
    """Return two objects with one mesh: one in Edit Mode with fewer faces, one not."""
    edited = bone()
    other = edited.copy()
    bpy.context.collection.objects.link(other)
    bpy.ops.wcd.decompose(**FAST)
    only(other)
    bpy.ops.wcd.build_hulls(pieces="PARTS", max_error=0.5)
    only(edited)
    in_mode(edited, "EDIT")
    bm = bmesh.from_edit_mesh(edited.data)
    bmesh.ops.delete(bm, geom=bm.faces[:7], context="FACES")
    bmesh.update_edit_mesh(edited.data)
    only(other)
    assert (edited.mode, other.mode) == ("EDIT", "OBJECT")
    return edited, other


def test_no_operator_works_on_the_other_object(twins):
    _, other = twins
    said = refusal(other)
    assert said == (
        f"The mesh of {other.name} is edited on another object; leave Edit Mode there"
    )
    assert refusal(other, writes_mesh=False) == said
    ready = {name for name in dir(bpy.ops.wcd) if getattr(bpy.ops.wcd, name).poll()}
    assert ready <= _WITHOUT_MESH
    for name in ("decompose", "separate", "measure", "build_hulls", "clear"):
        with pytest.raises(RuntimeError, match="leave Edit Mode there"):
            getattr(bpy.ops.wcd, name)()
    with pytest.raises(RuntimeError, match="leave Edit Mode there"):
        bpy.ops.wcd.choose_part(number=1)


def test_a_first_look_at_the_other_object_waits(twins, monkeypatch):
    _, other = twins
    monkeypatch.setattr(refine, "is_rough", lambda obj: obj == other)
    assert refine.go_on() == refine._RETRY
    assert not is_rough(other)


def test_the_object_in_edit_mode_goes_on_and_so_do_both_afterwards(twins):
    edited, other = twins
    bpy.context.view_layer.objects.active = edited
    assert bpy.ops.wcd.refresh_parts() == {"FINISHED"}
    assert bpy.ops.wcd.decompose(**{**FAST, "parts": 2}) == {"FINISHED"}
    in_mode(edited, "OBJECT")
    check_in_step(edited)
    only(other)
    assert refusal(other) is None
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert not [each.name for each in edited.data.attributes if "wcd" in each.name]
    assert not edited.vertex_groups
