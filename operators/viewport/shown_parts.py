"""The faces of parts as the viewports show them, after all modifiers.

They are read once an object and version of its geometry: what hovers and what is drawn
looks them up. The attribute of the parts goes through modifiers as all attributes do.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np

from ...core.steps.arrays import BoolArray, Float32Array, Int32Array
from ..bridge.mesh.attributes import read_attribute, read_flags, read_ints, read_labels
from ..bridge.mesh.corners import edge_sides
from ..bridge.mesh.known import triangles_of
from ..bridge.mesh.layers import layers_of
from ..bridge.mesh.points import is_cloud
from ..bridge.parts.read import FoundParts, find_parts_on, noted_identities
from ..bridge.stored.identity import Identity
from ..bridge.stored.names import OWNER_LAYER, PART_LAYER, RESULT
from ..bridge.watching import changed_objects


@dataclass(frozen=True, eq=False)
class ShownParts:
    """What an object shows of its parts, in its own space.

    Attributes
    ----------
    identities : tuple of Identity
        Who the parts of the object were when it was read, by number.
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

    identities: tuple[Identity, ...]
    numbers: Int32Array
    hidden: BoolArray
    corners: Float32Array
    triangle_numbers: Int32Array
    edges: Float32Array
    sides: Int32Array
    kept: dict[Any, Any] = field(default_factory=dict)

    def triangles_of(self, number: int) -> Float32Array:
        """Return the corners of the triangles of a part, (N, 3)."""
        return self.corners[self.triangle_numbers == number].reshape(-1, 3)

    def border_of(self, number: int) -> Float32Array:
        """Return the ends of the edges around a part, (N, 3)."""
        return self.edges[(self.sides == number).any(axis=1)].reshape(-1, 3)


# By the `session_uid` of their objects; None for objects without parts.
_known: dict[int, ShownParts | None] = {}


def shown_parts(obj: bpy.types.Object) -> ShownParts | None:
    """Return what an object shows of its parts now, None if it shows none."""
    if obj.type != "MESH" or RESULT not in obj:
        return None
    graph = bpy.context.evaluated_depsgraph_get()  # tells `_forget_changed`
    uid = obj.session_uid
    if uid not in _known:
        _known[uid] = _read(obj, graph)
    return _known[uid]


def shown_identities(obj: bpy.types.Object) -> dict[int, Identity]:
    """Return who the parts of an object are now, by number; empty if it shows none.

    Faces are not read again for that, though names and colors change without them.
    """
    shown = shown_parts(obj)
    if shown is None:
        return {}
    noted = noted_identities(obj)
    return {each.number: noted.get(each.number, each) for each in shown.identities}


def n_parts_of(obj: bpy.types.Object | None) -> int:
    """Return how many parts an object has now, as quickly as its faces are known."""
    if obj is not None and is_cloud(obj):
        return len(obj.wcd_parts)
    shown = None if obj is None else shown_parts(obj)
    return 0 if shown is None else len(shown.identities)


def _read(obj: bpy.types.Object, graph: bpy.types.Depsgraph) -> ShownParts | None:
    """Read the faces of an object as its modifiers leave them."""
    found = find_parts_on(obj)
    if found is None:
        return None
    evaluated = obj.evaluated_get(graph)
    mesh = evaluated.to_mesh()
    try:
        numbers = read_attribute(mesh, PART_LAYER, "INT", "FACE")
        if numbers is None:
            return None
        if not found.in_step:
            numbers = _told_apart(obj, found, mesh)
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
            identities=found.identities,
            numbers=numbers,
            hidden=hidden,
            corners=places[triangles],
            triangle_numbers=numbers[faces],
            edges=places[ends],
            sides=np.stack([lowest, highest], axis=1)[between],
        )
    finally:
        evaluated.to_mesh_clear()


def _told_apart(
    obj: bpy.types.Object, found: FoundParts, mesh: bpy.types.Mesh
) -> Int32Array:
    """Return the number of the part of each face of a mesh that modifiers made.

    Parts that share a number after a join were `found` on the object's own faces. Those
    with the same number, owner and material tell of the faces that modifiers made.
    """
    own, shown = _own_marks(obj, len(found.labels)), _shown_marks(mesh)
    if all(map(np.array_equal, own, shown)):  # no modifier made other faces
        return found.numbers
    kinds = np.zeros(len(own[0]) + len(shown[0]), dtype=np.int64)
    for marks in map(np.append, own, shown):
        values, places = np.unique(marks, return_inverse=True)
        kinds = kinds * len(values) + places
    numbers = np.full(kinds.max() + 1, -1, dtype=np.int32)
    numbers[kinds[: len(own[0])][::-1]] = found.numbers[::-1]  # the first face tells
    told = numbers[kinds[len(own[0]) :]]
    return np.where(told < 0, shown[0], told)


def _own_marks(obj: bpy.types.Object, n_faces: int) -> list[Int32Array]:
    """Return the number, the owner and the material index of an object's faces."""
    layers = layers_of(obj)
    found = layers.faces(PART_LAYER), layers.faces(OWNER_LAYER)
    none = np.zeros(n_faces, dtype=np.int32)
    return [
        none if marks is None else marks
        for marks in (*found, layers.material_indices())
    ]


def _shown_marks(mesh: bpy.types.Mesh) -> list[Int32Array]:
    """Return the same of the faces that modifiers made."""
    names = PART_LAYER, OWNER_LAYER, "material_index"
    return [read_labels(mesh, name, missing=0) for name in names]


def stop(*_: object) -> None:
    """Forget all objects. Blender passes arguments to handlers."""
    _known.clear()


def _forget_changed(_: bpy.types.Scene, graph: bpy.types.Depsgraph) -> None:
    """Forget the objects whose geometry has changed."""
    for obj in changed_objects(graph) if _known else ():
        _known.pop(obj.session_uid, None)


HANDLERS = {
    "depsgraph_update_post": _forget_changed,
    "frame_change_post": _forget_changed,  # Blender tells of animation here alone
    "undo_post": stop,
    "redo_post": stop,
    "load_pre": stop,
}
