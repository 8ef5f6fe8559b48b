"""Lines of sight of points that are clicked on; the object stays as it was."""

import math

import bpy
import numpy as np
from bpy_extras.view3d_utils import location_3d_to_region_2d
from leftovers import leftovers
from mathutils import Vector
from snapshot import snapshot
from weak_convex_decomposition.operators.viewport import sight_overlay

# How far from the click the picked point may be drawn, in points.
_NEAR = 2
# Green or blue points that discs of samples are more than, and that others may be:
# pictures have few colors, and panels move for a moment.
_DRAWN = 500
_FEW = 100


def drawn(pixels):
    """Return how many green and blue points the screen shows."""
    red, green, blue = np.moveaxis(pixels, 2, 0)
    return (
        int(((green > 0.7) & (red < 0.4) & (blue < 0.5)).sum()),
        int(((blue > 0.8) & (red < 0.3) & (green < 0.5)).sum()),
    )


def is_plain(hands, name, plain):
    """Return whether the screen shows no more green and blue than it did."""
    now = drawn(hands.pixels(name))
    print(name, "has", now, "after", plain)
    return all(count < before + _FEW for count, before in zip(now, plain, strict=True))


def middle(hands, right=0.0, up=0.0):
    """Return a place near the middle of the view, in shares of its size."""
    region = hands.region("WINDOW")
    return (
        int(region.x + (0.5 + right) * region.width),
        int(region.y + (0.5 + up) * region.height),
    )


def shown_at(hands, obj):
    """Return where the picked point is in the window."""
    overlay = sight_overlay.current
    region = hands.region("WINDOW")
    seen = np.linalg.solve(overlay.stretch, overlay.view.point)
    point = obj.matrix_world @ Vector(seen)
    place = location_3d_to_region_2d(region, hands.area.spaces.active.region_3d, point)
    return region.x + place.x, region.y + place.y


def click_button(hands, wanted):
    place = yield from hands.find(wanted, columns=(0.5,))
    yield from hands.click(place)


def only_with_its_object(hands, obj, plain):
    """Check that the picture is gone where its object is, and comes back with it."""
    home, (collection,) = hands.window.scene, obj.users_collection
    hands.window.scene = bpy.data.scenes.new("Elsewhere")
    yield 0.5
    assert is_plain(hands, "elsewhere", plain)
    hands.window.scene = home
    layer = hands.window.view_layer.layer_collection.children[collection.name]
    for hidden in (True, False):
        layer.exclude = hidden
        yield 0.5
        assert is_plain(hands, "excluded" if hidden else "back", plain) == hidden
    with hands.context():
        bpy.context.view_layer.objects.active = obj
    yield 0.5


def keep_by_enter(hands, obj, plain):
    """Check that Enter keeps the picture and listens no more; a button removes it."""
    yield from click_button(hands, "wcd.show_sight")
    yield lambda: sight_overlay.current is not None
    yield from hands.click(middle(hands))
    yield lambda: sight_overlay.current.view is not None
    view = sight_overlay.current.view
    yield from hands.press("Return")
    yield from hands.click(middle(hands, up=0.1))
    yield 0.5
    assert sight_overlay.current.view is view
    yield from only_with_its_object(hands, obj, plain)
    yield from click_button(hands, "wcd.hide_sight")
    yield lambda: sight_overlay.current is None
    assert leftovers() == []


def steps(hands):
    hands.open_panels("WCD_PT_why")
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    obj = hands.suzanne(1)
    bpy.context.scene.wcd.samples = 1200
    yield 0.5
    before = snapshot(obj)
    yield from click_button(hands, "wcd.show_sight")
    yield lambda: sight_overlay.current is not None
    assert sight_overlay.current.view is None
    plain = drawn(hands.pixels("waiting"))

    view = None
    for name, at in (("forehead", middle(hands, up=0.1)), ("cheek", middle(hands))):
        yield from hands.click(at)
        yield lambda before=view: sight_overlay.current.view is not before
        view = sight_overlay.current.view
        assert math.dist(shown_at(hands, obj), at) < _NEAR
        assert 0 < sight_overlay.current.share < 1
        green, blue = drawn(hands.pixels(name))
        assert green > plain[0] + _DRAWN, name
        assert blue > plain[1] + _DRAWN, name
    hands.picture("clicked", hands.cutout())

    overlay = hands.area.spaces.active.overlay
    overlay.show_overlays = False
    yield 0.5
    assert is_plain(hands, "without-overlays", plain)
    overlay.show_overlays = True
    yield 0.5

    yield from hands.press("Escape")
    yield lambda: sight_overlay.current is None
    assert leftovers() == []
    yield 0.5
    assert is_plain(hands, "hidden", plain)

    yield from keep_by_enter(hands, obj, plain)
    assert snapshot(obj) == before
