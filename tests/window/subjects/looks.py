"""How the sidebar looks in dark and light, large and small; pictures for the README."""

from pathlib import Path

import bpy
from leftovers import leftovers

THEMES = {"dark": "Blender_Dark", "light": "Blender_Light"}
SCALES = (1.0, 1.5)
# Those that are open in pictures of a name; the screen has no room for all.
PANELS = {
    "edit": ("WCD_PT_parts", "WCD_PT_edit"),
    "chart": ("WCD_PT_parts", "WCD_PT_chart"),
    "others": ("WCD_PT_use", "WCD_PT_why", "WCD_PT_hulls"),
    "advanced": ("WCD_PT_advanced",),
    "built": ("WCD_PT_hulls",),  # with hulls around parts whose colors are an overlay
}


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
    yield from decomposed_suzanne(hands, "before", "after")
    with hands.context():
        bpy.ops.wcd.rename_parts("INVOKE_DEFAULT")
    yield 0.5
    hands.picture("names", hands.area)
    yield from hands.press("Escape")
    for name, panels in PANELS.items():
        with hands.context():
            bpy.ops.wm.read_homefile()  # forgets which panels are open
        yield 0.5
        hands.open_panels(*panels)
        yield from decomposed_suzanne(hands)
        if name == "built":
            with hands.context():
                bpy.ops.wcd.show_colors(colors="OVERLAY")
                bpy.ops.wcd.build_hulls(pieces="PARTS")
            yield 0.5
        for theme, file in THEMES.items():
            with hands.context():
                use_theme(file)
            for bpy.context.preferences.view.ui_scale in SCALES:
                yield 0.5
                yield from hands.open_sidebar()
                scale = bpy.context.preferences.view.ui_scale
                if name == "built":  # the list of hulls is at the end
                    with hands.context("UI"):
                        bpy.ops.view2d.scroll_down(page=True)
                    yield 0.5
                hands.picture(f"{theme}-{scale:.1f}-{name}", hands.area)
                if name == "edit":
                    yield from picked(hands, f"picked-{theme}-{scale:.1f}")
        bpy.context.preferences.view.ui_scale = 1.0


def decomposed_suzanne(hands, *pictures):
    """Decompose the monkey; take pictures of the tab before, and of all after that."""
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    hands.suzanne(2)
    bpy.context.scene.wcd.samples = 600
    yield 0.5
    for name in pictures[:1]:
        hands.picture(name, hands.region(), height=229)
    with hands.context():
        bpy.ops.wcd.decompose(samples=600)
    yield from hands.move(300, 300)
    yield 0.5
    for name in pictures[1:]:
        hands.picture(name, hands.area)
