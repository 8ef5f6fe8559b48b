"""Curves are converted once a run, and the mesh that was read gets the parts."""

from collections import Counter

import bpy
import numpy as np
import pytest
from hand_curves import hand_curve
from hand_made import activate
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.operators.bridge.read import (
    carrier,
    converting,
    shape,
)
from weak_convex_decomposition.operators.bridge.read.target import Target

FAST = {"samples": 200, "parts": 2}


@pytest.fixture
def conversions(monkeypatch):
    """Return how often each object was converted."""
    counts, converted = Counter(), converting.converted

    def counted(obj):
        counts[obj.name] += 1
        return converted(obj)

    for module in (carrier, converting):
        monkeypatch.setattr(module, "converted", counted)
    return counts


def test_a_run_converts_each_curve_once(conversions):
    hand = hand_curve()
    other = hand_curve()
    hand.select_set(True)
    bpy.ops.wcd.decompose(**FAST)
    assert conversions == {hand.name: 1, other.name: 1}


def test_the_scale_of_the_curve_is_that_of_the_shape_that_is_read():
    hand = hand_curve()
    hand.scale = (1, 3, 1)
    bpy.context.view_layer.update()
    expected = shape.read_shape(hand)
    found = shape.read_shape(carrier.carrier_for(hand, None))
    assert (found.vertices == expected.vertices).all()
    assert (found.triangles == expected.triangles).all()


@pytest.mark.parametrize("follow", [False, True])
def test_parts_of_a_path_are_where_it_is(follow):
    """Children of a curve follow it, unless somebody says that it is no path."""
    bpy.ops.curve.primitive_bezier_circle_add(location=(-4, 0, 1), rotation=(0.5, 1, 0))
    ring = bpy.context.active_object
    ring.data.bevel_depth, ring.data.use_path_follow = 0.2, follow
    assert ring.data.use_path
    ring.scale = (1, 2, 3)
    bpy.context.view_layer.update()
    bpy.ops.wcd.decompose(**FAST)
    placed = bpy.context.active_object
    for _ in range(2):
        assert placed.parent == ring
        assert np.allclose(placed.matrix_world, ring.matrix_world, atol=1e-6)
        ring.location.x += 1.0  # it takes the parts along
        bpy.context.view_layer.update()


def move_a_point(hand):
    hand.data.splines[0].points[3].co.x += 0.1


def open_the_outline(hand):
    hand.data.splines[0].use_cyclic_u = False


def add_a_modifier(hand):
    hand.modifiers.new("Array", "ARRAY")


@pytest.mark.parametrize("change", [move_a_point, open_the_outline, add_a_modifier])
def test_a_curve_that_changed_meanwhile_is_refused(change):
    hand = hand_curve()
    target = Target.of(hand)
    hand.location.x = 1.0
    bpy.context.view_layer.update()
    assert target.find() == hand
    change(hand)
    bpy.context.view_layer.update()
    with pytest.raises(DecompositionError, match="changed or deleted meanwhile"):
        target.find()


def test_a_carrier_without_parts_is_discarded_alone():
    hand = hand_curve()
    bpy.ops.wcd.decompose(**FAST)
    objects, meshes = bpy.data.objects[:], bpy.data.meshes[:]
    waiting = carrier.carrier_for(hand, None)
    assert carrier.is_waiting(waiting)
    carrier.discard_waiting()
    assert bpy.data.objects[:] == objects
    assert bpy.data.meshes[:] == meshes


def test_a_carrier_that_undo_removed_is_made_again():
    hand = hand_curve()
    carrier.carrier_for(hand, None)
    carrier.discard_waiting()
    placed = carrier.placed_carrier(hand, None)
    assert (placed.name, placed.parent) == ("Hand parts", hand)
    assert placed == bpy.context.active_object


def again(hand, **settings):
    """Decompose a curve once more; return the carrier."""
    hand.hide_set(False)
    activate(hand)
    bpy.ops.wcd.decompose(**FAST, **settings)
    return bpy.context.active_object


