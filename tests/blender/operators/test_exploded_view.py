"""Exploded views of parts."""

import bpy
import numpy as np
import pytest
from edited import check_in_step, record_of
from hand_made import (
    activate,
    centers,
    decompose_by_hand,
    in_mode,
    moved_apart,
)
from snapshot import snapshot
from stand_ins.layout import drawn
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.stored.record import (
    EVALUATED,
    note_mesh,
    noted_mesh,
)
from weak_convex_decomposition.operators.bridge.views.exploding import (
    explode,
    exploding,
    slider,
)
from weak_convex_decomposition.operators.running import joins
from weak_convex_decomposition.ui.use_panel import WCD_PT_use


def call(name, **options):
    return getattr(bpy.ops.wcd, name)(**options)


def test_parts_move_away_from_the_center_together(suzanne):
    labels = decompose_by_hand(suzanne, 4)
    before = snapshot(suzanne)["mesh"]
    for distance in (0.0, 0.7):
        assert call("explode", distance=distance) == {"FINISHED"}
        expected = moved_apart(suzanne.data, labels, distance)
        assert centers(suzanne) == pytest.approx(expected, abs=1e-5)
    assert len(suzanne.modifiers) == len(bpy.data.node_groups) == 1
    assert snapshot(suzanne)["mesh"] == before
    owner, path = slider(exploding(suzanne))
    assert owner.path_resolve(path) == pytest.approx(0.7)


def test_a_distance_that_is_no_number_is_refused(suzanne):
    decompose_by_hand(suzanne, 4)
    with pytest.raises(RuntimeError, match="Distance must be a number, not"):
        call("explode", distance=float("nan"))
    assert not suzanne.modifiers


def test_exploded_views_end(suzanne):
    decompose_by_hand(suzanne, 4)
    before = snapshot(suzanne)
    with pytest.raises(RuntimeError, match="There is no exploded view; press Exploded"):
        bpy.ops.wcd.implode()
    call("explode")
    assert bpy.ops.wcd.implode() == {"FINISHED"}
    assert snapshot(suzanne) == before
    assert not bpy.data.node_groups


def test_a_view_without_its_distance_gets_it_again(suzanne):
    labels = decompose_by_hand(suzanne, 4)
    call("explode")
    sockets = bpy.data.node_groups[0].interface
    inside = sockets.new_panel("Panel")
    sockets.move_to_parent(sockets.items_tree["Distance"], inside, 0)
    assert exploding(suzanne)
    sockets.remove(sockets.items_tree["Distance"])
    assert "Exploded View" in drawn(WCD_PT_use).texts()
    call("explode", distance=0.7)
    assert len(suzanne.modifiers) == 1
    expected = moved_apart(suzanne.data, labels, 0.7)
    assert centers(suzanne) == pytest.approx(expected, abs=1e-5)
    assert bpy.ops.wcd.implode() == {"FINISHED"}
    assert not suzanne.modifiers


@pytest.mark.parametrize("how", ["clear", "implode", "explode"])
def test_a_view_whose_node_group_is_gone_ends_or_gets_another(suzanne, how):
    decompose_by_hand(suzanne, 4)
    suzanne.modifiers.new("Mine", "NODES")  # without a group
    call("explode")
    call("isolate_parts")
    for group in bpy.data.node_groups[:]:
        bpy.data.node_groups.remove(group)
    assert "Exploded View" in drawn(WCD_PT_use).texts()
    assert call(how) == {"FINISHED"}
    assert (exploding(suzanne) is not None) == (how == "explode")
    if how != "clear":
        call("clear")
    assert [each.name for each in suzanne.modifiers] == ["Mine"]


def torus_beside(suzanne, colors="MATERIALS"):
    """Select a torus beside the monkey, both with parts; return those of both."""
    labels = decompose_by_hand(suzanne, 3)
    call("show_colors", colors=colors)
    bpy.ops.mesh.primitive_torus_add(location=(4, 0, 0))
    torus = bpy.context.active_object
    labels = np.append(labels, 3 + decompose_by_hand(torus, 2))
    call("show_colors", colors=colors)
    activate(suzanne)
    torus.select_set(True)
    return labels


def test_a_view_after_a_join_moves_each_part_by_itself(suzanne, monkeypatch):
    monkeypatch.setattr(joins, "_start", list)  # the operator does it in its undo step
    labels = torus_beside(suzanne)
    note_mesh(suzanne, EVALUATED)
    bpy.ops.object.join()
    call("explode", distance=0.7)
    assert noted_mesh(suzanne) == EVALUATED
    expected = moved_apart(suzanne.data, labels, 0.7)
    assert centers(suzanne) == pytest.approx(expected, abs=1e-5)
    check_in_step(suzanne)
    assert "measure" in figures_of(suzanne).problem


@pytest.mark.parametrize("colors", ["MATERIALS", "OVERLAY"])
def test_a_view_from_before_a_join_moves_each_part_by_itself(suzanne, colors):
    labels = torus_beside(suzanne, colors)
    explode(suzanne, 0.7)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.object.join("EXEC_DEFAULT", True)
    for step in (None, bpy.ops.ed.undo, bpy.ops.ed.redo):
        if step is not None:
            step()
        suzanne = bpy.data.objects["Suzanne"]
        own = labels[: len(suzanne.data.polygons)]
        expected = moved_apart(suzanne.data, own, 0.7)
        assert centers(suzanne) == pytest.approx(expected, abs=1e-5), step
    assert len(labels) > 500 == len(labels) - 576


def test_an_exploded_view_does_not_count_as_a_modifier(suzanne):
    bpy.ops.wcd.decompose(samples=300)
    call("explode")
    bpy.ops.wcd.decompose(samples=300)
    assert record_of(suzanne)["notes"] == []
    assert exploding(suzanne)


def test_an_exploded_view_is_not_cleared_in_edit_mode(suzanne):
    decompose_by_hand(suzanne, 3)
    call("explode")
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch to Object Mode first"):
        bpy.ops.wcd.clear()


def test_clear_removes_the_view_of_an_object_that_was_joined(suzanne):
    bpy.ops.object.duplicate()
    other = bpy.context.active_object
    decompose_by_hand(other, 4)
    call("explode")
    activate(suzanne)
    other.select_set(True)
    bpy.ops.object.join()
    assert [group.users for group in bpy.data.node_groups] == [0]
    call("clear")
    assert not bpy.data.node_groups
