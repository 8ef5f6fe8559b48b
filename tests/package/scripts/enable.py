"""Enable and disable the installed extension, and say nothing of its own."""

import os
import sys

import bpy  # isort: skip  # makes addon_utils importable

import addon_utils

MODULE = "bl_ext.user_default.weak_convex_decomposition"

assert bpy.app.background
if addon_utils.enable(MODULE) is None:
    raise SystemExit("the extension cannot be enabled")
addon_utils.disable(MODULE)

# Blender 4.2's wheel crashes where Python ends after an add-on was registered.
sys.stdout.flush()
os._exit(0)
