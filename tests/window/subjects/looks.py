"""How the sidebar looks in dark and light, large and small; pictures for the README."""

from pathlib import Path

import bpy
from leftovers import leftovers

THEMES = {"dark": "Blender_Dark", "light": "Blender_Light"}
SCALES = (1.0, 1.5)


def use_theme(name):
    for folder in bpy.utils.preset_paths("interface_theme"):
        path = Path(folder) / f"{name}.xml"
        if path.exists():
            bpy.ops.script.execute_preset(
                filepath=str(path), menu_idname="USERPREF_MT_interface_theme_presets"
            )
            return
    # The dark theme is what Blender starts with, and has no file.
    bpy.ops.preferences.reset_default_theme()


def picked(hands, name):
    """Take a picture of a part under the cursor, with the menu around it."""
    with hands.context():
        bpy.ops.wcd.pick_parts("INVOKE_DEFAULT")
    region = hands.region("WINDOW")
    for _ in range(2):
        yield from hands.move(
            region.x + int(0.45 * region.width), region.y + region.height // 2
        )
        yield 0.3
    hands.picture(name, hands.area)
    yield from hands.press("w")
    yield 0.5
    hands.picture(f"{name}-menu", hands.area)
    for _ in range(2):
        yield from hands.press("Escape")
        yield 0.3
    assert leftovers() == []


def steps(hands):
    view = bpy.context.preferences.view
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    hands.suzanne(2)
    bpy.context.scene.wcd.samples = 600
    yield 0.5
    hands.picture("before", hands.region(), height=290)
    with hands.context():
        bpy.ops.wcd.decompose(samples=600)
    yield from hands.move(300, 300)
    yield 0.5
    hands.picture("after", hands.area)
    for theme, file in THEMES.items():
        with hands.context():
            use_theme(file)
        for scale in SCALES:
            view.ui_scale = scale
            yield 0.5
            yield from hands.open_sidebar()
            hands.picture(f"{theme}-{scale}", hands.area)
            yield from picked(hands, f"picked-{theme}-{scale}")
