"""What the operators do when several objects are selected."""

import bpy
import pytest
from edited import record_of
from hand_made import activate, mesh_object
from snapshot import snapshot
from weak_convex_decomposition.operators import hulls
from weak_convex_decomposition.operators.bridge.hulls import lost_hulls
from weak_convex_decomposition.operators.decompose import WCD_OT_decompose

FAST = {"samples": 300}
# What looks at all hulls of a file for an operator.
_LOOKS = {
    "clear": (lost_hulls, "lost_hulls"),
    "make_rigid": (hulls, "owners_of_hulls"),
}


def add(x=0.0):
    bpy.ops.mesh.primitive_cube_add(location=(x, 0, 0))
    return bpy.context.active_object


def select(active, *others):
    activate(active)
    for obj in others:
        obj.select_set(True)


def decomposed(obj):
    return "wcd" in obj and "wcd_part" in obj.data.attributes


def test_all_selected_objects_are_decomposed_and_no_other():
    first, second, other = add(0), add(5), add(10)
    select(first, second)
    before = snapshot(other)["mesh"]
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    assert decomposed(first)
    assert decomposed(second)
    assert not decomposed(other)
    assert snapshot(other)["mesh"] == before
    assert "measured" not in record_of(second)
    bpy.ops.wcd.measure(**FAST)
    assert all("measured" in record_of(obj) for obj in (first, second))
    bpy.ops.wcd.clear()
    assert not decomposed(first)
    assert not decomposed(second)


@pytest.mark.parametrize(("n_bad", "named"), [(2, "Bad 0, Bad 1"), (6, "and others")])
def test_one_warning_names_all_that_failed(capfd, n_bad, named):
    bad = [mesh_object(f"Bad {n}", [(0, 0, 0)] * 3, [(0, 1, 2)]) for n in range(n_bad)]
    good = add(0)
    select(good, *bad)
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    said = capfd.readouterr().out
    assert said.count("Warning: Bad") == n_bad
    assert f"{n_bad} of {n_bad + 1} objects failed: Bad 0" in said.splitlines()[-1]
    assert named in said.splitlines()[-1]
    assert decomposed(good)


def test_without_a_window_the_active_object_is_worked_on(suzanne):
    other = add(5)
    select(suzanne, other)
    with bpy.context.temp_override(window=None):
        bpy.ops.wcd.decompose(parts=2, **FAST)
        bpy.ops.wcd.build_hulls(pieces="PARTS")
        bpy.ops.wcd.explode()
        bpy.ops.wcd.separate()
    hulls_and_pieces = set(bpy.data.objects) - {suzanne, other}
    assert len(hulls_and_pieces) == 2 + 2
    assert not decomposed(other)


def test_an_active_object_that_is_not_selected_is_left_alone():
    first, second = add(0), add(5)
    activate(second)
    bpy.context.view_layer.objects.active = first
    bpy.ops.wcd.decompose(**FAST)
    assert not decomposed(first)
    assert decomposed(second)


def test_no_other_object_is_decomposed_in_place_of_one_in_sculpt_mode():
    first, second = add(0), add(5)
    select(first, second)
    bpy.ops.object.mode_set(mode="SCULPT")
    assert second.select_get()
    with pytest.raises(RuntimeError, match="Object or Edit Mode"):
        bpy.ops.wcd.decompose(**FAST)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not decomposed(second)


def test_the_active_object_is_done_where_nothing_is_selected():
    cube = add()
    cube.select_set(False)
    bpy.ops.wcd.decompose(**FAST)
    assert decomposed(cube)


def test_what_cannot_be_worked_on_is_left_out():
    cube = add()
    bpy.ops.object.light_add()
    cube.select_set(True)  # the light is active
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    assert decomposed(cube)


def test_an_object_that_fails_does_not_stop_the_others():
    cube = add()
    flat = mesh_object("Point", [(0, 0, 0)] * 3, [(0, 1, 2)])
    before = snapshot(flat)["mesh"]
    select(flat, cube)
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    assert decomposed(cube)
    assert snapshot(flat)["mesh"] == before
    activate(flat)
    with pytest.raises(RuntimeError, match="have no area"):
        bpy.ops.wcd.decompose(**FAST)


def test_objects_that_share_a_mesh_get_one_decomposition():
    cube = add()
    twin = cube.copy()
    bpy.context.collection.objects.link(twin)
    select(twin, cube)
    bpy.ops.wcd.decompose(**FAST)
    assert twin["wcd"] == cube["wcd"]
    assert [row.name for row in twin.wcd_parts] == [row.name for row in cube.wcd_parts]


def test_parts_of_a_shared_mesh_are_found_for_the_active_object():
    cube = add()
    twin = cube.copy()
    bpy.context.collection.objects.link(twin)
    for active, other in ((cube, twin), (twin, cube)):
        select(active, other)
        assert WCD_OT_decompose._chosen(bpy.context) == [active]


def test_several_meshes_are_edited_at_once():
    first, second, resting = add(0), add(5), add(10)
    select(first, second)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.wcd.decompose(**FAST)
    assert first.mode == second.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    assert decomposed(first)
    assert decomposed(second)
    assert not decomposed(resting)


def test_several_objects_are_one_undo_step():
    first, second = add(0), add(5)
    select(first, second)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.wcd.decompose("EXEC_DEFAULT", True, **FAST)
    bpy.ops.ed.undo()
    assert not any(decomposed(obj) for obj in bpy.data.objects)
    bpy.ops.ed.redo()
    assert all(decomposed(obj) for obj in bpy.data.objects)


def test_hulls_go_around_every_selected_object():
    first, second = add(0), add(5)
    select(first, second)
    bpy.ops.wcd.build_hulls()
    assert all(len(obj.children) == 1 for obj in (first, second))


def test_buttons_look_no_further_than_to_the_first_that_can_be_worked_on(monkeypatch):
    objects, asked = [add(x) for x in range(9)], []
    select(*objects)
    refuses_none = staticmethod(asked.append)
    monkeypatch.setattr(WCD_OT_decompose, "_refusal", refuses_none)
    assert bpy.ops.wcd.decompose.poll()
    assert asked == [objects[0]]


@pytest.mark.parametrize("name", ["clear", "make_rigid"])
def test_hulls_are_looked_for_once_for_all_objects(monkeypatch, name):
    select(*(add(x) for x in range(9)))
    bpy.ops.wcd.build_hulls(shape="BOX", max_hulls=1, max_error=1.0)
    select(*(add(x) for x in range(20, 29)))
    looks, home = [], _LOOKS[name]
    find = getattr(*home)
    monkeypatch.setattr(*home, lambda: looks.append(name) or find())
    assert not getattr(bpy.ops.wcd, name).poll()
    assert looks == [name]


def test_hulls_that_are_selected_with_their_object_go_with_it():
    """As they are to be exported."""
    first, second = add(0), add(5)
    select(first, second)
    bpy.ops.wcd.build_hulls()
    for build in (bpy.ops.wcd.build_hulls, bpy.ops.wcd.decompose, bpy.ops.wcd.measure):
        bpy.ops.object.select_all(action="SELECT")
        assert build() == {"FINISHED"}
        hulls_there = [obj for obj in bpy.data.objects if obj not in (first, second)]
        assert {hull.parent for hull in hulls_there} == {first, second}
        assert not any("wcd" in hull for hull in hulls_there)
    bpy.ops.object.select_all(action="SELECT")
    assert bpy.ops.wcd.clear() == {"FINISHED"}
    assert bpy.data.objects[:] == [first, second]
    assert not decomposed(second)
