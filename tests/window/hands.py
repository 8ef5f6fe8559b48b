"""A user's hands and eyes: mouse, keys, what is under the cursor, and pictures."""

import math
import os
import subprocess
from itertools import product
from pathlib import Path
from types import SimpleNamespace

import bpy
import numpy as np
import weak_convex_decomposition as package
from mathutils import Euler
from weak_convex_decomposition import ui

PICTURES = Path("build/window")
CATEGORY = "Convex Parts"
# Points between two places where a button is looked for.
_STRIDE = 7
# How far from there Blender may see the cursor, in points.
_NEAR = 3


class TEST_OT_watch(bpy.types.Operator):
    """Know where Blender has seen the cursor last: X and Blender take their time."""

    bl_idname = "test.watch"
    bl_label = "Watch the Cursor"
    place = (-math.inf, -math.inf)

    def invoke(self, context, event):
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        TEST_OT_watch.place = event.mouse_x, event.mouse_y
        return {"PASS_THROUGH"}


bpy.utils.register_class(TEST_OT_watch)


class Hands:
    """Acts on the first window; what takes time is to be used with `yield from`."""

    def __init__(self, subject):
        self.subject = subject

    # What there is; another file brings other windows.

    @property
    def manager(self):
        return bpy.context.window_manager

    @property
    def window(self):
        return self.manager.windows[0]

    @property
    def area(self):
        return next(a for a in self.window.screen.areas if a.type == "VIEW_3D")

    def region(self, kind="UI"):
        return next(r for r in self.area.regions if r.type == kind)

    def context(self, kind="WINDOW"):
        """Return an override of the context, for operators."""
        return bpy.context.temp_override(
            window=self.window, area=self.area, region=self.region(kind)
        )

    def fill_screen(self):
        """Let the 3D view take all of the window, for long sidebars."""
        with self.context():
            bpy.ops.screen.screen_full_area(use_hide_panels=False)
        yield 0.5

    def open_panels(self, *names):
        """Have these panels open and others closed, before any of them is drawn.

        Blender tells nobody where their headers are, to click on.
        """
        package.unregister()
        for cls in ui.CLASSES:
            if hasattr(cls, "bl_parent_id"):
                cls.bl_options = set() if cls.__name__ in names else {"DEFAULT_CLOSED"}
        package.register()

    def open_sidebar(self):
        """Show the tab of the extension."""
        self.area.spaces.active.show_region_ui = True
        yield 0.3
        self.region().active_panel_category = CATEGORY
        self.region().tag_redraw()
        with self.context():
            bpy.ops.test.watch("INVOKE_DEFAULT")
        yield 0.3

    def suzanne(self, subdivisions):
        """Put the monkey in place of what is there, as one step to undo to."""
        with self.context():
            for obj in list(bpy.data.objects):
                bpy.data.objects.remove(obj)
            bpy.ops.mesh.primitive_monkey_add()
            obj = bpy.context.active_object
            if subdivisions:
                obj.modifiers.new("Subdivision", "SUBSURF").levels = subdivisions
                bpy.ops.object.modifier_apply(modifier="Subdivision")
            shading = self.area.spaces.active.shading
            shading.type, shading.color_type = "SOLID", "MATERIAL"
            bpy.ops.ed.undo_push(message="Suzanne")
        self.look()
        return obj

    def parted_suzanne(self, subdivisions, samples):
        """Put the monkey there and decompose her, as another step to undo to."""
        self.suzanne(subdivisions)
        with self.context():
            bpy.ops.wcd.decompose(samples=samples)
            bpy.ops.ed.undo_push(message="Decompose")
        yield 0.5

    def take_samples(self, number):
        """Have runs take so many samples, as another step to undo to."""
        bpy.context.scene.wcd.samples = number
        with self.context():
            bpy.ops.ed.undo_push(message="Samples")
        yield 0.5

    def look(self):
        """Look at the active object from the front and the right."""
        view = self.area.spaces.active.region_3d
        view.view_rotation = Euler((1.3, 0.0, 0.5)).to_quaternion()
        with self.context():
            bpy.ops.view3d.view_selected()

    # Mouse and keys, as the X server's.

    def _do(self, *words):
        subprocess.run(["xdotool", *map(str, words)], check=True)

    def move(self, x, y):
        """Move the cursor to a place of Blender's, counted from the lower left."""
        self._do("mousemove", x, self.window.height - 1 - y)
        yield lambda: math.dist(TEST_OT_watch.place, (x, y)) < _NEAR

    def click(self, place):
        yield from self.move(*place)
        yield 0.1
        self._do("mousedown", 1)
        yield 0.1
        self._do("mouseup", 1)
        yield 0.1

    def press(self, key):
        self._do("key", key)
        yield 0.1

    def undo(self):
        """Press Ctrl+Z over the 3D view."""
        area = self.area
        yield from self.move(area.x + area.width // 4, area.y + area.height // 2)
        yield 0.1
        yield from self.press("ctrl+z")

    def drag(self, place, offsets):
        """Drag from a place to others beside it, and say where it is each time."""
        x, y = place
        yield from self.move(x, y)
        yield 0.1
        self._do("mousedown", 1)
        yield 0.1
        for offset in offsets:  # nothing else sees the cursor while a button has it
            self._do("mousemove", x + offset, self.window.height - 1 - y)
            yield 0.3
        self._do("mouseup", 1)
        yield 0.2

    # Eyes.

    def find(self, wanted, columns=(0.75, 0.12, 0.5, 0.95)):
        """Return the place of the button of an operator or property in the sidebar.

        `wanted` is what Blender copies of it: a call, or a path of data; `columns` are
        where it may be, in shares of the width.
        """
        region = self.region()
        heights = range(region.y + region.height - 8, region.y, -_STRIDE)
        # Twice: a busy machine draws late.
        for y, share in (*product(heights, columns),) * 2:
            place = int(region.x + share * (region.width - 20)), y
            yield from self.move(*place)
            if wanted in self.under_cursor():
                return place
        self.picture("searched")
        raise AssertionError(f"{wanted} is nowhere in the sidebar")

    def under_cursor(self):
        """Return what Blender copies of the button under the cursor, '' for none."""
        self.manager.clipboard = ""
        with self.context("UI"):
            for copy in (
                bpy.ops.ui.copy_python_command_button,
                bpy.ops.ui.copy_data_path_button,
            ):
                if copy.poll():
                    copy()
                    break
        return self.manager.clipboard

    def pixels(self, name):
        """Return what the screen shows, (H, W, 3) float, and save it as a picture."""
        image = bpy.data.images.load(str(self.picture(name).resolve()))
        width, height = image.size
        rgba = np.zeros(width * height * 4, dtype=np.float32)
        image.pixels.foreach_get(rgba)
        bpy.data.images.remove(image)
        return rgba.reshape(height, width, 4)[:, :, :3]

    def cutout(self):
        """Return the part of the 3D view that has the object and the sidebar in it."""
        area = self.area
        left, bottom = int(0.3 * area.width), int(0.15 * area.height)
        return SimpleNamespace(
            x=area.x + left,
            y=area.y + bottom,
            width=area.width - left,
            height=area.height - bottom - 40,
        )

    def picture(self, name, crop=None, height=None):
        """Save what the screen shows, or a region of it, or the top of that."""
        with self.context():
            bpy.ops.wm.redraw_timer(type="DRAW_WIN_SWAP", iterations=1)
        PICTURES.mkdir(parents=True, exist_ok=True)
        path, area = PICTURES / f"{self.subject}-{name}.png", []
        if crop is not None:
            top = self.window.height - crop.y - crop.height
            area = ["-crop", f"{crop.width}x{height or crop.height}+{crop.x}+{top}"]
        few = ["+dither", "-colors", "96"]  # small files
        shot = ["import", "-window", "root", *area, "+repage", *few, f"png8:{path}"]
        subprocess.run(shot, check=True, env={**os.environ, "HOME": "/tmp"})
        shown = subprocess.run(
            ["identify", "-format", "%[fx:standard_deviation]", str(path)],
            capture_output=True,
            check=True,
            text=True,
        ).stdout
        assert float(shown) > 0.01, f"{path} shows nothing"
        return path
