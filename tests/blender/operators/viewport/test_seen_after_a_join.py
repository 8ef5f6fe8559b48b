"""What viewports show of joined objects before Refresh: names, colors and parts."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from edited import check_in_step
from hand_made import activate, centers, decompose_by_hand, in_mode
from snapshot import snapshot
from stand_ins.presses import seen, space_of_window
from weak_convex_decomposition.operators.bridge.parts.read import part_identities
from weak_convex_decomposition.operators.running import joins
from weak_convex_decomposition.operators.viewport import picking
from weak_convex_decomposition.operators.viewport.shown_parts import (
    shown_identities,
    shown_parts,
)
from weak_convex_decomposition.ui import part_drawing

NAMES = ["Head", "Ears", "Left", "Right"]
WAYS = ["MATERIALS", "OVERLAY", "COPIES"]


def named(obj, names, colors="MATERIALS"):
    """Give an object two parts with these names."""
    decompose_by_hand(obj, 2)
    bpy.ops.wcd.show_colors(colors=colors)
    for row, name in zip(obj.wcd_parts, names, strict=True):
        row.name = name


def join(suzanne, way="MATERIALS"):
    """Join a second monkey, at x = 4, to one with parts; return all by their names."""
    colors = "OVERLAY" if way == "OVERLAY" else "MATERIALS"
    named(suzanne, NAMES[:2], colors)
    if way == "COPIES":
        activate(suzanne)
        bpy.ops.object.duplicate()
    else:
        bpy.ops.mesh.primitive_monkey_add()
        named(bpy.context.active_object, NAMES[2:], colors)
    other = bpy.context.active_object
    other.location.x = 4
    activate(suzanne)
    other.select_set(True)
    bpy.ops.object.join()
    numbers = {each.name: each.number for each in part_identities(suzanne)}
    assert len(numbers) == 4
    return numbers


def hovered(x):
    """Return the name of the part at x."""
    obj, number = seen(x, 0.25)
    return shown_identities(obj)[number].name


PLACES = [-0.5, 0.5, 3.5, 4.5]


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("way", WAYS)
def test_the_part_under_the_cursor_has_its_own_name(window, suzanne, way, mode):
    names = list(join(suzanne, way))
    in_mode(suzanne, mode)
    assert [hovered(x) for x in PLACES] == names
    if way != "COPIES":
        assert names == NAMES


@pytest.mark.parametrize("kind", ["SUBSURF", "ARRAY", "TRIANGULATE"])
@pytest.mark.parametrize("way", WAYS[:2])
def test_modifiers_take_joined_parts_along(window, suzanne, way, kind):
    join(suzanne, way)
    suzanne.modifiers.new("Any", kind)
    assert [hovered(x) for x in PLACES] == NAMES


def test_colors_are_those_of_now(suzanne):
    join(suzanne)
    shown = shown_parts(suzanne)
    suzanne.material_slots[0].material.diffuse_color = (0.25, 0.5, 0.75, 1.0)
    bpy.context.view_layer.update()
    head, *_ = shown_identities(suzanne).values()
    assert head.color == (0.25, 0.5, 0.75)
    assert shown_parts(suzanne) is shown  # the faces are not read again


@pytest.mark.parametrize("way", WAYS)
def test_colors_and_borders_are_of_the_parts(window, suzanne, monkeypatch, way):
    join(suzanne, way)
    bpy.context.view_layer.update()
    drawn, shown = {}, shown_parts(suzanne)
    monkeypatch.setattr(part_drawing, "is_overlaid", lambda _: True)
    monkeypatch.setattr(
        part_drawing,
        "_fill",
        lambda obj, shown, number, color, _: drawn.update(
            {color[:3]: shown.triangles_of(number)}
        ),
    )
    context = SimpleNamespace(space_data=space_of_window())
    part_drawing._draw_colors(context, [suzanne])
    wanted = [part_drawing.srgb_of(each.color) for each in part_identities(suzanne)]
    assert sorted(drawn) == sorted(wanted)
    for color, middle in zip(wanted, (-1, 1, 3, 5), strict=True):
        assert abs(drawn[color][:, 0].mean() - middle) < 0.6
    for number in shown_identities(suzanne):
        x = shown.border_of(number)[:, 0]
        assert len(x)
        assert np.ptp(x) < 2.8  # of one of the monkeys


@pytest.mark.parametrize("way", WAYS)
def test_a_part_is_isolated_alone(suzanne, monkeypatch, way):
    monkeypatch.setattr(joins, "_start", list)  # the operator does it in its undo step
    join(suzanne, way)
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(suzanne)
    bpy.ops.wcd.isolate_parts("EXEC_DEFAULT", True)
    bpy.context.view_layer.update()
    x = centers(suzanne)[:, 0]
    assert len(x) == 250
    assert x.max() < 0.1
    check_in_step(suzanne)
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


def test_parts_that_were_isolated_stay_alone(suzanne):
    named(suzanne, NAMES[:2])
    bpy.ops.wcd.isolate_parts()
    join(suzanne)
    bpy.context.view_layer.update()
    assert len(centers(suzanne)) == 250


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("way", WAYS[:2])
def test_a_click_chooses_a_joined_part(viewport, suzanne, way, mode):
    numbers = join(suzanne, way)
    bpy.data.orphans_purge()  # as by a reload: their materials are used again
    in_mode(suzanne, mode)
    bpy.ops.ed.undo_push(message="before")
    before = suzanne["wcd"], len(suzanne.wcd_parts)
    viewport.hover(suzanne, numbers["Right"])
    assert picking.current.part().name == "Right"
    assert viewport.header == "Pick Parts  |  Right  |  Suzanne: 4 Parts"
    assert (suzanne["wcd"], len(suzanne.wcd_parts)) == before  # by hovering
    viewport.event("LEFTMOUSE")
    assert suzanne.wcd_parts[suzanne.wcd_active_part].name == "Right"
    check_in_step(suzanne)
    bpy.ops.ed.undo()
    suzanne = bpy.context.active_object
    assert (suzanne["wcd"], len(suzanne.wcd_parts)) == before
    assert picking.current.part().name == "Right"


def test_a_joined_part_is_merged_into_the_chosen_one(viewport, suzanne):
    numbers = join(suzanne)
    viewport.hover(suzanne, numbers["Ears"])
    viewport.event("LEFTMOUSE")
    bpy.ops.wcd.merge_next()
    viewport.hover(suzanne, numbers["Left"])
    viewport.event("LEFTMOUSE")
    assert {row.name for row in suzanne.wcd_parts} == {"Head", "Ears", "Right"}
    assert suzanne.wcd_parts[suzanne.wcd_active_part].name == "Ears"
    check_in_step(suzanne)
