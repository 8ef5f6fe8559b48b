"""The tint under the cursor, and the pie by its keys: split, lock, select, assign."""

import bpy
from leftovers import leftovers
from subjects.viewport.pick import BROW, CHIN, NOWHERE, hover, n_parts
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.running import modal as running
from weak_convex_decomposition.operators.viewport import picking

# How much lighter a tint makes each channel at least, and how many points of the
# screen get lighter: the brow has these, its border a tenth.
_LIGHTER = 0.03
_FEWEST, _MOST = 15_000, 80_000


def by_key(hands, place, key):
    """Choose an entry of the pie for the part at a place."""
    yield from hover(hands, place)
    yield from hands.press("w")
    yield 0.5
    yield from hands.press(key)


def locked():
    return [row.name for row in bpy.context.active_object.wcd_parts if row.locked]


def counts():
    """Return the number of faces of each part, by name."""
    figures = figures_of(bpy.context.active_object)
    names = [each.name for each in figures.identities]
    return dict(zip(names, figures.measured_on[:, 0].tolist(), strict=True))


def tinted(hands):
    """Hover over a part, and check that all of it gets lighter, not only its border."""
    yield from hover(hands, NOWHERE)
    before = hands.pixels("not-hovered")
    yield from hover(hands, BROW)
    lighter = (hands.pixels("hovered") - before).min(axis=2) > _LIGHTER
    assert _FEWEST < lighter.sum() < _MOST, lighter.sum()


def split_and_lock(hands, chin):
    before = n_parts()
    yield from by_key(hands, CHIN, "6")
    yield lambda: n_parts() == before + 1 and not running.current
    yield from hands.undo()
    yield lambda: n_parts() == before
    yield from by_key(hands, CHIN, "9")
    yield lambda: locked() == [chin]
    hands.picture("locked", hands.area)
    yield from by_key(hands, CHIN, "9")
    yield lambda: not locked()


def assign(hands, brow, chin):
    """Give all faces of the chin to the brow, in Edit Mode."""
    with hands.context():
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.ed.undo_push(message="Edit Mode")
    before = counts()
    yield from by_key(hands, CHIN, "3")
    yield lambda: bpy.context.active_object.data.count_selected_items()[2]
    yield from by_key(hands, BROW, "2")
    yield lambda: counts() != before and not running.current
    assert counts()[brow] == before[brow] + before[chin]
    assert chin not in counts()
    hands.picture("assigned", hands.area)
    yield from hands.undo()
    yield lambda: counts() == before


def steps(hands):
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    yield lambda: picking.current is not None
    chin = yield from hover(hands, CHIN)
    brow = yield from hover(hands, BROW)
    assert chin != brow
    yield from tinted(hands)
    yield from split_and_lock(hands, chin)
    yield from assign(hands, brow, chin)
    yield from hands.press("Escape")
    yield lambda: picking.current is None
    assert leftovers() == []
