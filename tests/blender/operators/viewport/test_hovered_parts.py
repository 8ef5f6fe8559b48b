"""Where the part under the cursor is drawn, and how its object is found again."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from hand_made import decompose_by_hand
from stand_ins.presses import cube_at, space_of_window
from weak_convex_decomposition.operators.bridge.read.target import object_with
from weak_convex_decomposition.operators.viewport import picking
from weak_convex_decomposition.operators.viewport.shown_parts import shown_parts
from weak_convex_decomposition.ui import part_drawing


class Drawn(list):
    """Keeps the parts that are drawn under the cursor, in place of drawing them."""

    def __init__(self, monkeypatch):
        monkeypatch.setattr(part_drawing, "_outline", self.outline)
        monkeypatch.setattr(part_drawing, "_fill", lambda *_: None)

    def outline(self, obj, shown, number, color, width):
        self.append((obj.name, number))


def test_a_part_is_lit_up_in_viewports_that_show_its_object(window, monkeypatch):
    cube = cube_at(0)
    decompose_by_hand(cube, 3)
    drawn, context = Drawn(monkeypatch), SimpleNamespace(space_data=space_of_window())
    picked = picking.Picking("Layout", 1, hovered=(cube.session_uid, 2))
    monkeypatch.setattr(picking, "current", picked)
    part_drawing._draw_hovered(context)
    assert drawn == [("Cube", 2)]
    bpy.context.collection.objects.unlink(cube)  # as in another view layer
    part_drawing._draw_hovered(context)
    bpy.context.collection.objects.link(cube)
    cube.hide_viewport = True
    part_drawing._draw_hovered(context)
    assert drawn == [("Cube", 2)]


def test_the_name_is_in_the_window_with_the_cursor_alone(window, monkeypatch):
    cube, named = cube_at(0), []
    decompose_by_hand(cube, 3)
    picked = picking.Picking("Layout", 1, hovered=(cube.session_uid, 2), place=(5, 5))
    monkeypatch.setattr(picking, "current", picked)
    blf = SimpleNamespace(
        size=lambda *_: None,
        dimensions=lambda *_: (9, 9),
        color=lambda *_: None,
        position=lambda *_: None,
        draw=lambda _, text: named.append(text),
    )
    monkeypatch.setattr(part_drawing, "blf", blf)
    monkeypatch.setattr(part_drawing, "_rectangle", lambda *_: None)
    region = SimpleNamespace(x=0, y=0, width=99, height=99)
    for address in (1, 2):
        context = SimpleNamespace(
            region=region,
            window=SimpleNamespace(as_pointer=lambda address=address: address),
            preferences=bpy.context.preferences,
        )
        monkeypatch.setattr(part_drawing, "bpy", SimpleNamespace(context=context))
        part_drawing.draw_name()
    assert named == ["Part 03"]


def test_an_object_is_found_again_also_by_another_name(window):
    first, second = cube_at(0), cube_at(5)
    uid, name = first.session_uid, first.name
    assert object_with(uid) == object_with(uid, name) == first
    first.name, second.name = "Moved", name
    assert object_with(uid, name) == first
    bpy.data.objects.remove(first)
    assert object_with(uid, name) is None


def turn_by_modifier(obj):
    turn = obj.modifiers.new("Turn", "SIMPLE_DEFORM")
    return turn, "angle"


def grow_by_key(obj):
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Large")
    for point in key.data:
        point.co *= 2.0
    return key, "value"


@pytest.mark.parametrize("move", [turn_by_modifier, grow_by_key])
def test_parts_are_drawn_where_animation_moves_them(window, move):
    cube = cube_at(0)
    decompose_by_hand(cube, 3)
    owner, path = move(cube)
    for frame in (1, 9):
        setattr(owner, path, (frame - 1) / 8)
        owner.keyframe_insert(path, frame=frame)
    bpy.context.scene.frame_set(1)
    before = shown_parts(cube)
    bpy.context.scene.frame_set(9)
    after = shown_parts(cube)
    assert np.abs(before.corners).max() == pytest.approx(1.0)
    assert np.abs(after.corners).max() > 1.1
    assert shown_parts(cube) is after  # it is read once a frame
