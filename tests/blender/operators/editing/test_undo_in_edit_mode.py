"""Undo in Edit Mode takes back what is set on rows, chosen in viewports or noted."""

import bpy
import pytest
from hand_made import decompose_by_hand, in_mode


def state(obj):
    """Return all that rows and the record say of an object."""
    rows = [
        (row.name, row.chosen, row.locked, row.hull_shape, tuple(row.color))
        for row in obj.wcd_parts
    ]
    return rows, obj.wcd_active_part, obj["wcd"], [*obj.vertex_groups.keys()]


def set_on_row(**values):
    def change(obj):
        for name, value in values.items():
            setattr(obj.wcd_parts[2], name, value)

    return change


def highlight(obj):
    obj.wcd_active_part = 3


CHANGES = {
    "tick": set_on_row(chosen=True),
    "lock": set_on_row(locked=True),
    "shape": set_on_row(hull_shape="BOX"),
    "color": set_on_row(color=(1, 0, 0)),
    "name": set_on_row(name="Ear"),
    "highlight": highlight,
    "lock_parts": lambda _: bpy.ops.wcd.lock_parts(),
    "rename_part": lambda _: bpy.ops.wcd.rename_part(name="Ear"),
    "rename_parts": lambda _: bpy.ops.wcd.rename_parts(way="NUMBER", pattern="Ear #"),
    "choose_part": lambda _: bpy.ops.wcd.choose_part(number=2),
    "choose_more": lambda _: bpy.ops.wcd.choose_part(number=2, extend=True),
    "measure": lambda _: bpy.ops.wcd.measure(samples=60),
    "selection": lambda _: bpy.ops.wcd.measure_selection(samples=60),
}


@pytest.mark.parametrize("name", CHANGES)
def test_undo_takes_each_change_back(suzanne, name):
    decompose_by_hand(suzanne, 4)
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.ed.undo_push(message="before")
    before = state(suzanne)
    CHANGES[name](suzanne)
    changed = state(bpy.context.active_object)
    assert changed != before
    bpy.ops.ed.undo_push(message="after")
    bpy.ops.ed.undo()
    assert state(bpy.context.active_object) == before
    bpy.ops.ed.redo()
    assert state(bpy.context.active_object) == changed
