"""Convex collision shapes: hulls, boxes, spheres, cylinders and capsules."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..steps.arrays import FloatArray, IntArray
from .frames import HEIGHTS_AT_ONCE, area_vectors, coordinates_along


def _protect(*arrays: NDArray[Any]) -> None:
    """Make arrays read-only: results share them."""
    for array in arrays:
        array.flags.writeable = False


@dataclass(frozen=True, eq=False, repr=False)
class Hull:
    """A convex polyhedron. Its arrays are read-only.

    Attributes
    ----------
    vertices : (V, 3) float
    facets : (F, 3) int
        Rows of `vertices`: the corners of each triangle, whichever way around.
    planes : (F, 4) float
        Outward unit normal n and offset d of each triangle: n · x + d ≤ 0 inside.
    volume : float
        In cubed units of `vertices`.
    is_thickened : bool
        Whether it is around flat points, which were given a thickness.
    """

    vertices: FloatArray
    facets: IntArray
    planes: FloatArray
    volume: float
    is_thickened: bool = False

    def __post_init__(self) -> None:
        """Protect the arrays."""
        _protect(self.vertices, self.facets, self.planes)

    @cached_property
    def triangles(self) -> IntArray:
        """(F, 3) corners of each triangle, counter-clockwise seen from outside."""
        normals = area_vectors(self.vertices[self.facets])
        inwards = np.einsum("fd,fd->f", normals, self.planes[:, :3]) < 0
        triangles = self.facets.astype(np.int64)
        triangles[inwards] = triangles[inwards, ::-1]
        _protect(triangles)
        return triangles

    def heights(self, points: FloatArray) -> FloatArray:
        """Return the height of points above their highest face plane, negative inside.

        Outside, it is a lower bound of the distance to the hull.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) float
        """
        return self.heights_of_patches(points[:, None])

    def heights_of_patches(self, corners: FloatArray) -> FloatArray:
        """Return the height above one plane that patches reach with all corners.

        Parameters
        ----------
        corners : (M, C, 3) float

        Returns
        -------
        (M,) float
            The largest for any plane: no point of the patch is deeper in the hull.
        """
        m, c = corners.shape[:2]
        highest = np.empty(m)
        normals, offsets = np.ascontiguousarray(self.planes[:, :3]), self.planes[:, 3:]
        step = max(HEIGHTS_AT_ONCE // (c * len(normals)), 1)
        for start in range(0, m, step):  # corner by corner: NumPy's minima take less
            some = corners[start : start + step].swapaxes(0, 1).reshape(-1, 3)
            heights = (normals @ some.T + offsets).reshape(len(normals), c, -1)
            lowest = heights.min(axis=1) if c > 1 else heights[:, 0]
            highest[start : start + step] = lowest.max(axis=0)
        return highest

    @cached_property
    def bounds(self) -> FloatArray:
        """(2, 3) lowest and highest coordinates."""
        bounds = np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])
        _protect(bounds)
        return bounds

    @cached_property
    def corners(self) -> FloatArray:
        """(F, 3, 3) corners of the triangles."""
        corners: FloatArray = self.vertices[self.triangles]
        _protect(corners)
        return corners

    def __repr__(self) -> str:
        """Return a one-line summary."""
        return f"Hull({len(self.vertices)} vertices, volume {self.volume:.4g})"


@dataclass(frozen=True, eq=False, repr=False)
class CollisionShape:
    """A convex shape around a piece: a hull, or one of four primitives.

    Its arrays are read-only.

    Attributes
    ----------
    kind : str
        'HULL', 'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.
    hull : Hull
        The shape itself if `kind` is 'HULL', else the convex hull that the primitive
        encloses.
    center : (3,) float
    axes : (3, 3) float
        Axes of the shape as rows, right-handed. Cylinders and capsules lie along the
        last one.
    sizes : (3,) float
        Box: half of each side. Others: radius, radius, half of the height. The height
        of a capsule excludes its round ends; that of a sphere is 0.
    """

    kind: str
    hull: Hull
    center: FloatArray
    axes: FloatArray
    sizes: FloatArray

    def __post_init__(self) -> None:
        """Protect the arrays."""
        _protect(self.center, self.axes, self.sizes)

    @property
    def volume(self) -> float:
        """Volume of the shape, in cubed units of `sizes`."""
        a, b, half = self.sizes
        ball = 4 / 3 * np.pi * a**3
        return {
            "HULL": self.hull.volume,
            "BOX": float(8 * a * b * half),
            "SPHERE": float(ball),
            "CYLINDER": float(2 * np.pi * a**2 * half),
            "CAPSULE": float(2 * np.pi * a**2 * half + ball),
        }[self.kind]

    def heights(self, points: FloatArray) -> FloatArray:
        """Return the signed distance of points from the surface, negative inside.

        Outside a hull it is only a lower bound of the distance, see `Hull.heights`.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) float
        """
        if self.kind == "HULL":
            return self.hull.heights(points)
        local = np.abs(coordinates_along(self.axes, points - self.center))
        radius, _, half = self.sizes
        if self.kind == "BOX":
            beyond = local - self.sizes
        elif self.kind == "CYLINDER":
            around = np.hypot(local[:, 0], local[:, 1])
            beyond = np.stack([around - radius, local[:, 2] - half], axis=1)
        else:  # all points at one distance from a segment
            local[:, 2] = np.maximum(local[:, 2] - half, 0.0)
            return np.linalg.norm(local, axis=1) - radius
        away = np.linalg.norm(np.maximum(beyond, 0.0), axis=1)
        return away + np.minimum(beyond.max(axis=1), 0.0)

    @property
    def bounds(self) -> FloatArray:
        """(2, 3) lowest and highest coordinates."""
        if self.kind == "HULL":
            return self.hull.bounds
        reach = np.abs(self.axes[2]) * self.sizes[2]
        if self.kind == "BOX":
            reach = coordinates_along(np.abs(self.axes.T), self.sizes)
        elif self.kind == "CYLINDER":
            reach = reach + self.sizes[0] * np.sqrt(
                np.maximum(1 - self.axes[2] ** 2, 0.0)
            )
        else:
            reach = reach + self.sizes[0]
        return np.stack([self.center - reach, self.center + reach])

    def moved(self, scale: float, center: FloatArray) -> CollisionShape:
        """Return the shape scaled about the origin, then moved by `center`.

        Parameters
        ----------
        scale : float
            Positive factor.
        center : (3,) float
            Where the origin moves to.

        Returns
        -------
        CollisionShape
        """
        normals, offsets = self.hull.planes[:, :3], self.hull.planes[:, 3]
        hull = replace(
            self.hull,
            vertices=self.hull.vertices * scale + center,
            planes=np.column_stack([normals, offsets * scale - normals @ center]),
            volume=self.hull.volume * scale**3,
        )
        return replace(
            self,
            hull=hull,
            center=self.center * scale + center,
            sizes=self.sizes * scale,
        )

    def __repr__(self) -> str:
        """Return a one-line summary."""
        return f"CollisionShape({self.kind}, volume {self.volume:.4g})"
