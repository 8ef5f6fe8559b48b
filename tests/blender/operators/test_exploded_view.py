"""Exploded views of parts."""

import json

import bpy
import numpy as np
import pytest
from hand_made import (
    activate,
    areas,
    centers,
    decompose_by_hand,
    in_mode,
)
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.views.exploding import (
    exploding,
    slider,
)


def call(name, **options):
    return getattr(bpy.ops.wcd, name)(**options)


def test_parts_move_away_from_the_center_together(suzanne):
    labels = decompose_by_hand(suzanne, 4)
    before = snapshot(suzanne)["mesh"]
    there = centers(suzanne)
    weights = areas(suzanne.data)
    middle = np.average(there, axis=0, weights=weights)
    for distance in (0.0, 0.7):
        assert call("explode", distance=distance) == {"FINISHED"}
        moved = centers(suzanne) - there
        for part in range(4):
            mine = labels == part
            own = np.average(there[mine], axis=0, weights=weights[mine])
            expected = distance * (own - middle)
            assert moved[mine] == pytest.approx(
                np.tile(expected, (mine.sum(), 1)), abs=1e-5
            )
    assert len(suzanne.modifiers) == len(bpy.data.node_groups) == 1
    assert snapshot(suzanne)["mesh"] == before
    owner, path = slider(exploding(suzanne))
    assert owner.path_resolve(path) == pytest.approx(0.7)


def test_exploded_views_end(suzanne):
    decompose_by_hand(suzanne, 4)
    before = snapshot(suzanne)
    assert not bpy.ops.wcd.implode.poll()
    call("explode")
    assert bpy.ops.wcd.implode() == {"FINISHED"}
    assert snapshot(suzanne) == before
    assert not bpy.data.node_groups


def test_an_exploded_view_does_not_count_as_a_modifier(suzanne):
    bpy.ops.wcd.decompose(samples=300)
    call("explode")
    bpy.ops.wcd.decompose(samples=300)
    assert json.loads(suzanne["wcd"])["notes"] == []
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
