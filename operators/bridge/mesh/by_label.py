"""What the faces of each label have together: vertices, areas and centers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import bmesh
import bpy
import numpy as np
from numpy.typing import NDArray

from ....core.steps.arrays import Float32Array, FloatArray
from ....core.steps.memo import digest
from ....core.steps.progress import Progress, Steps, run, within
from ....core.steps.rows import blocks
from .attributes import corner_vertices
from .known import SLOW, corner_faces, face_areas, face_centers, finite, latest_of
from .points import is_cloud, vertices_now

# Bytes for which vertices each label has: all labels at once are quicker.
_ROOM = 2**26


@dataclass(frozen=True, eq=False)
class ByLabel:
    """What labels of faces, or of points, have on an object.

    Attributes
    ----------
    vertices : sequence of list of int
        The vertices of the faces of each label.
    sums : (K, 5) float
        See `sums_by_label`.
    """

    vertices: Sequence[list[int]]
    sums: FloatArray

    @classmethod
    def of(
        cls, obj: bpy.types.Object, labels: NDArray[np.integer], n_labels: int
    ) -> ByLabel:
        """Return what labels 0…K − 1 of the faces have on an object now.

        It was computed before if `read_ahead` was told these labels.
        """
        mesh = obj.data
        has_faces = bool(getattr(mesh, "polygons", None))
        known = latest_of(mesh) if has_faces else None
        key = digest(labels), n_labels
        if known is not None and key in known.ahead:
            return known.ahead.pop(key)
        sums = sums_by_label(obj, labels, n_labels)
        if has_faces:
            vertices, faces = corner_vertices(mesh), corner_faces(mesh)
        else:
            vertices = faces = np.arange(len(labels))
        return cls(run(_vertices(vertices, faces, labels, n_labels)), sums)

    def in_order(self, order: NDArray[np.integer]) -> ByLabel:
        """Return the same for labels in another order."""
        vertices = [self.vertices[label] for label in order]
        return replace(self, vertices=vertices, sums=self.sums[order])


def read_ahead(
    find: Callable[[], bpy.types.Object], labels: NDArray[np.integer], n_labels: int
) -> Steps[None]:
    """Compute in steps what `ByLabel.of` will return, if it is of the latest mesh.

    Parameters
    ----------
    find : callable
        Returns the object, or raises if it is gone.
    labels : (P,) int
    n_labels : int
    """
    yield Progress("Writing", 0.0)
    mesh = find().data
    plain = isinstance(mesh, bpy.types.Mesh) and not mesh.is_editmode
    known = latest_of(mesh) if plain else None
    if known is None:
        return
    for name in (name for name in SLOW if name not in known.asked):
        yield Progress("Writing", 0.1)
        if latest_of(find().data) is not known:
            return
        known.read(find().data, name)
    places = known.asked["areas"], known.asked["centers"]
    sums = yield from within(_sums(labels, n_labels, *places), 0.5, 0.7)
    faces = known.asked["corner_faces"]
    finding = _vertices(known.corners, faces, labels, n_labels)
    found = ByLabel((yield from within(finding, 0.7, 1.0)), sums)
    known.ahead.clear()
    known.ahead[digest(labels), n_labels] = found


def sums_by_label(
    obj: bpy.types.Object, labels: NDArray[np.integer], n_labels: int
) -> FloatArray:
    """Return the number of faces of each label, their area and their center.

    Parameters
    ----------
    obj : bpy.types.Object
    labels : (P,) int
        Label of each face, or point; points have an area of 1 each.
    n_labels : int

    Returns
    -------
    (K, 5) float
    """
    if is_cloud(obj) or not obj.data.is_editmode:
        return run(_sums(labels, n_labels, *_areas_and_centers(obj)))
    faces = bmesh.from_edit_mesh(obj.data).faces
    areas = finite(np.array([face.calc_area() for face in faces]))
    centers = finite(np.array([face.calc_center_median() for face in faces]))
    return run(_sums(labels, n_labels, areas, centers))


def sums_of_all(obj: bpy.types.Object) -> FloatArray:
    """Return the same of all faces, or points, of an object together, (5,).

    It is quick. So in Edit Mode only the number of faces is surely that of now: areas
    and centers may be from before the latest edits.
    """
    areas, centers = _areas_and_centers(obj)
    labels = np.zeros(len(areas), dtype=np.int64)
    sums: FloatArray = run(_sums(labels, 1, areas, centers))[0]
    if not is_cloud(obj) and obj.data.is_editmode:
        sums[0] = len(bmesh.from_edit_mesh(obj.data).faces)
    return sums


def areas_of(obj: bpy.types.Object, n_elements: int) -> NDArray[np.floating]:
    """Return the area of each face, or point; points have an area of 1 each."""
    if is_cloud(obj):
        return np.ones(n_elements, dtype=np.float32)
    return face_areas(obj.data)


def _areas_and_centers(
    obj: bpy.types.Object,
) -> tuple[NDArray[np.floating], Float32Array]:
    """Return the area (P,) and center (P, 3) of each face, or point."""
    centers = vertices_now(obj) if is_cloud(obj) else face_centers(obj.data)
    return areas_of(obj, len(centers)), centers


def _sums(
    labels: NDArray[np.integer],
    n_labels: int,
    areas: NDArray[np.floating],
    centers: NDArray[np.floating],
) -> Steps[FloatArray]:
    """Return what `sums_by_label` does, of faces with these areas and centers."""
    yield Progress("Writing", 0.0)
    areas = areas.astype(np.float64)
    counts = np.bincount(labels, minlength=n_labels)
    totals = np.bincount(labels, areas, n_labels)
    weights, middles = np.maximum(totals, np.finfo(float).tiny), []
    for axis, column in enumerate(centers.T):
        yield Progress("Writing", 0.25 * (axis + 1))
        middles.append(np.bincount(labels, areas * column, n_labels) / weights)
    return np.stack([counts, totals, *middles], axis=1)


def _vertices(
    vertices: NDArray[np.integer],
    faces: NDArray[np.integer],
    labels: NDArray[np.integer],
    n_labels: int,
) -> Steps[list[list[int]]]:
    """Return the vertices of the faces that have each label 0…K − 1.

    Parameters
    ----------
    vertices, faces : (C,) int
        Vertex and face of each corner.
    labels : (P,) int
    n_labels : int
    """
    n_vertices = int(vertices.max(initial=-1)) + 1
    at_once = max(_ROOM // max(n_vertices, 1), 1)
    found: list[list[int]] = []
    for first in range(0, n_labels, at_once):
        members = np.zeros((min(at_once, n_labels - first), n_vertices), dtype=bool)
        for rows in blocks(len(vertices)):
            yield Progress("Writing", first / n_labels)
            of_corners, here = labels[faces[rows]] - first, vertices[rows]
            if len(members) < n_labels:
                fit = (of_corners >= 0) & (of_corners < len(members))
                of_corners, here = of_corners[fit], here[fit]
            members.reshape(-1)[of_corners * n_vertices + here] = True  # quicker flat
        for of_label in members:
            yield Progress("Writing", first / n_labels)
            found.append(np.flatnonzero(of_label).tolist())
    return found
