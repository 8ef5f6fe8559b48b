"""The sidebar in every mode, beside a second viewport.

What cannot work in a mode is a greyed button that says why, not a menu that opens.
"""

import bpy
from leftovers import leftovers

# Menus where they can be opened, and buttons where not; and what works at least.
_CHOICES = ("wcd.separate", "wcd.show_picture")
_WORKS = {
    "OBJECT": {"wcd.decompose", "wcd.explode", *_CHOICES},
    "EDIT": {"wcd.decompose", "wcd.color_attribute", "wcd.measure_selection"},
    "SCULPT": set(),
}


def commands(hands):
    """Return the names of our operators that the sidebar has buttons for."""
    region = hands.region()
    found = set()
    for y in range(region.y + region.height - 8, region.y, -7):
        yield from hands.move(region.x + int(0.6 * (region.width - 20)), y)
        call = hands.under_cursor()
        if call.startswith("bpy.ops.wcd."):
            found.add(call.removeprefix("bpy.ops.").split("(")[0])
    return found


def works(name):
    return getattr(bpy.ops.wcd, name.removeprefix("wcd.")).poll()


def steps(hands):
    hands.open_panels("WCD_PT_use", "WCD_PT_why")
    with hands.context():
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    yield 0.5
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    with hands.context():
        bpy.ops.wcd.build_hulls(pieces="PARTS")
        bpy.ops.wcd.show_sight(face=0, samples=300)
    for mode, wanted in _WORKS.items():
        with hands.context():
            bpy.ops.object.mode_set(mode=mode)
        yield from hands.open_sidebar()
        buttons = yield from commands(hands)
        hands.picture(mode.lower())
        for name in _CHOICES:
            assert (name in buttons) != works(name), (mode, name)
        working = {name for name in buttons | {*_CHOICES} if works(name)}
        working.discard("wcd.hide_sight")  # which is for all modes
        assert wanted <= working, (mode, working)
        assert wanted or not working, (mode, working)

    with hands.context():
        bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.wcd.hide_sight()
    assert leftovers() == []
