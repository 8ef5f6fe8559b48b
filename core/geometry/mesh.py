"""Triangle meshes that can be decomposed: checked, read-only arrays."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from .array_checks import check_size, checked_numbers, rows_of_three

# Least total area, in squared diagonals. With less, faces are lines or points.
_LEAST_AREA = 1e-9
# Cell size, in diagonals, of the grid that welds vertices. It allows for the rounding
# of equal positions to single precision.
_SAME_PLACE = 1e-6
# Grid cells along each axis. They span more than two diagonals.
_CELLS = 2**21


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

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    polygons: NDArray[np.int64]

    def __post_init__(self) -> None:
        """Check the arrays and keep read-only copies of the right types."""
        vertices = rows_of_three(self.vertices, "Vertices").astype(np.float64)
        triangles = rows_of_three(self.triangles, "Triangles", whole=True)
        triangles = triangles.astype(np.int64)
        polygons = checked_numbers(self.polygons, "Polygons", whole=True)
        polygons = polygons.astype(np.int64)
        if len(triangles) == 0:
            raise DecompositionError(
                "The mesh has no faces; add faces or choose another object."
            )
        if not np.isfinite(vertices).all():
            raise DecompositionError(
                "The mesh has coordinates that are not finite numbers; delete or"
                " repair those vertices (Mesh > Clean Up)."
            )
        if triangles.min() < 0 or triangles.max() >= len(vertices):
            raise DecompositionError(
                "The mesh has faces that refer to missing vertices; repair it first."
            )
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

    @cached_property
    def bounds(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest and highest corner, (3,) each, of the used vertices' bounding box."""
        used = self.vertices[self.triangles.ravel()]
        return used.min(axis=0), used.max(axis=0)

    @property
    def center(self) -> NDArray[np.float64]:
        """Center of the bounding box, (3,)."""
        low, high = self.bounds
        center: NDArray[np.float64] = (high + low) / 2
        return center

    @cached_property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, in the units of the object."""
        low, high = self.bounds
        return float(np.linalg.norm(high - low))

    def normalized(self) -> TriangleMesh:
        """Return the mesh centered at the origin, with a bounding box of diagonal 1.

        Ray casters work in single precision, and tolerances are in diagonals.

        Returns
        -------
        TriangleMesh

        Raises
        ------
        DecompositionError
            If the faces have no area, the mesh is too large or too small to compute
            with, or some polygon has no triangle.
        """
        check_size(*self.bounds)
        n_triangles = len(self.triangles)
        if self.n_polygons > n_triangles or not np.bincount(self.polygons).all():
            raise DecompositionError(
                "The numbers of the polygons have gaps; count them 0, 1, 2 and so on,"
                " each with a triangle."
            )
        if self.diagonal > 0:
            scale = self.diagonal
            scaled = replace(self, vertices=(self.vertices - self.center) / scale)
            if scaled.areas.sum() > _LEAST_AREA:
                return scaled
        raise DecompositionError(
            "The faces have no area; choose an object with a surface."
        )

    @cached_property
    def welded_triangles(self) -> NDArray[np.int64]:
        """(T, 3) int, position numbers of the corners, equal for coinciding vertices.

        Many file formats split vertices, and tools close a surface with vertices that
        differ by rounding.
        """
        center = self.vertices[self.triangles.ravel()].mean(axis=0)
        step = _SAME_PLACE * self.diagonal or 1.0
        rounded = np.round((self.vertices - center) / step).astype(np.int64)
        # One number sorts faster than three. Only vertices that no face uses lie
        # outside the grid.
        cells = np.clip(rounded + _CELLS // 2, 0, _CELLS - 1)
        places = cells @ (_CELLS**2, _CELLS, 1)
        _, place_of = np.unique(places, return_inverse=True)
        welded: NDArray[np.int64] = place_of.reshape(-1)[self.triangles]
        return welded

    @property
    def edge_keys(self) -> NDArray[np.int64]:
        """(3T,) int, numbers of the triangles' sides, equal for sides of one edge."""
        tails = self.welded_triangles
        heads = np.roll(tails, -1, axis=1)
        keys = np.minimum(tails, heads) * (tails.max() + 1) + np.maximum(tails, heads)
        return keys.ravel()

    @cached_property
    def _cross_products(self) -> NDArray[np.float64]:
        """(T, 3) normals of the triangles; their length is twice the area."""
        a, b, c = np.moveaxis(self.vertices[self.triangles], 1, 0)
        return np.cross(b - a, c - a)

    @cached_property
    def areas(self) -> NDArray[np.float64]:
        """(T,) areas of the triangles."""
        areas: NDArray[np.float64] = np.linalg.norm(self._cross_products, axis=1) / 2
        return areas

    @cached_property
    def normals(self) -> NDArray[np.float64]:
        """(T, 3) outward unit normals of the triangles, 0 for degenerate ones."""
        lengths = 2 * self.areas[:, None]
        normals: NDArray[np.float64] = np.divide(
            self._cross_products,
            lengths,
            out=np.zeros_like(self._cross_products),
            where=lengths > 0,
        )
        return normals
