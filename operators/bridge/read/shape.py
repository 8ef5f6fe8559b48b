"""Read objects of Blender as shapes."""

from __future__ import annotations

import bpy
import numpy as np
from mathutils import Matrix

from ....core.errors import DecompositionError
from ....core.geometry.array_checks import check_surface
from ....core.geometry.mesh import TriangleMesh
from ....core.geometry.point_cloud import PointCloud
from ....core.geometry.shape import Shape
from ....core.steps.arrays import FloatArray
from ....core.steps.progress import Progress, Steps, as_steps, run
from ..mesh.attributes import vertex_positions
from ..mesh.known import triangles_in_steps
from ..mesh.layers import flush_edits
from ..mesh.points import is_cloud, normals_of, positions_of
from .converting import lent_mesh
from .place import place_now
from .stretching import scaling, sheared_scale, stretched, unstretched

# Factors of axes that differ by less, as a share, are equal in single precision.
_SAME_SCALE = 1e-5
# Scripts that write an infinite coordinate or location get this one.
_CLAMPED = np.finfo(np.float32).max


def read_shape(obj: bpy.types.Object) -> Shape:
    """Return at once what `shape_in_steps` returns."""
    return run(shape_in_steps(obj))


def shape_in_steps(obj: bpy.types.Object) -> Steps[Shape]:
    """Return the triangles of an object's mesh, without modifiers, or its points.

    Coordinates are in object space, in Blender units. If the object's scale differs by
    axis, or a parent shears it, they are multiplied by its `stretch`, because samples
    are spread over the shape that the user sees. Mirroring is left out: it changes no
    line of sight, and would turn the triangles inside out.

    All is read at once, so that the object may change before the steps are done.

    Raises
    ------
    DecompositionError
        At once, if an object has no usable faces or points, or no proper place.
    """
    matrix = stretch(obj)
    if is_cloud(obj):
        return as_steps(_cloud(obj, matrix))
    flush_edits(obj)
    with lent_mesh(obj) as mesh:
        return _mesh_in_steps(mesh, matrix)


def _cloud(obj: bpy.types.Object, matrix: FloatArray) -> PointCloud:
    """Return the points of an object, its coordinates multiplied by a stretch."""
    read = normals_of(obj)
    # Stretching tilts normals the other way.
    normals = None if read is None else unstretched(read.astype(np.float64), matrix)
    return PointCloud(stretched(positions_of(obj).astype(np.float64), matrix), normals)


def read_mesh(mesh: bpy.types.Mesh, matrix: FloatArray) -> TriangleMesh:
    """Return the triangles of a mesh, its coordinates multiplied by a stretch (3, 3).

    Raises
    ------
    DecompositionError
        If the mesh has no usable faces.
    """
    return run(_mesh_in_steps(mesh, matrix))


def _mesh_in_steps(mesh: bpy.types.Mesh, matrix: FloatArray) -> Steps[TriangleMesh]:
    """Return what `read_mesh` returns; the mesh is read and checked at once."""
    places = vertex_positions(mesh)
    places[np.abs(places) == _CLAMPED] = np.inf
    check_surface(places, len(mesh.polygons))
    read = triangles_in_steps(mesh, places)

    def work() -> Steps[TriangleMesh]:
        vertices, triangles, polygons = yield from read
        yield Progress("Surface", 0.0)
        vertices = stretched(vertices, matrix)
        vertices.flags.writeable = False  # as the others: the shape need not copy it
        return TriangleMesh(vertices, triangles, polygons)

    return work()


def stretch(obj: bpy.types.Object) -> FloatArray:
    """Return the matrix, (3, 3), that gives a mesh its proportions.

    It is symmetric: it turns nothing. Its determinant is 1: it keeps volumes, and
    lengths of 1 are about as long as in object space. It is diagonal if no parent
    shears the object, and the identity if the scale is uniform.

    Raises
    ------
    DecompositionError
        If the scale is zero, or the object's place is not finite.
    """
    scale, axes = _scale_of(obj)
    return scaling(_factors(scale), axes)


def _factors(scale: FloatArray) -> FloatArray:
    """Return a scale, (3,), without its size: the product is 1."""
    if scale.max() - scale.min() <= _SAME_SCALE * scale.max():
        return np.ones(3)
    factors: FloatArray = scale / np.cbrt(scale.prod())
    return factors


def scene_unit(obj: bpy.types.Object) -> float:
    """Return the length in the scene of 1 in the coordinates of `read_shape`.

    Raises
    ------
    DecompositionError
        As `stretch` does.
    """
    scale, _ = _scale_of(obj)
    return float((scale / _factors(scale)).max())


def has_place(obj: bpy.types.Object) -> bool:
    """Return whether an object's location, rotation and scale are finite numbers."""
    return _is_finite(obj.matrix_world)


def _is_finite(place: Matrix) -> bool:
    """Return whether all numbers of a place are finite."""
    return bool((np.abs(np.array(place)) < _CLAMPED).all())


def _scale_of(obj: bpy.types.Object) -> tuple[FloatArray, FloatArray]:
    """Return the scale of an object, (3,), without signs, and its axes.

    These are the columns of a matrix, (3, 3). Raise as `stretch` does.
    """
    place = place_now(obj)
    scale, axes = np.abs(np.array(place.to_scale(), dtype=float)), np.eye(3)
    if not (_is_finite(place) and np.isfinite(scale).all()):
        raise DecompositionError(
            "The object's location, rotation or scale, or its parent's, is not a"
            " number, or too large a one; type another in Sidebar > Item."
        )
    matrix = np.array(place, dtype=np.float64)[:3, :3]
    scale, axes = sheared_scale(matrix) or (scale, axes)
    if not scale.all():
        raise DecompositionError(
            "The object's scale is zero along an axis, or too near to it; give it"
            " another in Sidebar > Item."
        )
    return scale, axes


def has_proportions_of(obj: bpy.types.Object, other: bpy.types.Object) -> bool:
    """Return whether two objects with one mesh look alike but for their sizes.

    Raises
    ------
    DecompositionError
        As `stretch` does.
    """
    between = unstretched(stretch(obj), stretch(other))
    return np.allclose(between, np.eye(3), 0.0, _SAME_SCALE)


def have_equal_shapes(
    obj: bpy.types.Object, other: bpy.types.Object, of_equal_size: bool
) -> bool:
    """Return whether `read_shape` gives the same for two objects.

    If `of_equal_size`, they must have the same size in the scene, too.

    Raises
    ------
    DecompositionError
        As `stretch` does.
    """
    same = obj.data == other.data and has_proportions_of(obj, other)
    if not (same and of_equal_size):
        return same
    return bool(np.isclose(scene_unit(obj), scene_unit(other), _SAME_SCALE))
