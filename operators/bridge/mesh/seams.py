"""Mark edges of a mesh as seams, for unwrapping, and take back what was marked.

The attribute `wcd_seam` notes the edges that were no seams before, so that the user's
own seams stay. It follows the mesh through edits and undo.
"""

from __future__ import annotations

import bmesh
import bpy

from ....core.errors import DecompositionError
from ....core.steps.arrays import BoolArray
from ..stored.names import SEAM_LAYER
from .attributes import read_flags, read_ints, write_attribute, write_flags
from .selection import show_flags

# Blender's own attribute of seams, before and since 5.0.
BLENDERS_LAYERS = (".uv_seam", "uv_seam")


def has_marked_seams(mesh: bpy.types.Mesh) -> bool:
    """Return whether there is a note of seams that we marked."""
    if mesh.is_editmode:
        return SEAM_LAYER in bmesh.from_edit_mesh(mesh).edges.layers.int
    attribute = mesh.attributes.get(SEAM_LAYER)
    return attribute is not None and _is_ours(attribute)


def mark_seams(mesh: bpy.types.Mesh, chosen: BoolArray) -> None:
    """Mark edges (E,) as seams in place of those that were marked before.

    Raises
    ------
    DecompositionError
        If the mesh has another attribute of that name.
    """
    attribute = mesh.attributes.get(SEAM_LAYER)
    if attribute is not None and not _is_ours(attribute):
        raise DecompositionError(
            f"The mesh has an attribute {SEAM_LAYER} that this add-on did not write;"
            " rename or remove it in the mesh's properties."
        )
    unmark_seams(mesh)
    if mesh.is_editmode:
        edges = bmesh.from_edit_mesh(mesh).edges
        layer = edges.layers.int.new(SEAM_LAYER)
        for edge, wanted in zip(edges, chosen.tolist(), strict=True):
            edge[layer] = wanted and not edge.seam
            edge.seam = edge.seam or wanted
    else:
        seams = read_flags(mesh.edges, "use_seam")
        write_attribute(mesh, SEAM_LAYER, "INT", "EDGE", chosen & ~seams)
        write_flags(mesh.edges, "use_seam", seams | chosen)
    show_flags(mesh)


def unmark_seams(mesh: bpy.types.Mesh) -> None:
    """Take back the seams that we marked, and no others."""
    if not has_marked_seams(mesh):
        return
    if mesh.is_editmode:
        edges = bmesh.from_edit_mesh(mesh).edges
        layer = edges.layers.int[SEAM_LAYER]
        for edge in edges:
            edge.seam = edge.seam and not edge[layer]
        edges.layers.int.remove(layer)
    else:
        seams = users_seams(mesh)
        mesh.attributes.remove(mesh.attributes[SEAM_LAYER])
        write_flags(mesh.edges, "use_seam", seams)
        for name in () if seams.any() else BLENDERS_LAYERS:
            if name in mesh.attributes:
                mesh.attributes.remove(mesh.attributes[name])
    show_flags(mesh)


def users_seams(mesh: bpy.types.Mesh) -> BoolArray:
    """Return which edges of a mesh in Object Mode are seams of the user's, (E,)."""
    seams = read_flags(mesh.edges, "use_seam")
    if has_marked_seams(mesh):
        seams &= read_ints(mesh.attributes[SEAM_LAYER].data, "value") == 0
    return seams


def _is_ours(attribute: bpy.types.Attribute) -> bool:
    """Return whether an attribute of our name can be our note."""
    return attribute.domain == "EDGE" and attribute.data_type == "INT"
