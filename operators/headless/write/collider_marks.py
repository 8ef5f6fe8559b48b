"""Marks the meshes in .glb and .usd files of hulls as convex colliders."""

from __future__ import annotations

import json
import struct
from pathlib import Path

import bpy

_EXTENSION = "KHR_physics_rigid_bodies"
# A .glb file begins with magic word, version and length. Each chunk begins with its
# length and kind; the first chunk is JSON.
_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")


def mark_glb(path: Path) -> None:
    """Mark every node with a mesh as a convex collider (KHR_physics_rigid_bodies).

    The extension is a draft; programs that do not know it still read the meshes.
    """
    data = path.read_bytes()
    magic, version, _ = _HEADER.unpack_from(data)
    length, kind = _CHUNK.unpack_from(data, _HEADER.size)
    start = _HEADER.size + _CHUNK.size
    scene = json.loads(data[start : start + length])
    for number, node in enumerate(scene["nodes"]):
        if "mesh" in node:
            geometry = {"node": number, "convexHull": True}
            node.setdefault("extensions", {})[_EXTENSION] = {
                "collider": {"geometry": geometry}
            }
    scene.setdefault("extensionsUsed", []).append(_EXTENSION)
    text = json.dumps(scene, ensure_ascii=False, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    rest = data[start + length :]
    total = start + len(text) + len(rest)
    path.write_bytes(
        _HEADER.pack(magic, version, total) + _CHUNK.pack(len(text), kind) + text + rest
    )


def mark_usd(path: Path) -> None:
    """Mark every mesh as a collider that is its own convex hull (UsdPhysics).

    Does nothing before Blender 4.4, whose Python has no USD modules.
    """
    if not hasattr(bpy.utils, "expose_bundled_modules"):
        return
    bpy.utils.expose_bundled_modules()
    from pxr import Usd, UsdGeom, UsdPhysics

    stage = Usd.Stage.Open(str(path))
    for prim in stage.Traverse():
        if prim.IsA(UsdGeom.Mesh):
            UsdPhysics.CollisionAPI.Apply(prim)
            approximation = UsdPhysics.MeshCollisionAPI.Apply(prim)
            approximation.CreateApproximationAttr(UsdPhysics.Tokens.convexHull)
    stage.Save()
