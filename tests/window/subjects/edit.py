"""Parts ticked in the list, merged and split by the buttons, each undone by Ctrl+Z."""

import bpy
import numpy as np
from edited import record_of
from leftovers import leftovers
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.parts import rows
from weak_convex_decomposition.operators.bridge.parts.rows import noted_refusal
from weak_convex_decomposition.operators.running import modal as running

# Where a row of the table has its box and its name, in shares of the sidebar's width.
_TICK = 0.11
_NAME = 0.35
# Seconds between pictures of a row that was clicked.
_LOOK = 5.0


def names():
    record = record_of(bpy.context.active_object)
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


def shown_for_a_moment(hands):
    """Look at the viewport right after a click on a row, and after that moment."""
    seen, system = [], bpy.context.preferences.system
    smooth, system.viewport_aa = system.viewport_aa, "OFF"  # drawn once is enough
    yield 0.5
    for name in ("row-clicked", "row-later", "row-last"):
        seen.append(hands.pixels(name)[100:900, 100:1200])
        yield _LOOK
    system.viewport_aa = smooth
    outlined, still = (
        int((np.abs(seen[n] - seen[n + 1]).max(axis=2) > 0.2).sum()) for n in (0, 1)
    )
    assert outlined > 200 > 20 > still, (outlined, still)


def color_reset(hands):
    """Reset a color by its key, over the swatch: it is not black then."""
    row = bpy.context.active_object.wcd_parts[1]
    before, row.color = row.color[:], (1.0, 0.0, 0.0)
    yield from hands.find("wcd_parts[1].color", columns=(0.2,))
    yield from hands.press("BackSpace")
    yield lambda: np.allclose(bpy.context.active_object.wcd_parts[1].color, before)


def steps(hands):
    hands.open_panels("WCD_PT_parts", "WCD_PT_edit")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    n_parts = len(names())
    assert n_parts >= 4

    call = "wcd.split_parts(parts=2)"
    yield from edited(hands, call, n_parts + 1, columns=(0.55,))
    yield from color_reset(hands)

    for row in (1, 2):
        place = yield from hands.find(f"wcd_parts[{row}].chosen", columns=(_TICK,))
        yield from hands.click(place)
        yield lambda row=row: bpy.context.active_object.wcd_parts[row].chosen
    yield from edited(hands, "wcd.merge_parts", n_parts - 1, columns=(0.25,))
    table = bpy.context.active_object.wcd_parts
    assert [row.chosen for row in table[:3]] == [False, True, True]

    # A click on another row takes the ticks away; a name that is taken is refused.
    rows._LOOK = 0.7 * _LOOK  # long enough where a processor draws
    _, height = yield from hands.find("wcd_parts[3].chosen", columns=(_TICK,))
    region = hands.region()
    place = int(region.x + _NAME * (region.width - 20)), height
    yield from hands.click(place)
    yield lambda: bpy.context.active_object.wcd_active_part == 3
    obj = bpy.context.active_object
    assert not any(row.chosen for row in obj.wcd_parts)
    yield from shown_for_a_moment(hands)
    hands._do("click", "--repeat", 2, "--delay", 60, 1)
    yield 0.3
    yield from hands.press("ctrl+a")
    hands._do("type", "Part 01")
    yield 0.3
    yield from hands.press("Return")
    yield lambda: noted_refusal(bpy.context.active_object)
    hands.picture("refused", hands.area)
    assert "called Part 01" in noted_refusal(bpy.context.active_object)
    assert names()[3] == bpy.context.active_object.wcd_parts[3].name != "Part 01"
    yield from all_renamed(hands)


def all_renamed(hands):
    """Type a name in the dialog Rename All, with no click into it, and undo that."""
    before = names()
    place = yield from hands.find("wcd.rename_parts", columns=(0.5,))
    yield from hands.click(place)
    yield 0.5
    yield from hands.press("ctrl+a")
    hands._do("type", "Skull")
    yield 0.3
    hands.picture("rename-all", hands.area)
    yield from hands.press("Return")  # ends the name, and the other one the dialog
    yield 0.3
    yield from hands.press("Return")
    yield lambda: names() == ["Skull", *before[1:]]
    yield from hands.undo()
    yield lambda: names() == before
