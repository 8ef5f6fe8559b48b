"""The faces of parts as the viewports show them, after all modifiers.

They are read once an object and version of its geometry: what hovers and what is drawn
looks them up. The attribute of the parts goes through modifiers as all attributes do.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..bridge.mesh.attributes import read_flags, read_ints
from ..bridge.mesh.corners import edge_sides
from ..bridge.mesh.known import triangles_of
from ..bridge.stored.names import PART_LAYER, RESULT


@dataclass(frozen=True, eq=False)
class ShownParts:
    """What an object shows of its parts, in its own space.

    Attributes
    ----------
    numbers : (F,) int
        Number of the part of each face.
    hidden : (F,) bool
        Which faces Edit Mode hides.
    corners : (T, 3, 3) float
        Of the triangles of all faces that are not hidden.
    triangle_numbers : (T,) int
        Number of the part of each triangle.
    edges : (E, 2, 3) float
        Ends of the edges between parts.
    sides : (E, 2) int
        Numbers of the parts at the sides of these edges.
    kept : dict
        What is made of them once: trees for rays, and batches for the GPU.
    """

    numbers: NDArray[np.int32]
    hidden: NDArray[np.bool_]
    corners: NDArray[np.float32]
    triangle_numbers: NDArray[np.int32]
    edges: NDArray[np.float32]
    sides: NDArray[np.int32]
    kept: dict[Any, Any] = field(default_factory=dict)

    def triangles_of(self, number: int) -> NDArray[np.float32]:
        """Return the corners of the triangles of a part, (N, 3)."""
        return self.corners[self.triangle_numbers == number].reshape(-1, 3)

    def border_of(self, number: int) -> NDArray[np.float32]:
        """Return the ends of the edges around a part, (N, 3)."""
        return self.edges[(self.sides == number).any(axis=1)].reshape(-1, 3)


# By the `session_uid` of their objects; None for objects without parts.
_known: dict[int, ShownParts | None] = {}


def shown_parts(obj: bpy.types.Object) -> ShownParts | None:
    """Return what an object shows of its parts now, None if it shows none."""
    if obj.type != "MESH" or RESULT not in obj:
        return None
    uid = obj.session_uid
    if uid not in _known:
        _known[uid] = _read(obj)
    return _known[uid]


def _read(obj: bpy.types.Object) -> ShownParts | None:
    """Read the faces of an object as its modifiers leave them."""
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    try:
        layer = mesh.attributes.get(PART_LAYER)
        if layer is None or layer.domain != "FACE" or layer.data_type != "INT":
            return None
        numbers = read_ints(layer.data, "value")
        hidden = np.zeros(len(numbers), dtype=bool)
        if obj.mode == "EDIT":  # Object Mode shows all faces
            hidden = read_flags(mesh.polygons, "hide")
        vertices, triangles, faces = triangles_of(mesh)
        places = vertices.astype(np.float32)
        seen = ~hidden[faces]
        triangles, faces = triangles[seen], faces[seen]
        lowest, highest = edge_sides(mesh, numbers)
        between = (highest >= 0) & (lowest != highest)
        ends = read_ints(mesh.edges, "vertices", 2)[between]
        return ShownParts(
            numbers=numbers,
            hidden=hidden,
            corners=places[triangles],
            triangle_numbers=numbers[faces],
            edges=places[ends],
            sides=np.stack([lowest, highest], axis=1)[between],
        )
    finally:
        evaluated.to_mesh_clear()


@bpy.app.handlers.persistent
def forget(*_: object) -> None:
    """Forget all objects. Blender passes arguments to handlers."""
    _known.clear()


@bpy.app.handlers.persistent
def _forget_changed(_: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    """Forget the objects whose geometry has changed."""
    for update in graph.updates if _known else ():
        if update.is_updated_geometry and isinstance(update.id, bpy.types.Object):
            _known.pop(update.id.original.session_uid, None)


_ALL = ("undo_post", "redo_post", "load_pre")


def register() -> None:
    """Watch for changes."""
    bpy.app.handlers.depsgraph_update_post.append(_forget_changed)
    for name in _ALL:
        getattr(bpy.app.handlers, name).append(forget)


def unregister() -> None:
    """Undo `register`, and forget all."""
    for name in _ALL:
        getattr(bpy.app.handlers, name).remove(forget)
    bpy.app.handlers.depsgraph_update_post.remove(_forget_changed)
    forget()
