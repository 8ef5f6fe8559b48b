"""Parts isolated in Object Mode: other faces are left out, and come back."""

import bpy
import numpy as np
import pytest
from hand_made import centers, decompose_by_hand, give_user_data, in_mode
from snapshot import snapshot
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.views.isolating import (
    end_isolation,
    isolate,
    isolating,
)


@pytest.fixture
def labels(suzanne):
    """Four bands along x, two of them ticked."""
    give_user_data(suzanne)
    labels = decompose_by_hand(suzanne, 4)
    suzanne.wcd_parts[1].chosen = suzanne.wcd_parts[3].chosen = True
    return labels


def faces_shown(obj):
    bpy.context.view_layer.update()
    return len(centers(obj))


def test_chosen_parts_are_shown_alone_and_all_again(suzanne, labels):
    before = snapshot(suzanne)
    assert bpy.ops.wcd.isolate_parts() == {"FINISHED"}
    assert snapshot(suzanne)["mesh"] == before["mesh"]
    assert faces_shown(suzanne) == np.isin(labels, [1, 3]).sum()
    bpy.ops.wcd.isolate_parts()
    assert len(suzanne.modifiers) == len(bpy.data.node_groups) == 1
    assert bpy.ops.wcd.isolate_parts(hide=False) == {"FINISHED"}
    assert snapshot(suzanne) == before
    assert not bpy.data.node_groups


def test_isolation_follows_the_parts_and_spares_renders(suzanne, labels):
    bpy.ops.wcd.isolate_parts()
    assert not isolating(suzanne).show_render
    bpy.ops.wcd.merge_parts()
    assert faces_shown(suzanne) == np.isin(labels, [1, 3]).sum()
    bpy.ops.wcd.explode()
    assert faces_shown(suzanne) == np.isin(labels, [1, 3]).sum()


def test_isolation_is_one_undo_step(suzanne, labels):
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(suzanne)
    bpy.ops.wcd.isolate_parts("EXEC_DEFAULT", True)
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


def test_isolation_is_no_modifier_of_the_shape_and_clear_ends_it(suzanne):
    before = snapshot(suzanne)
    bpy.ops.wcd.decompose(samples=100, parts=3)
    bpy.ops.wcd.isolate_parts()
    bpy.ops.wcd.decompose(samples=100, parts=4)
    assert "modifiers" not in suzanne["wcd"]
    bpy.ops.wcd.separate()
    pieces = [o for o in bpy.data.objects if o != suzanne]
    assert len(pieces) == 4
    assert not any(piece.modifiers for piece in pieces)
    for piece in pieces:
        bpy.data.meshes.remove(piece.data)
    suzanne.hide_set(False)
    bpy.context.view_layer.objects.active = suzanne
    suzanne.select_set(True)
    bpy.ops.wcd.clear()
    assert snapshot(suzanne)["mesh"] == before["mesh"]
    assert not suzanne.modifiers
    assert not bpy.data.node_groups


def test_all_is_shown_once_no_isolated_part_is_left(suzanne, labels):
    bpy.ops.wcd.isolate_parts()
    decompose_by_hand(suzanne, 1)
    assert [row.number for row in suzanne.wcd_parts] == [0]
    assert faces_shown(suzanne) == len(labels)
    labels = decompose_by_hand(suzanne, 3)
    assert faces_shown(suzanne) == (labels == 1).sum()


def test_clear_ends_the_isolation_on_all_objects_that_share_the_mesh(suzanne, labels):
    twin = suzanne.copy()
    bpy.context.collection.objects.link(twin)
    bpy.context.view_layer.objects.active = twin
    bpy.ops.wcd.isolate_parts()
    bpy.ops.wcd.explode()
    bpy.context.view_layer.objects.active = suzanne
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch to Object Mode first"):
        bpy.ops.wcd.clear()
    assert suzanne.wcd_parts
    assert len(twin.modifiers) == 2
    in_mode(suzanne, "OBJECT")
    bpy.ops.wcd.clear()
    assert not twin.modifiers
    assert not bpy.data.node_groups


def test_edit_mode_cannot_take_the_modifier_back(suzanne, labels):
    bpy.ops.wcd.isolate_parts()
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts(hide=False)  # the faces that Edit Mode hides
    assert isolating(suzanne)
    with pytest.raises(RuntimeError, match="switch to Object Mode first"):
        bpy.ops.wcd.clear()


@pytest.mark.parametrize("name", ["isolate_parts", "explode"])
def test_faces_without_their_parts_are_told(suzanne, labels, name):
    suzanne.data.attributes.remove(suzanne.data.attributes["wcd_part"])
    with pytest.raises(RuntimeError, match="has lost its parts; decompose it again"):
        getattr(bpy.ops.wcd, name)()
    assert not suzanne.modifiers


def test_a_mesh_in_edit_mode_on_another_object_cannot_take_it_back(suzanne, labels):
    twin = suzanne.copy()
    bpy.context.collection.objects.link(twin)
    isolate(twin, [0])
    twin.select_set(False)
    in_mode(suzanne, "EDIT")
    assert twin.mode == "OBJECT"
    with pytest.raises(DecompositionError, match="switch to Object Mode first"):
        end_isolation(twin)
    assert isolating(twin)
