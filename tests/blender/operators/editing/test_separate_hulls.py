"""Hulls go with an object whose parts replace it; errors leave nothing behind."""

import bpy
import pytest
from hand_made import activate, decompose_by_hand, mesh_object
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.bridge.parts import separating

KINDS = ("objects", "meshes", "materials", "collections", "node_groups")


@pytest.fixture
def owner(suzanne):
    """Suzanne with three parts, their hulls and a child of the user's."""
    suzanne.name = suzanne.data.name = "Owner"
    decompose_by_hand(suzanne, 3)
    bpy.ops.wcd.build_hulls(pieces="PARTS", max_error=0.5)
    mesh_object("mine", [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]).parent = suzanne
    activate(suzanne)
    return suzanne


def names():
    """Return the names of all that is in the file."""
    return {
        kind: sorted(each.name for each in getattr(bpy.data, kind)) for kind in KINDS
    }


@pytest.mark.parametrize("rigid", [False, True])
def test_hulls_go_with_the_original(owner, rigid):
    if rigid:
        bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.separate(original="REMOVE")
    pieces = list(bpy.data.collections["Owner parts"].objects)
    assert len(pieces) == 3
    assert {*bpy.data.objects} == {*pieces, bpy.data.objects["mine"]}
    assert bpy.data.objects["mine"].parent in pieces
    assert bpy.context.scene.rigidbody_world is None
    assert "Owner hulls" not in bpy.data.collections
    assert not any("wcd" in key for piece in pieces for key in piece.keys())  # noqa: SIM118


def test_hulls_stay_with_an_original_that_stays(owner):
    bpy.ops.wcd.make_rigid()
    bpy.ops.wcd.separate()
    assert len(hulls_of(owner)) == 3
    assert None not in [each.rigid_body for each in (owner, *hulls_of(owner))]


def test_a_hull_that_the_user_joined_something_to_goes_to_the_largest_part(owner):
    hull = hulls_of(owner)[0]
    activate(hull)
    bpy.data.objects["mine"].select_set(True)
    bpy.ops.object.join()
    activate(owner)
    bpy.ops.wcd.separate(original="REMOVE")
    assert hull.parent in list(bpy.data.collections["Owner parts"].objects)
    assert "wcd_hull" not in hull


def test_a_piece_is_active_where_a_hull_was(owner):
    bpy.context.view_layer.objects.active = hulls_of(owner)[0]
    bpy.ops.wcd.separate(original="REMOVE")
    assert bpy.context.active_object.name == "Owner Part 01"


def test_one_undo_brings_the_hulls_back(owner):
    bpy.ops.wcd.make_rigid()
    bpy.ops.ed.undo_push(message="before")
    before = names()
    bpy.ops.wcd.separate("EXEC_DEFAULT", True, original="REMOVE")
    bpy.ops.ed.undo()
    assert names() == before
    owner = bpy.data.objects["Owner"]
    assert len(hulls_of(owner)) == 3
    assert None not in [each.rigid_body for each in (owner, *hulls_of(owner))]
    bpy.ops.ed.redo()
    assert not [each.name for each in bpy.data.objects if "wcd_hull" in each]


def fail_after(n_calls, function):
    """Return a function that fails after a number of calls."""
    calls = []

    def fail(*given, **named):
        calls.append(given)
        if len(calls) > n_calls:
            raise RuntimeError("stop")
        return function(*given, **named)

    return fail


@pytest.mark.parametrize(
    ("step", "n_calls"),
    [("clear", 0), ("none_missing", 0), ("_keep_faces", 1), ("erase_hulls", 0)],
)
@pytest.mark.parametrize("missing", [False, True])
def test_an_error_leaves_nothing_behind(owner, monkeypatch, step, n_calls, missing):
    if missing:  # so that one is made
        bpy.data.materials.remove(bpy.data.materials["Part 03"])
    before = names()
    broken = fail_after(n_calls, getattr(separating, step))
    monkeypatch.setattr(separating, step, broken)
    with pytest.raises(RuntimeError, match="stop"):
        separating.separate(owner, stays=False)
    assert names() == before
    assert len(hulls_of(owner)) == 3
