"""Marks the hulls in .glb files as convex colliders."""

from __future__ import annotations

import json
import struct
from pathlib import Path
from typing import Any

from ....core.errors import DecompositionError
from ...bridge.stored.names import HULL_TAG

_EXTENSION = "KHR_physics_rigid_bodies"
# A .glb file begins with magic word, version and length. Each chunk begins with its
# length and kind; the first chunk is JSON.
_HEADER = struct.Struct("<4sII")
_CHUNK = struct.Struct("<I4s")


def mark_glb(path: Path, n_hulls: int) -> None:
    """Mark every node that is a hull as a convex collider (KHR_physics_rigid_bodies).

    The extras of a node are the custom properties of its object. The extension is a
    draft; programs that do not know it still read the meshes.

    Raises
    ------
    DecompositionError
        If the file has another number of hulls: the exporter left some out.
    """
    data = path.read_bytes()
    magic, version, _ = _HEADER.unpack_from(data)
    length, kind = _CHUNK.unpack_from(data, _HEADER.size)
    start = _HEADER.size + _CHUNK.size
    scene = json.loads(data[start : start + length])
    nodes = enumerate(scene.get("nodes", ()))
    marked = {n: node for n, node in nodes if _is_hull(node)}
    if n_hulls != len(marked):
        raise DecompositionError(
            f"The file would have {len(marked)} of {n_hulls} hulls, because Blender's"
            " exporter leaves some out; choose another format, such as .usd."
        )
    for number, node in marked.items():
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


def _is_hull(node: dict[str, Any]) -> bool:
    """Return whether a node is a hull with a mesh."""
    return "mesh" in node and HULL_TAG in node.get("extras", {})
