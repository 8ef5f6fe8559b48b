"""How the sidebar looks in dark and light, large and small; pictures for the README."""

from pathlib import Path

import bpy

THEMES = {"dark": "Blender_Dark", "light": "Blender_Light"}
SCALES = (1.0, 1.5)
# Those that are open in each picture; a small screen has no room for all.
PANELS = {
    "parts": ("WCD_PT_parts", "WCD_PT_edit", "WCD_PT_chart"),
    "edit": ("WCD_PT_parts", "WCD_PT_edit"),
    "others": ("WCD_PT_use", "WCD_PT_why", "WCD_PT_hulls"),
    "advanced": ("WCD_PT_advanced",),
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


def steps(hands):
    view = bpy.context.preferences.view
    yield from hands.fill_screen()
    yield from hands.open_sidebar()
    hands.suzanne(2)
    bpy.context.scene.wcd.samples = 600
    yield 0.5
    hands.picture("before", hands.region(), height=240)
    with hands.context():
        bpy.ops.wcd.decompose(samples=600)
    yield from hands.move(300, 300)
    yield 0.5
    hands.picture("after", hands.area)
    with hands.context():
        bpy.ops.wcd.rename_parts("INVOKE_DEFAULT")
    yield 0.5
    hands.picture("names", hands.area)
    yield from hands.press("Escape")
    for theme, file in THEMES.items():
        with hands.context():
            use_theme(file)
        for scale in SCALES:
            view.ui_scale = scale
            for name, panels in PANELS.items():
                hands.open_panels(*panels)
                yield from hands.open_sidebar()
                yield 0.3
                hands.picture(f"{theme}-{scale}-{name}", hands.area)
