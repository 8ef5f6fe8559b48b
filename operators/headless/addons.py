"""Blender's own add-ons for file formats, which users may have switched off.

Readers and writers enable them before they call their operators.
"""

from __future__ import annotations

import addon_utils

# Names of their modules.
GLTF = "io_scene_gltf2"
FBX = "io_scene_fbx"


def enable(addon: str) -> None:
    """Enable an add-on that comes with Blender, for this session only.

    Parameters
    ----------
    addon : str
        Name of its module.

    Raises
    ------
    RuntimeError
        If Blender lacks it; the errors of Blender's operators are of this type, too.
    """
    _, is_enabled = addon_utils.check(addon)
    if not is_enabled and addon_utils.enable(addon) is None:
        raise RuntimeError(f"Blender's add-on {addon} is missing")
