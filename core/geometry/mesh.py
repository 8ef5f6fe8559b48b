"""Triangle meshes that can be decomposed: checked, read-only arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import DTypeLike, NDArray

from ..errors import DecompositionError
from ..steps.arrays import FloatArray, Int32Array, IntArray
from ..steps.memo import computed_once
from ..steps.progress import Progress, Steps, run, within
from ..steps.rows import blocks, used_rows
from .array_checks import (
    check_indices,
    check_size,
    check_surface,
    checked_numbers,
    rows_of_three,
)
from .frames import area_vectors
from .welding import welded

# Least total area, in squared diagonals. With less, faces are lines or points.
LEAST_AREA = 1e-9
# Cell size, in diagonals, of the grid that welds vertices. It allows for the rounding
# of equal positions to single precision.
SAME_PLACE = 1e-6


@dataclass(frozen=True, eq=False)
class TriangleMesh:
    """A surface of triangles that belong to polygons.

    It need not be closed, manifold or connected.

    Parameters
    ----------
    vertices : (V, 3) float
        In the units of the object.
    triangles : (T, 3) int
        Rows of `vertices`, counter-clockwise seen from outside.
    polygons : (T,) int
        Polygon of each triangle. In a mesh to decompose, every polygon 0…max has at
        least one.

    Raises
    ------
    TypeError
        If vertices are no numbers, or triangles or polygons no whole numbers.
    DecompositionError
        If an array has a wrong shape, there are no triangles, coordinates are not
        finite, indices are out of range, or `polygons` does not give a number to each
        triangle.

    Examples
    --------
    >>> from weak_convex_decomposition import TriangleMesh
    >>> corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    >>> square = TriangleMesh(corners, [(0, 1, 2), (0, 2, 3)], [0, 0])
    >>> square.n_polygons
    1
    """

    vertices: FloatArray
    triangles: IntArray
    polygons: IntArray

    def __post_init__(self) -> None:
        """Check the arrays and keep read-only copies of the right types."""
        vertices = _kept(rows_of_three(self.vertices, "Vertices"), np.float64)
        triangles = rows_of_three(self.triangles, "Triangles", whole=True)
        triangles = _kept(triangles, np.int64)
        polygons = checked_numbers(self.polygons, "Polygons", whole=True)
        polygons = _kept(polygons, np.int64)
        check_surface(vertices, len(triangles))
        check_indices(triangles, len(vertices))
        if polygons.shape != (len(triangles),) or polygons.min() < 0:
            raise DecompositionError(
                "The mesh needs one polygon number for each of its triangles."
            )
        for name, array in (
            ("vertices", vertices),
            ("triangles", triangles),
            ("polygons", polygons),
        ):
            array.flags.writeable = False
            object.__setattr__(self, name, array)

    @property
    def n_polygons(self) -> int:
        """Number of polygons."""
        return int(self.polygons.max()) + 1

    def with_polygons(self, polygons: IntArray) -> TriangleMesh:
        """Return the mesh with other numbers of polygons, (T,) int."""
        mesh = replace(self, polygons=polygons)
        # What is known does not depend on them.
        mesh.__dict__.update(self.__dict__ | {"polygons": mesh.polygons})
        return mesh

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lowest and highest corner, (3,) each, of the used vertices' bounding box."""
        return run(self.bounds_in_steps())

    @computed_once
    def bounds_in_steps(self) -> Steps[tuple[FloatArray, FloatArray]]:
        """Return `bounds`, found in short steps."""
        steps = used_rows(self.triangles, len(self.vertices))
        used = yield from within(steps, 0.0, 0.5)
        yield Progress("Surface", 0.5)
        rows: Any = slice(None) if used.all() else used
        columns = [self.vertices[rows, axis] for axis in range(3)]
        low, high = np.array([(each.min(), each.max()) for each in columns]).T
        return low, high

    @property
    def center(self) -> FloatArray:
        """Center of the bounding box, (3,)."""
        low, high = self.bounds
        return (high + low) / 2

    @cached_property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, in the units of the object."""
        return math.dist(*self.bounds)

    def normalized_in_steps(self) -> Steps[TriangleMesh]:
        """Return the mesh centered at the origin, with a bounding box of diagonal 1.

        Ray casters work in single precision, and tolerances are in diagonals.

        Returns
        -------
        Steps of TriangleMesh

        Raises
        ------
        DecompositionError
            If the faces have no area, the mesh is too large or too small to compute
            with, or some polygon has no triangle.
        """
        check_size(*(yield from within(self.bounds_in_steps(), 0.0, 0.2)))
        yield Progress("Surface", 0.2)
        complete = self.n_polygons <= len(self.triangles)
        if complete:
            steps = used_rows(self.polygons, self.n_polygons)
            complete = bool((yield from within(steps, 0.2, 0.3)).all())
        if not complete:
            raise DecompositionError(
                "The numbers of the polygons have gaps; count them 0, 1, 2 and so on,"
                " each with a triangle."
            )
        if self.diagonal > 0:
            vertices = self.vertices - self.center
            vertices /= self.diagonal
            yield Progress("Surface", 0.3)
            scaled = replace(self, vertices=vertices)
            yield from within(scaled.normals_in_steps(), 0.4, 1.0)
            if scaled.areas.sum() > LEAST_AREA:
                return scaled
        raise DecompositionError(
            "The faces have no area; choose an object with a surface."
        )

    @property
    def welded_triangles(self) -> Int32Array:
        """(T, 3) int32, position numbers of the corners, equal for coinciding vertices.

        Many file formats split vertices, and tools close a surface with vertices that
        differ by rounding.
        """
        return run(self.welded_in_steps())

    @computed_once
    def welded_in_steps(self) -> Steps[Int32Array]:
        """Return `welded_triangles`, found in short steps.

        Returns
        -------
        Steps of (T, 3) int32
        """
        yield from within(self.bounds_in_steps(), 0.0, 0.2)
        step = SAME_PLACE * self.diagonal or 1.0
        steps = welded(self.vertices, self.triangles, step)
        return (yield from within(steps, 0.2, 1.0))

    @property
    def areas(self) -> FloatArray:
        """(T,) areas of the triangles."""
        return run(self.normals_in_steps())[0]

    @property
    def normals(self) -> FloatArray:
        """(T, 3) outward unit normals of the triangles, 0 for degenerate ones."""
        return run(self.normals_in_steps())[1]

    @computed_once
    def normals_in_steps(self) -> Steps[tuple[FloatArray, FloatArray]]:
        """Return `areas` and `normals`, computed in short steps."""
        areas = np.empty(len(self.triangles))
        normals = np.empty_like(self.triangles, float)
        for rows in blocks(len(areas)):
            yield Progress("Surface", rows.start / len(areas))
            crosses = area_vectors(self.vertices[self.triangles[rows]])
            lengths = np.linalg.norm(crosses, axis=1)
            areas[rows] = lengths / 2
            lengths[lengths == 0] = 1.0
            normals[rows] = crosses / lengths[:, None]
        areas.flags.writeable = normals.flags.writeable = False
        return areas, normals


def _kept(array: NDArray[Any], dtype: DTypeLike) -> NDArray[Any]:
    """Return a copy of an array, or the array if it is a read-only one of that type."""
    shared = array.dtype == dtype and array.flags.owndata and not array.flags.writeable
    return array if shared else array.astype(dtype)
