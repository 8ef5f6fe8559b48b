"""Faces that parts were found on, and that an object gets together with them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

import bpy
import numpy as np

from ....core.geometry.cutting.refined import Cut
from ....core.steps.arrays import Float32Array, FloatArray, IntArray
from ..mesh.attributes import read_floats, vertex_positions
from ..stored.names import WHOLE_MESH
from .cut_mesh import CutMesh
from .whole_mesh import (
    forget_whole,
    note_whole,
    put_back,
    replace_mesh,
    whole_faces,
    whole_mesh_of,
)


@dataclass(frozen=True, eq=False)
class Pieces:
    """How the whole faces of a mesh are cut; cutting again gives the same.

    Attributes
    ----------
    cuts : sequence of Cut
    near : float
        A plane that is this near to a corner runs through it.
    stretch : (3, 3) float
        What coordinates are multiplied by in the space of the planes.
    parts : (N,) int
        Part of each piece after all cuts. Pieces of one face and one part are joined.
    """

    cuts: list[Cut]
    near: float
    stretch: FloatArray
    parts: IntArray

    @contextmanager
    def of(self, mesh: bpy.types.Mesh) -> Iterator[CutMesh]:
        """Give a mesh with its faces cut, in memory."""
        with CutMesh(mesh, self.stretch) as made:
            made.cut(self.cuts, self.near)
            made.join(self.parts.tolist())
            yield made


@dataclass(frozen=True, eq=False)
class NewFaces:
    """The faces of an object after its whole faces were cut, or without any cut.

    Attributes
    ----------
    n_wholes : int
        Number of whole faces.
    places : (V, 3) float32
        The vertices of the whole faces: cuts fit no others.
    wholes : (P,) int
        Whole face that each face is of.
    areas : (P,) float
        Area of each face.
    pieces : Pieces or None
        How the whole faces are cut; None if they are not.
    """

    n_wholes: int
    places: Float32Array
    wholes: IntArray
    areas: FloatArray
    pieces: Pieces | None

    def former_labels(self, obj: bpy.types.Object, labels: IntArray) -> IntArray:
        """Return the label that each face has on an object with other faces, (P,).

        It is that of the largest piece of the same whole face. The object has `labels`
        (Q,) on its faces now.
        """
        wholes, areas = whole_faces(obj), read_floats(obj.data.polygons, "area")
        covered = np.zeros((self.n_wholes, int(labels.max()) + 1))
        np.add.at(covered, (wholes, labels), areas)
        found: IntArray = covered.argmax(axis=1)[self.wholes]
        return found

    def fit(self, obj: bpy.types.Object) -> bool:
        """Return whether these are faces of an object, which has not changed since."""
        whole = whole_mesh_of(obj)
        same = np.array_equal(vertex_positions(whole), self.places)
        return same and len(whole.polygons) == self.n_wholes

    def put_on(self, obj: bpy.types.Object) -> None:
        """Give an object without parts these faces."""
        former, whole = obj.data, whole_mesh_of(obj)
        if whole == former:
            forget_whole(former)
        if self.pieces is None:
            if whole != former:
                put_back(obj, whole)
            return
        mesh = whole.copy()
        with self.pieces.of(whole) as made:
            made.write(mesh)
        mesh[WHOLE_MESH] = whole
        replace_mesh(obj, mesh)
        note_whole(obj, self.wholes)
