"""Cut faces of a mesh along planes. Blender carries UVs, colors and weights over."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bmesh
import bpy
import numpy as np
from bmesh.types import BMFace, BMVert
from mathutils.geometry import intersect_point_line

from ....core.geometry.cutting.refined import Cut
from ....core.geometry.mesh import TriangleMesh
from ....core.steps.arrays import FloatArray, IntArray
from ..mesh.attributes import vertex_positions
from ..mesh.corner_normals import give_back_normals, keep_normals
from ..read.stretching import stretched, unstretched

# Layers of faces while they are cut: the number of the whole face, that of the triangle
# if the whole face is bent, and the part.
_WHOLE, _FLAT_FACE, _PART = "wcd_whole", "wcd_flat_face", "wcd_piece"
# Farthest that a corner is from the plane of a flat face, in diagonals of the mesh.
_FLAT = 1e-6
# Farthest that a vertex is from a straight edge that it was made on, in the largest
# coordinate: Blender rounds each place a few times, to single precision.
_STRAIGHT = 4 * float(np.finfo(np.float32).eps)


class CutMesh:
    """A copy of a mesh in memory whose faces are cut; nothing in the file changes.

    Parameters
    ----------
    mesh : bpy.types.Mesh
        In Object Mode.
    stretch : (3, 3) float
        What coordinates are multiplied by in the space of the planes.

    Attributes
    ----------
    stretch : (3, 3) float
    """

    def __init__(self, mesh: bpy.types.Mesh, stretch: FloatArray) -> None:
        self.stretch = stretch
        self._bm = bm = bmesh.new()
        bm.from_mesh(mesh)
        keep_normals(bm, mesh)
        for name in (_WHOLE, _FLAT_FACE, _PART):
            bm.faces.layers.int.new(name)
        layers = bm.faces.layers.int
        self._part, self._whole = layers[_PART], layers[_WHOLE]
        self._flat_face = layers[_FLAT_FACE]
        for number, face in enumerate(bm.faces):
            face[self._whole] = face[self._flat_face] = number
        self._old = set(bm.verts)
        places = vertex_positions(mesh)
        self._flat = _FLAT * float(np.linalg.norm(np.ptp(places, axis=0)))
        self._straight = _STRAIGHT * float(np.abs(places).max())

    def cut(self, cuts: Sequence[Cut], near: float) -> None:
        """Cut faces along planes.

        Parameters
        ----------
        cuts : sequence of Cut
            Their faces are those of the mesh as it was read.
        near : float
            A plane that is this near to a corner of a face runs through the corner.
        """
        pieces: dict[int, list[BMFace]] = {
            number: [face] for number, face in enumerate(self._bm.faces)
        }
        self._flatten(pieces, cuts)
        for cut in cuts:
            faces = [piece for face in cut.faces.tolist() for piece in pieces[face]]
            normal = stretched(cut.normal, self.stretch)
            length = float(np.linalg.norm(normal))
            # In a fixed order, so that cutting again gives the same.
            edges = dict.fromkeys(edge for face in faces for edge in face.edges)
            vertices = dict.fromkeys(vertex for edge in edges for vertex in edge.verts)
            made = bmesh.ops.bisect_plane(
                self._bm,
                geom=[*vertices, *edges, *faces],
                dist=near / length,
                plane_co=unstretched(cut.point, self.stretch),
                plane_no=normal / length,
            )["geom"]
            for face in cut.faces.tolist():
                pieces[face] = []
            for each in made:
                if isinstance(each, BMFace):
                    pieces[each[self._whole]].append(each)

    def _flatten(self, pieces: dict[int, list[BMFace]], cuts: Sequence[Cut]) -> None:
        """Divide bent faces into the triangles they are drawn with, where cuts run.

        A new corner on the edge of a bent face would change its shape.
        """
        reached: set[BMFace] = set()
        for number in {face for cut in cuts for face in cut.faces.tolist()}:
            for edge in pieces[number][0].edges:
                reached.update(edge.link_faces)
        bent = [face for face in reached if self._is_bent(face)]
        bent.sort(key=lambda face: face[self._whole])
        numbers, n_wholes = {face[self._whole] for face in bent}, len(pieces)
        triangles = bmesh.ops.triangulate(
            self._bm, faces=bent, quad_method="FIXED", ngon_method="EAR_CLIP"
        )["faces"]
        for number in numbers:
            pieces[number] = []
        for number, face in enumerate(triangles, start=n_wholes):
            face[self._flat_face] = number
            pieces[face[self._whole]].append(face)

    def _is_bent(self, face: BMFace) -> bool:
        """Return whether the corners of a face are not in a plane."""
        if len(face.verts) == 3:
            return False
        start, normal = face.verts[0].co, face.normal
        away = max(abs((vertex.co - start).dot(normal)) for vertex in face.verts)
        return away > self._flat

    def __enter__(self) -> CutMesh:
        """Return the copy, which is freed at the end."""
        return self

    def __exit__(self, *_: object) -> None:
        """Free the copy."""
        self._bm.free()

    def wholes(self) -> IntArray:
        """Return the face of the mesh as it was read that each piece is of, (P,)."""
        return np.array([face[self._whole] for face in self._bm.faces])

    def areas(self) -> FloatArray:
        """Return the area of each piece, (P,), in the space of the mesh."""
        return np.array([face.calc_area() for face in self._bm.faces])

    def parts(self) -> IntArray:
        """Return the part of each piece, as given to `join`, (P,)."""
        return np.array([face[self._part] for face in self._bm.faces])

    def triangles(self) -> TriangleMesh:
        """Return the pieces as triangles, in the space of the planes."""
        bm = self._bm
        bm.verts.index_update()
        bm.faces.index_update()
        corners = bm.calc_loop_triangles()
        return TriangleMesh(
            stretched(np.array([vertex.co for vertex in bm.verts]), self.stretch),
            np.array([[corner.vert.index for corner in each] for each in corners]),
            np.array([each[0].face.index for each in corners]),
        )

    def join(self, parts: Iterable[int]) -> None:
        """Join pieces of one flat face and one part again.

        Bends of seams stay where they are.

        Parameters
        ----------
        parts : iterable of int
            Part of each piece.
        """
        for face, part in zip(self._bm.faces, parts, strict=True):
            face[self._part] = part
        needless = [edge for edge in self._bm.edges if self._is_needless(edge)]
        bmesh.ops.dissolve_edges(self._bm, edges=needless, use_verts=False)
        bmesh.ops.dissolve_verts(self._bm, verts=self._needless_vertices())

    def _needless_vertices(self) -> list[BMVert]:
        """Return the new vertices that only divide a straight edge.

        Without them each face still has three corners or more, so that none goes.
        """
        ends = {
            vertex: [edge.other_vert(vertex) for edge in vertex.link_edges]
            for vertex in self._bm.verts
            if vertex not in self._old and len(vertex.link_edges) == 2
        }
        needless, n_corners = [], {face: len(face.verts) for face in self._bm.faces}
        for vertex, (one, other) in ends.items():
            faces = vertex.link_faces
            if min((n_corners[face] for face in faces), default=0) <= 3:
                continue
            if not self._is_between(vertex, one, other):
                continue
            needless.append(vertex)
            for face in faces:
                n_corners[face] -= 1
            for end, next_end in ((one, other), (other, one)):
                if end in ends:
                    ends[end][ends[end].index(vertex)] = next_end
        return needless

    def _is_between(self, vertex: BMVert, one: BMVert, other: BMVert) -> bool:
        """Return whether a vertex is on the straight line from one to another."""
        nearest, share = intersect_point_line(vertex.co, one.co, other.co)
        return 0 <= share <= 1 and (vertex.co - nearest).length <= self._straight

    def _is_needless(self, edge: bmesh.types.BMEdge) -> bool:
        """Return whether a cut separates no parts."""
        faces, layers = edge.link_faces, (self._flat_face, self._part)
        if len(faces) != 2:
            return False
        return all(faces[0][layer] == faces[1][layer] for layer in layers)

    def write(self, mesh: bpy.types.Mesh) -> None:
        """Write the cut faces to a mesh, a copy of the one that was read."""
        layers = self._bm.faces.layers.int
        for name in (_WHOLE, _FLAT_FACE, _PART):
            layers.remove(layers[name])
        self._bm.to_mesh(mesh)
        give_back_normals(mesh)
        mesh.update()
