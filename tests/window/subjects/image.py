"""The matrix of lines of sight in the Image Editor, all of it; undo takes it away."""

import bpy
import numpy as np
from leftovers import leftovers
from weak_convex_decomposition.operators.running import modal as running


def steps(hands):
    editor = max(
        (area for area in hands.window.screen.areas if area.type != "VIEW_3D"),
        key=lambda area: area.width * area.height,
    )
    editor.type = "IMAGE_EDITOR"
    yield from hands.open_sidebar()
    yield from hands.parted_suzanne(1, samples=300)
    with hands.context():
        bpy.ops.wcd.show_picture("INVOKE_DEFAULT", picture="SIGHT")
    yield lambda: running.current is None and editor.spaces.active.image
    yield 0.5
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
