"""Parts picked in the viewport: hover, clicks, pie menu, wheel, undo and Esc."""

import time

import bpy
from leftovers import leftovers
from weak_convex_decomposition.operators.bridge.views.isolating import isolating
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import picking
from weak_convex_decomposition.operators.viewport.part_at import part_at

# Places on Suzanne's brow, chin and ear, in shares of the view.
BROW, CHIN, EAR = (0.5, 0.58), (0.46, 0.25), (0.69, 0.52)
NOWHERE = (0.2, 0.2)


def at(hands, place):
    """Return a place in the view, in points of the window."""
    region = hands.region("WINDOW")
    x, y = place
    return int(region.x + x * region.width), int(region.y + y * region.height)


def hover(hands, place):
    """Move to a place, and return the name of the part there."""
    yield from hands.move(*at(hands, place))
    yield 0.3
    part = picking.current.part()
    return part and part.name


def press(hands, button, key=None):
    """Press a mouse button where the cursor is, while a key is held."""
    if key:
        hands._do("keydown", key)
    yield 0.1
    hands._do("click", button)
    yield 0.2
    if key:
        hands._do("keyup", key)
    yield 0.2


def rows():
    """Return the name of the highlighted row, and of those that are ticked."""
    obj = bpy.context.active_object
    ticked = [row.name for row in obj.wcd_parts if row.chosen]
    return obj.wcd_parts[obj.wcd_active_part].name, ticked


def n_parts():
    return len(bpy.context.active_object.wcd_parts)


def choosing(hands):
    """Click and Shift-click parts; undo takes the clicks back one by one."""
    brow = yield from hover(hands, BROW)
    assert brow
    hands.picture("hover", hands.area)
    yield from press(hands, 1)
    assert rows() == (brow, [])
    chin = yield from hover(hands, CHIN)
    yield from press(hands, 1, "shift")
    assert rows()[0] == chin != brow
    assert set(rows()[1]) == {brow, chin}
    yield from hover(hands, EAR)
    hands.picture("two-chosen", hands.area)
    yield from hands.press("ctrl+z")
    yield lambda: rows() == (brow, [])
    assert picking.current is not None
    return brow, chin


def by_the_menu(hands, chin):
    """Isolate a part by the pie, show all again, and merge with the next click."""
    for key in "88":
        yield from hover(hands, CHIN)
        yield from press(hands, 3)
        yield 0.5
        assert rows() == (chin, [])
        there = isolating(bpy.context.active_object)
        hands.picture("pie-all" if there else "pie", hands.area)
        yield from hands.press(key)
        yield (
            lambda there=there: (
                bool(isolating(bpy.context.active_object)) != bool(there)
            )
        )
        yield 0.4
        hands.picture("isolated" if there is None else "all", hands.area)
    before = n_parts()
    yield from hover(hands, CHIN)
    yield from hands.press("w")
    yield 0.5
    yield from hands.press("4")
    yield lambda: picking.current.merging
    yield from hover(hands, BROW)
    hands.picture("merge-with", hands.area)
    yield from press(hands, 1)
    yield lambda: n_parts() == before - 1 and not running.current
    yield 0.5
    hands.picture("merged", hands.area)
    yield from hands.undo()
    yield lambda: n_parts() == before


def renamed(hands, chin):
    """Type a name in the dialog of the pie, with no click into it, and undo that."""
    yield from hover(hands, CHIN)
    yield from hands.press("w")
    yield 0.5
    yield from hands.press("7")
    yield 0.5
    hands._do("type", "Jaw")
    yield 0.3
    hands.picture("rename", hands.area)
    yield from hands.press("Return")  # ends the name, and the other one the dialog
    yield 0.3
    yield from hands.press("Return")
    yield lambda: rows()[0] == "Jaw"
    yield from hands.undo()
    yield lambda: rows()[0] == chin


def clipped(hands):
    """Check that a Clipping Region around the brow leaves out the chin."""
    region = hands.region("WINDOW")
    sides = {"xmin": 0.3, "xmax": 0.7, "ymin": 0.45, "ymax": 0.8}
    sizes = {"x": region.width, "y": region.height}
    with hands.context():
        bpy.ops.view3d.clip_border(
            **{side: int(share * sizes[side[0]]) for side, share in sides.items()}
        )
    assert (yield from hover(hands, CHIN)) is None
    assert (yield from hover(hands, BROW))
    hands.picture("clipped", hands.area)
    hands.area.spaces.active.region_3d.use_clip_planes = False
    assert (yield from hover(hands, CHIN))