def copied(placed, linked):
    """Return a copy of a carrier as Blender makes it, under a name of the user's."""
    activate(placed)
    bpy.ops.object.duplicate(linked=linked)
    bpy.context.active_object.name = "Mine"
    return bpy.context.active_object


@pytest.mark.parametrize("linked", [False, True])
@pytest.mark.parametrize("command", ["decompose", "clear"])
def test_copies_of_a_carrier_are_the_users(command, linked):
    hand = hand_curve()
    placed = again(hand)
    mine = copied(placed, linked)
    if command == "decompose":
        assert again(hand, seed=1) != mine
    else:
        activate(placed)
        bpy.ops.wcd.clear()
    assert {each.name for each in hand.children} >= {"Mine"}
    assert len(hand.children) == (2 if command == "decompose" else 1)
    activate(mine)
    if bpy.ops.wcd.clear.poll():
        bpy.ops.wcd.clear()
    assert bpy.data.objects["Mine"] == mine
    assert not {"wcd_parts_of", "wcd_hidden"} & set(mine.keys())
    assert hand.hide_get() == (command == "decompose")


def test_a_carrier_is_cleared_after_a_copy_that_shares_its_mesh():
    hand = hand_curve()
    placed = again(hand)
    mine = copied(placed, linked=True)
    bpy.ops.wcd.clear()  # it takes the parts off both
    assert not bpy.ops.wcd.clear.poll()
    assert hand.hide_get()
    activate(placed)
    assert "wcd" not in placed
    bpy.ops.wcd.clear()
    assert list(hand.children) == [mine]
    assert not hand.hide_get()


def test_a_copy_stays_the_users_once_the_carrier_is_deleted():
    hand = hand_curve()
    placed = again(hand)
    mine = copied(placed, linked=False)
    bpy.data.objects.remove(placed)
    again(hand)
    assert set(hand.children) == {mine, bpy.context.active_object}


def test_a_renamed_carrier_is_still_replaced():
    hand = hand_curve()
    again(hand).name = "Palm"
    placed = again(hand, seed=1)
    assert list(hand.children) == [placed]
    placed.name = "Palm"
    bpy.ops.wcd.clear()
    assert not hand.children


def test_children_of_a_carrier_keep_it():
    hand = hand_curve()
    placed = again(hand)
    lamp = bpy.data.objects.new("Lamp", None)
    bpy.context.collection.objects.link(lamp)
    lamp.parent = placed
    assert again(hand, seed=1) != placed
    assert lamp.parent == placed
    assert "wcd_parts_of" not in placed


def hulls_on(placed):
    """Build hulls around the parts of a carrier; return the names of its children."""
    activate(placed)
    bpy.ops.wcd.build_hulls(pieces="PARTS", max_error=0.5)
    return {child.name for child in placed.children}


def test_hulls_of_a_carrier_go_with_it():
    hand = hand_curve()
    hand.location.x = 5.0
    assert len(hulls_on(again(hand))) == 2
    bpy.ops.wcd.make_rigid()
    placed = again(hand, seed=1)
    assert set(bpy.data.objects) == {hand, placed}
    assert not bpy.data.collections
    assert bpy.context.scene.rigidbody_world is None
    hulls_on(placed)
    bpy.ops.wcd.clear()
    assert set(bpy.data.objects) == {hand}


def test_hulls_of_a_carrier_that_stays_stay_with_it():
    hand = hand_curve()
    placed = again(hand)
    lamp = bpy.data.objects.new("Lamp", None)
    lamp.parent = placed
    names = hulls_on(placed)
    assert len(names) == 3
    again(hand, seed=1)
    assert {child.name for child in placed.children} == names


def test_what_a_hull_of_a_carrier_holds_keeps_both():
    hand = hand_curve()
    placed = again(hand)
    names = hulls_on(placed)
    lamp = bpy.data.objects.new("Lamp", None)
    lamp.parent = placed.children[0]
    again(hand, seed=1)
    assert {child.name for child in placed.children} == names
    assert lamp.parent in placed.children[:]
