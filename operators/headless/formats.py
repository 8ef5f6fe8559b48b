"""The formats of files: endings, the axis up, and the add-ons of Blender for them.

Readers, writers and the options of the command line all take these from here.
"""

from __future__ import annotations

import re

READ_ENDINGS = (
    ".obj",
    ".ply",
    ".stl",
    ".off",
    ".xyz",
    ".pwn",
    ".pts",
    ".glb",
    ".gltf",
    ".fbx",
    ".usd",
    ".usda",
    ".usdc",
    ".usdz",
    ".blend",
)
MODEL_ENDINGS = (".blend", ".glb", ".ply", ".obj", ".usd", ".fbx")
# The models that can hold hulls as well (--with-hulls).
HULLS_WITHIN_ENDINGS = (".blend", ".glb", ".usd", ".fbx")
PICTURE_ENDINGS = (".png",)
# The names of hull formats, as in --hulls-format, and the ending of each.
HULL_FORMATS = {
    "glb": ".glb",
    "obj": ".obj",
    "stl": ".stl",
    "usd": ".usd",
    "urdf": ".urdf",
    "mjcf": ".xml",
}
HULL_ENDINGS = tuple(HULL_FORMATS.values())
# Hull files with masses, whose meshes lie in a folder beside them.
SIMULATOR_ENDINGS = tuple(HULL_FORMATS[name] for name in ("urdf", "mjcf"))

# The usual up axis of mesh formats whose files do not state one.
USUAL_UP = {
    ".obj": "Y",
    ".off": "Y",
    **dict.fromkeys((".ply", ".stl", ".xyz", ".pwn", ".pts"), "Z"),
}

# Add-ons that come with Blender, and that users may have switched off: their modules.
GLTF = "io_scene_gltf2"
FBX = "io_scene_fbx"

# Characters that names in files do not have, within brackets of a regular expression:
# control characters, halves of characters, and what is none.
CONTROL_CHARACTERS = r"\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff"
_CONTROL = re.compile(f"[{CONTROL_CHARACTERS}]")


def one_line(text: str) -> str:
    """Return text with escapes for line breaks and the like, which names may have."""
    return _CONTROL.sub(lambda found: ascii(found[0])[1:-1], text)


def up_in(ending: str, chosen: str | None) -> str:
    """Return the axis that points up in a file, Y or Z: the chosen or the usual one."""
    return chosen or USUAL_UP.get(ending, "Z")


def axes(up: str) -> dict[str, str]:
    """Return the options of Blender's importers and exporters for Y or Z up."""
    forward = {"Y": "NEGATIVE_Z", "Z": "Y"}[up]
    return {"forward_axis": forward, "up_axis": up}


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
    import addon_utils  # Blender provides it; endings are known without Blender

    _, is_enabled = addon_utils.check(addon)
    if not is_enabled and addon_utils.enable(addon) is None:
        raise RuntimeError(f"Blender's add-on {addon} is missing")