def by_the_wheel(hands):
    """Alt and the wheel change the number of parts; without Alt the view moves.

    Esc and right-click go back to the number before, names and all; Enter keeps it.
    """
    before, noted = n_parts(), bpy.context.active_object["wcd"]
    number = bpy.context.scene.wcd.parts
    yield from hover(hands, BROW)
    view = hands.area.spaces.active.region_3d
    distance = view.view_distance
    for _ in range(2):
        yield from press(hands, 4, "alt")
    yield lambda: n_parts() == before + 2 and not running.current
    assert view.view_distance == distance
    hands.picture("two-more", hands.area)
    yield from press(hands, 4)
    yield 0.5
    assert view.view_distance < distance
    assert n_parts() == before + 2
    yield from hands.press("Escape")
    yield lambda: bpy.context.active_object["wcd"] == noted
    assert (n_parts(), bpy.context.scene.wcd.parts) == (before, number)
    assert picking.current is not None
    yield 0.5
    hands.picture("back", hands.area)
    for leave, expected in (("click", before), ("Return", before + 1)):
        yield from hover(hands, BROW)
        yield from press(hands, 4, "alt")
        yield lambda: n_parts() == before + 1 and not running.current
        yield 0.3
        yield from press(hands, 3) if leave == "click" else hands.press(leave)
        yield lambda expected=expected: n_parts() == expected
        assert picking.current.turning is None


def steps(hands):
    hands.open_panels("WCD_PT_parts")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    bpy.context.scene.wcd.samples = 300
    place = yield from hands.find("wcd.pick_parts", columns=(0.25,))
    yield from hands.click(place)
    yield lambda: picking.current is not None
    _, chin = yield from choosing(hands)
    yield from by_the_menu(hands, chin)
    yield from renamed(hands, chin)
    yield from clipped(hands)
    yield from by_the_wheel(hands)
    yield from hover(hands, NOWHERE)
    assert picking.current.part() is None
    yield from hands.press("Escape")
    yield lambda: picking.current is None
    assert leftovers() == []
    yield 0.5
    hands.picture("left", hands.area)
    yield from in_sculpt_mode(hands)
    yield from large(hands)


def in_sculpt_mode(hands):
    """Check that Sculpt Mode ends picking, for its clicks are the brush's."""
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
        bpy.ops.object.mode_set(mode="SCULPT")
    assert picking.current is not None
    yield from hands.click(at(hands, BROW))
    yield lambda: picking.current is None
    assert leftovers() == []
    hands.picture("sculpt", hands.area)
    with hands.context():
        bpy.ops.object.mode_set(mode="OBJECT")


def large(hands):
    """Time what hovering does on 126,000 faces."""
    hands.suzanne(4)
    with hands.context():
        bpy.ops.wcd.decompose(samples=300, parts=7)
    yield 0.5
    drawing(hands)  # makes what Blender draws
    print(f"drawn without: {drawing(hands):.3f} s")
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    region, times = hands.region("WINDOW"), []
    for share in range(30, 70):
        began = time.process_time()
        with hands.context():
            x, y = share / 100 * region.width, 0.5 * region.height
            part_at(bpy.context, region, x, y)
        times.append(time.process_time() - began)
    print(f"ray: first {times[0]:.3f} s, others at most {max(times[1:]):.4f} s")
    for place in (BROW, CHIN, EAR):
        name = yield from hover(hands, place)
        assert name
        print(f"drawn with {name}: {drawing(hands):.3f} s")
    hands.picture("large", hands.area)
    yield from hands.press("Escape")
    yield lambda: picking.current is None


def drawing(hands):
    """Return how long a drawing of the window takes, in seconds of the processor."""
    began = time.process_time()
    with hands.context():
        bpy.ops.wm.redraw_timer(type="DRAW_WIN", iterations=5)
    return (time.process_time() - began) / 5
