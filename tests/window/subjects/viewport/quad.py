"""Quad View: a part is framed in the view in which it is picked."""

import bpy
from leftovers import leftovers
from subjects.viewport.pick import hover
from weak_convex_decomposition.operators.viewport import picking

# The chin in the first view, which is from the front, in shares of the view.
CHIN = 0.5, 0.33
FRAME = "1"  # in the pie


def views(hands):
    """Return how far each of the views looks from its center."""
    regions = [each for each in hands.area.regions if each.type == "WINDOW"]
    return [round(each.data.view_distance, 3) for each in regions]


def steps(hands):
    yield from hands.fill_screen()
    yield from hands.parted_suzanne(1, samples=300)
    with hands.context():
        bpy.ops.screen.region_quadview()
        bpy.ops.view3d.view_all(use_all_regions=True)
        bpy.ops.test.watch("INVOKE_DEFAULT")
    yield 0.5
    before = views(hands)
    assert len(before) == 4
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    yield lambda: picking.current is not None
    yield from hover(hands, CHIN)
    yield from hands.press("w")
    yield 0.5
    yield from hands.press(FRAME)
    yield lambda: views(hands) != before
    changed = [a != b for a, b in zip(before, views(hands), strict=True)]
    assert changed == [True, False, False, False]
    hands.picture("framed", hands.area)
    yield from hands.press("Escape")
    yield lambda: picking.current is None
    assert leftovers() == []
