"""The matrix of lines of sight in an Image Editor that opens for it, all of it.

Undo takes the image away. Another picture uses the editor that is there. A view that
fills the screen becomes the editor.
"""

import bpy
import numpy as np
from leftovers import leftovers
from weak_convex_decomposition.operators.running import modal as running


def editors(hands):
    return [a for a in hands.window.screen.areas if a.type == "IMAGE_EDITOR"]


def steps(hands):
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    with hands.context():
        bpy.ops.wcd.show_picture("INVOKE_DEFAULT", picture="SIGHT")
    yield lambda: running.current is None and editors(hands)
    yield 0.5
    (editor,) = editors(hands)
    view = hands.area
    assert view.y == editor.y
    assert abs(view.width - editor.width) < 0.1 * view.width
    space = editor.spaces.active
    image = space.image.name
    region = next(each for each in editor.regions if each.type == "WINDOW")
    shown = np.array(space.image.size) * space.zoom[0]
    assert (shown <= (region.width, region.height)).all(), shown
    assert shown.max() > 0.5 * min(region.width, region.height), shown
    hands.picture("editor")
    assert leftovers() == []
    yield from hands.undo()
    yield lambda: image not in bpy.data.images
    with hands.context():
        bpy.ops.wcd.show_picture("INVOKE_DEFAULT", picture="SCATTER")
    yield lambda: running.current is None and editors(hands)[0].spaces.active.image
    assert len(editors(hands)) == 1
    yield 0.5
    (editor,) = editors(hands)
    editor.type = "VIEW_3D"
    yield from hands.fill_screen()
    with hands.context():
        bpy.ops.wcd.show_picture("INVOKE_DEFAULT", picture="SIGHT")
    yield lambda: running.current is None and editors(hands)
    yield 0.5
    assert len(editors(hands)) == len(hands.window.screen.areas) == 1
