"""Colors of parts as an overlay: in every shading, after a reload, over materials."""

import bpy
import numpy as np
from hands import PICTURES
from leftovers import leftovers
from weak_convex_decomposition.operators.bridge.parts.part_materials import is_overlaid
from weak_convex_decomposition.operators.viewport import picking

# Largest difference of red, green and blue in gray; bright light makes colors pale.
GRAY = 0.18
# How many points are far from gray without an overlay: the wires of what is selected.
SHADINGS = {"SOLID": 500, "MATERIAL": 500, "WIREFRAME": 80_000}


def colorful(hands, name):
    """Return how many points of the view are far from gray."""
    pixels = hands.pixels(name)[200:700, 400:1100]
    return int((np.ptp(pixels, axis=2) > GRAY).sum())


def gray(obj):
    """Give an object a material of the user's."""
    material = bpy.data.materials.new("Clay")
    obj.data.materials.append(material)
    return material


def shade(hands, kind):
    space = hands.area.spaces.active
    space.shading.type = kind
    space.overlay.show_floor = space.overlay.show_axis_x = False
    space.overlay.show_axis_y = space.overlay.show_cursor = False
    space.overlay.show_outline_selected = space.overlay.show_object_origins = False
    yield 1.0  # one long drawing may take all of it, and shaders come with the next
    yield 1.0


def steps(hands):
    hands.open_panels("WCD_PT_parts", "WCD_PT_use")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    obj = hands.suzanne(1)
    gray(obj)
    with hands.context():
        bpy.ops.wcd.decompose(samples=300, colors="OVERLAY")
        bpy.ops.ed.undo_push(message="Decompose")
    assert [m.name for m in obj.data.materials] == ["Clay"]
    for kind, most in SHADINGS.items():
        yield from shade(hands, kind)
        shown = colorful(hands, f"overlay-{kind.lower()}")
        hands.area.spaces.active.overlay.show_overlays = False
        yield 0.5
        plain = colorful(hands, f"plain-{kind.lower()}")
        assert plain < most
        assert shown > plain + 50_000
        hands.area.spaces.active.overlay.show_overlays = True
    yield from shade(hands, "SOLID")
    yield from through_hulls(hands)
    yield from by_the_button(hands)
    yield from reloaded(hands)


def through_hulls(hands):
    """Colors and borders are seen through transparent hulls, and wires; not opaque."""
    shading = hands.area.spaces.active.shading
    obj, before = bpy.context.active_object, colorful(hands, "no-hulls")
    with hands.context():
        bpy.ops.wcd.build_hulls(pieces="PARTS", look="TRANSPARENT")
        bpy.ops.ed.undo_push(message="Hulls")
    shading.color_type = "OBJECT"
    for hull in obj.children:
        hull.color = (0.8, 0.8, 0.8, hull.color[3])
    yield 1.0
    assert colorful(hands, "transparent-hulls") > 0.8 * before
    for kind in ("SINGLE", "RANDOM"):
        shading.color_type = kind
        yield 0.7
        hands.picture(f"hulls-{kind.lower()}", hands.area)
    shading.color_type = "OBJECT"
    with hands.context():
        bpy.ops.wcd.show_hulls(look="SOLID")
    yield 1.0
    assert colorful(hands, "opaque-hulls") < 0.6 * before
    with hands.context():
        bpy.ops.wcd.show_hulls(look="WIRE")
    yield 1.0
    assert colorful(hands, "wire-hulls") > 0.8 * before
    with hands.context():
        bpy.ops.wcd.show_hulls(look="TRANSPARENT")
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    region = hands.region("WINDOW")
    x, y = region.x + region.width // 2, region.y + region.height // 2
    yield from hands.move(int(x), int(y))
    yield 1.0
    assert picking.current.part() is not None
    hands.picture("hovered-in-hulls", hands.area)
    yield from hands.press("Escape")
    with hands.context():
        bpy.ops.wcd.remove_hulls()
        bpy.ops.ed.undo_push(message="No Hulls")
    yield 0.5


def by_the_button(hands):
    """Switch to materials and back by the buttons; undo takes each back."""
    hands.area.spaces.active.shading.color_type = "SINGLE"  # shows no materials
    call = "wcd.show_colors(colors='MATERIALS')"
    place = yield from hands.find(call, columns=(0.25,))
    yield from hands.click(place)
    yield lambda: not is_overlaid(bpy.context.active_object)
    yield 0.5
    assert colorful(hands, "materials") < 500
    yield from hands.undo()
    yield lambda: is_overlaid(bpy.context.active_object)
    yield 0.5
    assert colorful(hands, "undone") > 50_000
    bpy.context.scene.wcd.highlight = True
    bpy.context.active_object.wcd_active_part = 2
    yield 0.5
    hands.picture("highlighted", hands.area)
    bpy.context.scene.wcd.highlight = False


def reloaded(hands):
    """Save and load: the overlay is there again, and follows edits."""
    path = str((PICTURES / "overlay.blend").resolve())
    with hands.context():
        bpy.ops.wm.save_as_mainfile(filepath=path)
        bpy.ops.wm.open_mainfile(filepath=path)
    yield 1.5
    yield from shade(hands, "SOLID")
    before = colorful(hands, "reloaded")
    assert before > 50_000
    bpy.context.active_object.wcd_parts[0].color = (0.9, 0.9, 0.9)
    hands.area.tag_redraw()
    yield 0.5
    assert colorful(hands, "recolored") < 0.8 * before
    with hands.context():
        bpy.ops.object.mode_set(mode="EDIT")
    yield 0.7
    hands.picture("edit-mode", hands.area)
    assert leftovers() == []
