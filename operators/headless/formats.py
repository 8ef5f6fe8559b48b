"""The formats of files: the endings that are read and written, and the axis up.

Readers, writers and the options of the command line all take these from here.
"""

from __future__ import annotations

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

# Characters that names in files do not have, within brackets of a regular expression:
# control characters, halves of characters, and what is none.
CONTROL_CHARACTERS = r"\x00-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff"


def up_in(ending: str, chosen: str | None) -> str:
    """Return the axis that points up in a file, Y or Z: the chosen or the usual one."""
    return chosen or USUAL_UP.get(ending, "Z")


def axes(up: str) -> dict[str, str]:
    """Return the options of Blender's importers and exporters for Y or Z up."""
    forward = {"Y": "NEGATIVE_Z", "Z": "Y"}[up]
    return {"forward_axis": forward, "up_axis": up}
