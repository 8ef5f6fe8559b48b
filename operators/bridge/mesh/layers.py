"""Read and write face numbers, material indices and weights, in Object and Edit Mode.

In Edit Mode the mesh is a BMesh. It does not see what is written to attributes,
polygons or vertex groups, and has layers of its own instead.
"""

from __future__ import annotations

import bmesh
import bpy
import numpy as np

from ....core.steps.arrays import Float32Array, Int32Array
from .attributes import corner_vertices, read_attribute, write_attribute, write_floats
from .known import corner_faces
from .points import is_cloud


def flush_edits(obj: bpy.types.Object) -> None:
    """Copy what was done in Edit Mode to the object's mesh, to be read there."""
    if obj.mode == "EDIT":
        obj.update_from_editmode()


def let_undo_see_all(obj: bpy.types.Object) -> None:
    """Let the undo step of an operator that changes an object in Edit Mode hold it all.

    Such steps hold faces and their layers, and the whole file only if a data-block came
    or went. Groups, slots and notes come back with the file alone.
    """
    if obj.mode == "EDIT":
        # Nothing uses it, so Blender need not look for users in the whole file.
        bpy.data.materials.remove(bpy.data.materials.new("undo"), do_unlink=False)


class ObjectModeLayers:
    """The layers of an object in Object Mode."""

    _domain = "FACE"

    def __init__(self, obj: bpy.types.Object) -> None:
        self._obj = obj
        self._mesh = obj.data

    def material_indices(self) -> Int32Array | None:
        """Return the material index of each face, None if the mesh keeps none."""
        return self.faces("material_index")

    def set_material_indices(self, values: Int32Array | None) -> None:
        """Write the material index of each face; None removes them."""
        if values is None:
            self.remove("material_index")
        else:
            self.set_faces("material_index", values)

    def faces(self, name: str) -> Int32Array | None:
        """Return an attribute of whole numbers of the faces, None if there is none."""
        return read_attribute(self._mesh, name, "INT", self._domain)

    def set_faces(self, name: str, values: Int32Array) -> None:
        """Write an attribute of the faces."""
        write_attribute(self._mesh, name, "INT", self._domain, values)

    def corners(self) -> tuple[Int32Array, Int32Array]:
        """Return the vertex and the face of each corner, (C,) and (C,)."""
        return corner_vertices(self._mesh), corner_faces(self._mesh)

    def set_colors(self, name: str, colors: Float32Array) -> None:
        """Write an attribute of the corners, from a color for each face (P, 4)."""
        there = self._mesh.color_attributes
        attribute = there.get(name)
        kind = attribute and (attribute.data_type, attribute.domain)
        if kind != ("FLOAT_COLOR", "CORNER"):  # the user may have converted it
            self.remove(name)
            attribute = there.new(name, "FLOAT_COLOR", "CORNER")
        write_floats(attribute.data, "color", colors[corner_faces(self._mesh)])

    def remove(self, name: str) -> None:
        """Remove an attribute, of faces or points, if it is there."""
        attribute = self._mesh.attributes.get(name)
        if attribute is not None:
            self._mesh.attributes.remove(attribute)

    def fill_group(self, group: bpy.types.VertexGroup, vertices: list[int]) -> None:
        """Put vertices into a group with full weight."""
        group.add(vertices, 1.0, "REPLACE")

    def finish(self) -> None:
        """Tell Blender that the mesh has changed."""
        self._mesh.update()


class PointLayers(ObjectModeLayers):
    """The layers of a point cloud: its points stand for faces.

    All points have one material, which shows their colors.
    """

    _domain = "POINT"

    def material_indices(self) -> None:
        """Return None: there are none."""

    def set_material_indices(self, values: Int32Array | None) -> None:
        """Write nothing."""

    def finish(self) -> None:
        """Tell Blender that the points have changed."""
        self._obj.data.update_tag()


class EditModeLayers:
    """The layers of an object in Edit Mode."""

    def __init__(self, obj: bpy.types.Object) -> None:
        self._obj = obj
        self._bm = bmesh.from_edit_mesh(obj.data)

    def material_indices(self) -> Int32Array | None:
        """Return the material index of each face, None if all are 0."""
        values = np.array([f.material_index for f in self._bm.faces], dtype=np.int32)
        return values if values.any() else None

    def set_material_indices(self, values: Int32Array | None) -> None:
        """Write the material index of each face; None makes them all 0."""
        indices = [0] * len(self._bm.faces) if values is None else values.tolist()
        for face, index in zip(self._bm.faces, indices, strict=True):
            face.material_index = index

    def faces(self, name: str) -> Int32Array | None:
        """Return a layer of the faces, None if there is none."""
        layer = self._bm.faces.layers.int.get(name)
        if layer is None:
            return None
        return np.array([face[layer] for face in self._bm.faces], dtype=np.int32)

    def set_faces(self, name: str, values: Int32Array) -> None:
        """Write a layer of the faces."""
        layers = self._bm.faces.layers.int
        layer = layers.get(name) or layers.new(name)
        for face, value in zip(self._bm.faces, values.tolist(), strict=True):
            face[layer] = value

    def corners(self) -> tuple[Int32Array, Int32Array]:
        """Return the vertex and the face of each corner, (C,) and (C,)."""
        self._bm.verts.index_update()
        vertices = [[vertex.index for vertex in f.verts] for f in self._bm.faces]
        faces = np.repeat(np.arange(len(vertices)), [len(each) for each in vertices])
        return np.concatenate(vertices).astype(np.int32), faces.astype(np.int32)

    def set_colors(self, name: str, colors: Float32Array) -> None:
        """Write a layer of the corners, from a color for each face (P, 4)."""
        layers = self._bm.loops.layers.float_color
        layer = layers.get(name)
        if layer is None:
            self.remove(name)  # the user may have converted it
            layer = layers.new(name)
        for face, color in zip(self._bm.faces, colors.tolist(), strict=True):
            for corner in face.loops:
                corner[layer] = color

    def remove(self, name: str) -> None:
        """Remove a layer of faces, their corners or points, if it is there."""
        points, corners = self._bm.verts.layers, self._bm.loops.layers
        for layers in (
            self._bm.faces.layers.int,
            corners.float_color,
            corners.color,
            points.int,
            points.float_color,
            points.color,
            points.float_vector,
        ):
            layer = layers.get(name)
            if layer is not None:
                layers.remove(layer)

    def fill_group(self, group: bpy.types.VertexGroup, vertices: list[int]) -> None:
        """Put vertices into a group with full weight."""
        layer = self._bm.verts.layers.deform.verify()
        self._bm.verts.ensure_lookup_table()
        for index in vertices:
            self._bm.verts[index][layer][group.index] = 1.0

    def finish(self) -> None:
        """Tell Blender that the mesh has changed."""
        layer = self._bm.verts.layers.deform.active
        if layer is not None and not self._obj.vertex_groups:
            self._bm.verts.layers.deform.remove(layer)
        bmesh.update_edit_mesh(self._obj.data, loop_triangles=False, destructive=False)


def layers_of(obj: bpy.types.Object) -> ObjectModeLayers | EditModeLayers:
    """Return the layers of an object, for the mode it is in."""
    if is_cloud(obj):
        return PointLayers(obj)
    return EditModeLayers(obj) if obj.data.is_editmode else ObjectModeLayers(obj)
