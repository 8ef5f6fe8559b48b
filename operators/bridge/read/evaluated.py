"""Meshes as Blender shows them: with modifiers, shape keys and poses.

While such a mesh is made, its faces carry the numbers of the faces that they come from.
So parts of what is seen can be written to the faces of the mesh itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.mesh import TriangleMesh
from ....core.results.parts import Decomposition
from ....core.steps.arrays import BoolArray, Float32Array, FloatArray, IntArray
from ..mesh.attributes import read_floats, read_labels, write_ints
from ..mesh.known import triangles_of
from ..stored.long_names import carrier_name
from ..stored.record import EVALUATED, ORIGINAL
from .shape import stretch
from .shown_mesh import count_instances, differs, evaluated
from .stretching import stretched

# Carries face numbers, counted from 1, while a mesh is evaluated; 0 is no face.
_LAYER = "wcd_face"
# Faces correspond if so much of the area that is seen comes from faces of the mesh,
# and so many of these are seen.
_MOST = 0.9


@dataclass(frozen=True, eq=False)
class SeenMesh:
    """The mesh of an object as it is seen.

    Attributes
    ----------
    shape : TriangleMesh
        In the space of `read_shape`.
    areas, origins : (E,) float and int
        Area of each face, and the face of the object's own mesh that it comes from.
    own_areas, stand_ins : (P,) float and int
        Area of each face of the object's own mesh, and the face that it takes its part
        from: itself, or the nearest one that is seen.
    corresponds : bool
        Whether parts can be written to the object's own faces.
    n_left_out : int
        Number of instances that are seen and were not read.
    name : str
        Of the object.
    """

    shape: TriangleMesh
    areas: FloatArray
    origins: IntArray
    own_areas: FloatArray
    stand_ins: IntArray
    corresponds: bool
    n_left_out: int
    name: str

    def notes(self, for_parts: bool = True) -> tuple[str, ...]:
        """Return sentences about what was read; hulls bring none about parts."""
        where = f"The evaluated mesh was read, with {len(self.areas):,} faces"
        own = f"the {len(self.own_areas):,} faces of the mesh"
        if for_parts and self.corresponds:
            where += f" that come from {own}: these have the parts"
        elif for_parts:
            where += (
                f" that do not come from {own}: the parts are on the new object"
                f' "{carrier_name(self.name)}", and {self.name} is hidden'
            )
        return (f"{where}.", *_leaving_out(self.n_left_out))

    def on_own_faces(self, found: Decomposition) -> Decomposition:
        """Return parts of the faces that are seen as parts of the mesh's own faces.

        A face that several parts share goes to the one that has most of its area.
        """
        if not self.corresponds:
            return found
        faces, parts, counts = core.labels_by_area(
            found.labels, self.origins, self.areas
        )
        every = np.zeros(len(self.own_areas), dtype=np.int64)
        every[faces] = parts
        kept, labels = np.unique(every[self.stand_ins], return_inverse=True)
        places = np.full(found.n_parts, -1)
        places[kept] = np.arange(len(kept))
        return replace(
            found,
            labels=labels,
            areas=np.bincount(labels, self.own_areas).astype(np.float64),
            ranks=found.ranks[kept],
            pairs=found.pairs_at(places),
            notes=(*found.notes, *_sharing(counts, found.n_parts - len(kept))),
        )


def _leaving_out(n_instances: int) -> tuple[str, ...]:
    """Return a note on instances that were not read."""
    if not n_instances:
        return ()
    instances = "1 instance" if n_instances == 1 else f"{n_instances:,} instances"
    return (
        f"{instances} of other objects, such as particles, were left out; make objects"
        " of them (Object > Apply > Make Instances Real) to include them.",
    )


def _sharing(counts: IntArray, n_lost: int) -> tuple[str, ...]:
    """Return a note on faces that several parts share, and on parts without faces."""
    n_shared = int((counts > 1).sum())
    if not n_shared:
        return ()
    faces = "face of the mesh is" if n_shared == 1 else "faces of the mesh are"
    lost = f"; {n_lost} {'part' if n_lost == 1 else 'parts'} got none" if n_lost else ""
    return (
        f"{n_shared:,} {faces} seen in several parts; the part with most of the area"
        f" got it{lost}.",
    )


def which_mesh(mesh: str, obj: bpy.types.Object) -> str:
    """Return `mesh`, or the original one where what is seen does not differ from it."""
    return mesh if mesh == EVALUATED and differs(obj) else ORIGINAL


def read_as(mesh: str, obj: bpy.types.Object) -> SeenMesh | None:
    """Return the mesh of an object as it is seen, None if its own is to be read.

    Raises
    ------
    DecompositionError
        If the object is in Edit Mode or hidden, or nothing of it is seen.
    """
    if which_mesh(mesh, obj) == ORIGINAL:
        return None
    _check_readable(obj)
    own = obj.data.polygons
    own_areas = read_floats(own, "area").astype(np.float64)
    own_centers = read_floats(own, "center", 3)
    with _numbered(obj) as name, evaluated(obj) as (found, depsgraph):
        shown = found.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph)
        if not shown.polygons:
            raise DecompositionError(
                f"No faces of {obj.name} are seen; look at its modifiers, or set Mesh"
                " to Original."
            )
        vertices, triangles, polygons = triangles_of(shown)
        areas = read_floats(shown.polygons, "area").astype(np.float64)
        centers = read_floats(shown.polygons, "center", 3)
        origins = read_labels(shown, name, missing=0).astype(np.int64) - 1
        n_left_out = count_instances(obj, depsgraph)
    known = (origins >= 0) & (origins < len(own))
    seen = np.zeros(len(own), dtype=bool)
    seen[origins[known]] = True
    corresponds = known.any() and (
        seen.mean() >= _MOST and areas[known].sum() >= _MOST * areas.sum()
    )
    if corresponds:
        origins = origins[_nearest(centers, known)]
    return SeenMesh(
        TriangleMesh(stretched(vertices, stretch(obj)), triangles, polygons),
        areas,
        origins,
        own_areas,
        _nearest(own_centers, seen) if corresponds else np.arange(len(own)),
        bool(corresponds),
        n_left_out,
        obj.name,
    )


def _check_readable(obj: bpy.types.Object) -> None:
    """Raise if an object is in Edit Mode, or Blender does not evaluate it."""
    if obj.mode != "OBJECT" or not obj.visible_get():
        raise DecompositionError(
            f"The evaluated mesh of {obj.name} is read in Object Mode while it is"
            " visible; leave Edit Mode and show it, or set Mesh to Original."
        )


def _nearest(places: Float32Array, chosen: BoolArray) -> IntArray:
    """Return the row of the nearest place that is chosen, for each of N places."""
    from scipy.spatial import cKDTree

    rows = np.flatnonzero(chosen)
    nearest = np.arange(len(places))
    if len(rows) < len(places):
        nearest[~chosen] = rows[cKDTree(places[rows]).query(places[~chosen])[1]]
    return nearest


@contextmanager
def _numbered(obj: bpy.types.Object) -> Iterator[str]:
    """Have the faces of a mesh carry their numbers; give the name of the attribute."""
    with _writable_mesh(obj) as mesh:
        attributes = mesh.attributes
        active = attributes.active_index
        layer = attributes.new(_LAYER, "INT", "FACE")
        name = layer.name
        write_ints(layer.data, "value", np.arange(1, len(mesh.polygons) + 1))
        try:
            yield name
        finally:
            attributes.remove(attributes[name])
            attributes.active_index = active
            mesh.update()


@contextmanager
def _writable_mesh(obj: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """Give the mesh of an object, or a copy that it has meanwhile.

    Blender ignores what is written to the mesh itself if that is from a library.
    """
    mesh = obj.data
    if mesh.is_editable:
        yield mesh
        return
    obj.data = mesh.copy()
    try:
        yield obj.data
    finally:
        copy, obj.data = obj.data, mesh
        bpy.data.meshes.remove(copy)
