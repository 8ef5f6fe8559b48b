"""Two objects with parts are joined: hover, colors, clicks and an exploded view."""

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from hand_made import activate, centers, decompose_by_hand, moved_apart
from leftovers import leftovers
from mathutils import Vector
from weak_convex_decomposition.operators.bridge.parts.palette import srgb_of
from weak_convex_decomposition.operators.bridge.parts.read import part_identities
from weak_convex_decomposition.operators.viewport import picking

# Where the four parts are, from left to right.
NAMES = ["Head", "Ears", "Left", "Right"]
PLACES = [(x, -0.7, 0.3) for x in (-0.4, 0.4, 2.6, 3.4)]


def parted(obj, names):
    """Give an object two parts with these names, and an overlay of their colors."""
    labels = decompose_by_hand(obj, 2)
    bpy.ops.wcd.show_colors(colors="OVERLAY")
    for row, name in zip(obj.wcd_parts, names, strict=True):
        row.name = name
    return labels


def two(hands, distance=None):
    """Put two monkeys with parts side by side; the first one is active."""
    first = hands.suzanne(1)
    with hands.context():
        bpy.ops.mesh.primitive_monkey_add(location=(3, 0, 0))
        other = bpy.context.active_object
        labels = parted(other, NAMES[2:])
        activate(first)
        labels = np.append(parted(first, NAMES[:2]), 2 + labels)
        other.select_set(True)
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
        if distance is not None:
            bpy.ops.wcd.explode(distance=distance)
        bpy.ops.ed.undo_push(message="Two")
    yield 1.0
    return labels


def place_of(hands, point):
    """Return the place in the window of a point in the world."""
    region = hands.region("WINDOW")
    x, y = location_3d_to_region_2d(region, region.data, Vector(point))
    return int(region.x + x), int(region.y + y)


def join(hands):
    """Join both by the key."""
    yield from hands.move(*place_of(hands, (1.5, 0.0, 0.0)))
    yield from hands.press("ctrl+j")
    yield lambda: len(bpy.data.objects) == 1


def is_apart(labels, distance):
    """Return whether each part is by itself in the exploded view."""
    obj = bpy.data.objects["Suzanne"]
    own = labels[: len(obj.data.polygons)]
    wanted, there = moved_apart(obj.data, own, distance), centers(obj)
    return len(wanted) == len(there) and np.allclose(wanted, there, atol=1e-4)


def exploded_before(hands):
    """An exploded view is right after the join, its undo and its redo."""
    labels = yield from two(hands, 0.4)
    assert is_apart(labels, 0.4)
    yield from join(hands)
    yield lambda: is_apart(labels, 0.4)
    yield 0.5
    hands.picture("exploded", hands.area)
    yield from hands.press("ctrl+z")
    yield lambda: len(bpy.data.objects) == 2 and is_apart(labels, 0.4)
    yield from hands.press("ctrl+shift+z")
    yield lambda: len(bpy.data.objects) == 1 and is_apart(labels, 0.4)


def hovered(hands):
    """Return the names of the parts at the four places."""
    names = []
    for number, place in enumerate(PLACES):
        yield from hands.move(*place_of(hands, place))
        yield 0.4
        part = picking.current.part()
        names.append(part and part.name)
        hands.picture(f"hover-{number}", hands.area)
    return names


def hues(colors):
    """Return the directions in which colors differ from gray."""
    chroma = colors - colors.mean(axis=1, keepdims=True)
    return chroma / np.linalg.norm(chroma, axis=1, keepdims=True)


def picked(hands):
    """Parts that are joined while parts are picked have their own names and colors."""
    yield from two(hands)
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    yield from join(hands)
    yield 0.5
    obj, pixels = bpy.context.active_object, hands.pixels("colors")
    there = np.array([pixels[place_of(hands, place)[::-1]] for place in PLACES])
    wanted = np.array([srgb_of(each.color) for each in part_identities(obj)])
    likeness = hues(there) @ hues(wanted).T
    assert likeness.argmax(axis=1).tolist() == [0, 1, 2, 3]
    before = obj["wcd"], len(obj.wcd_parts)
    assert (yield from hovered(hands)) == NAMES
    assert (obj["wcd"], len(obj.wcd_parts)) == before
    hands._do("click", 1)
    yield lambda: len(bpy.context.active_object.wcd_parts) == 4
    obj = bpy.context.active_object
    assert obj.wcd_parts[obj.wcd_active_part].name == NAMES[3]
    hands.picture("chosen", hands.area)
    yield from hands.press("ctrl+z")
    yield lambda: len(bpy.context.active_object.wcd_parts) == 2
    assert (yield from hovered(hands)) == NAMES
    yield from hands.press("Escape")
    yield lambda: picking.current is None


def steps(hands):
    hands.open_panels("WCD_PT_parts")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    yield from exploded_before(hands)
    yield from picked(hands)
    assert leftovers() == []
