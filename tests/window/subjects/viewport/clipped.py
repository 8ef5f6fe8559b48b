"""A Clipping Region (Alt B) cuts away colors, borders and lines of sight, too."""

import bpy
import numpy as np
from leftovers import leftovers
from weak_convex_decomposition.operators.viewport import sight_overlay

# Largest difference of red, green and blue in gray.
GRAY = 0.18
# The sides of the region, in shares of the view, and how far beyond borders may reach.
LEFT, RIGHT, LOW, HIGH, BEYOND = 0.4, 0.55, 0.4, 0.7, 4


def colorful(hands, name):
    """Return how many points are far from gray within the region, and beyond it."""
    view = hands.region("WINDOW")
    far = np.ptp(hands.pixels(name), axis=2) > GRAY
    far[:, :100] = far[:, hands.region().x - 60 :] = False  # buttons and gizmos
    far[: int(0.15 * view.height)] = far[int(0.85 * view.height) :] = False
    within = np.zeros_like(far)
    columns = int(view.x + LEFT * view.width), int(view.x + RIGHT * view.width)
    rows = int(view.y + LOW * view.height), int(view.y + HIGH * view.height)
    wider = slice(rows[0] - BEYOND, rows[1] + BEYOND)
    within[wider, columns[0] - BEYOND : columns[1] + BEYOND] = True
    return int((far & within).sum()), int((far & ~within).sum())


def clip(hands):
    view = hands.region("WINDOW")
    with hands.context():
        bpy.ops.view3d.clip_border(
            xmin=int(LEFT * view.width),
            xmax=int(RIGHT * view.width),
            ymin=int(LOW * view.height),
            ymax=int(HIGH * view.height),
        )
    yield 0.5


def plain(hands):
    """Leave out all that is colorful without us."""
    space = hands.area.spaces.active
    space.shading.color_type = "SINGLE"
    overlay = space.overlay
    overlay.show_floor = overlay.show_axis_x = overlay.show_axis_y = False
    overlay.show_outline_selected = overlay.show_object_origins = False
    overlay.show_cursor = overlay.show_text = False
    yield 0.5


def place(hands, right, up):
    """Return a place in the view, in shares of its size."""
    view = hands.region("WINDOW")
    return int(view.x + right * view.width), int(view.y + up * view.height)


def cut_away(hands, name, most):
    """Check that colors are within the region alone, and beyond it without one."""
    view = hands.area.spaces.active.region_3d
    yield 0.7
    within, beyond = colorful(hands, f"{name}-in-it")
    print(name, "has", within, "within and", beyond, "beyond")
    assert within > most
    assert beyond < 50
    view.use_clip_planes = False
    yield 0.7
    assert colorful(hands, f"{name}-without")[1] > most
    view.use_clip_planes = True


def sights(hands):
    """Check that points are looked from that the region shows."""
    with hands.context():
        bpy.ops.wcd.show_sight("INVOKE_DEFAULT")
    yield lambda: sight_overlay.current is not None
    yield from hands.click(place(hands, 0.48, 0.2))
    yield from hands.click(place(hands, 0.3, 0.6))
    yield 0.5
    assert sight_overlay.current.view is None
    yield from hands.click(place(hands, 0.48, 0.55))
    yield lambda: sight_overlay.current.view is not None
    yield from cut_away(hands, "sight", 500)
    yield from hands.press("Escape")
    yield lambda: sight_overlay.current is None


def steps(hands):
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    obj = hands.suzanne(1)
    yield from plain(hands)
    with hands.context():
        bpy.ops.wcd.decompose(samples=300, colors="OVERLAY")
    yield from clip(hands)
    yield from cut_away(hands, "overlay", 5000)
    with hands.context():
        bpy.ops.wcd.build_hulls(pieces="PARTS", look="TRANSPARENT")
    hands.area.spaces.active.shading.color_type = "OBJECT"
    for hull in obj.children:
        hull.color = (0.8, 0.8, 0.8, hull.color[3])
    yield from cut_away(hands, "hulls", 5000)
    with hands.context():
        bpy.ops.wcd.remove_hulls()
        bpy.ops.wcd.show_colors(colors="MATERIALS")
    yield from plain(hands)
    bpy.context.scene.wcd.highlight = True
    for row in obj.wcd_parts:
        row.chosen = True
    yield from cut_away(hands, "borders", 300)
    bpy.context.scene.wcd.highlight = False
    yield from sights(hands)
    assert leftovers() == []
