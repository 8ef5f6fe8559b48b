"""Parts ticked in the table, merged and split by the buttons, each undone by Ctrl+Z."""

import json

import bpy
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.running import modal as running

# Where a row of the table has its box to tick, in shares of the sidebar's width.
_TICK = 0.11


def names():
    record = json.loads(bpy.context.active_object["wcd"])
    return [part["name"] for part in record["parts"]]


def edited(hands, button, expected, columns):
    """Click a button, look at the parts, and undo the click."""
    before, had = snapshot(bpy.context.active_object), names()
    place = yield from hands.find(button, columns)
    yield from hands.click(place)
    yield lambda: names() != had
    yield lambda: running.current is None
    obj, after = bpy.context.active_object, names()
    assert len(after) == expected
    assert [row.name for row in obj.wcd_parts] == after
    assert {group.name for group in obj.vertex_groups} == set(after)
    assert snapshot(obj)["mesh"]["vertices"] == before["mesh"]["vertices"]
    assert leftovers() == []
    yield 0.5
    hands.picture(f"to-{expected}", hands.area)
    yield from hands.undo()
    yield lambda: names() == had
    assert snapshot(bpy.context.active_object) == before


def steps(hands):
    hands.open_panels("WCD_PT_parts", "WCD_PT_edit")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    n_parts = len(names())
    assert n_parts >= 4

    call = "wcd.split_parts(parts=2)"
    yield from edited(hands, call, n_parts + 1, columns=(0.25,))

    for row in (1, 2):
        place = yield from hands.find(f"wcd_parts[{row}].chosen", columns=(_TICK,))
        yield from hands.click(place)
        yield lambda row=row: bpy.context.active_object.wcd_parts[row].chosen
    yield from edited(hands, "wcd.merge_parts", n_parts - 1, columns=(0.25,))
    rows = bpy.context.active_object.wcd_parts
    assert [row.chosen for row in rows[:3]] == [False, True, True]
