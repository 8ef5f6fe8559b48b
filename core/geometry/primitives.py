"""Convex collision shapes: hulls, boxes, spheres, cylinders and capsules."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from .frames import heights_above


@dataclass(frozen=True, eq=False, repr=False)
class Hull:
    """A convex polyhedron.

    Attributes
    ----------
    vertices : (V, 3) float
    triangles : (F, 3) int
        Rows of `vertices`, counter-clockwise seen from outside.
    planes : (F, 4) float
        Outward unit normal n and offset d of each triangle: n · x + d ≤ 0 inside.
    volume : float
        In cubed units of `vertices`.
    """

    vertices: NDArray[np.float64]
    triangles: NDArray[np.int64]
    planes: NDArray[np.float64]
    volume: float

    def heights(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the height of points above their highest face plane, negative inside.

        Outside, it is a lower bound of the distance to the hull.

        Parameters
        ----------
        points : (M, 3) float

        Returns
        -------
        (M,) float
        """
        highest: NDArray[np.float64] = heights_above(self.planes, points).max(axis=1)
        return highest

    @cached_property
    def corners(self) -> NDArray[np.float64]:
        """(F, 3, 3) corners of the triangles."""
        corners: NDArray[np.float64] = self.vertices[self.triangles]
        return corners

    def __repr__(self) -> str:
        """Return a one-line summary."""
        return f"Hull({len(self.vertices)} vertices, volume {self.volume:.4g})"


@dataclass(frozen=True, eq=False, repr=False)
class CollisionShape:
    """A convex shape around a piece: a hull, or one of four primitives.

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
    center: NDArray[np.float64]
    axes: NDArray[np.float64]
    sizes: NDArray[np.float64]

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

    def moved(self, scale: float, center: NDArray[np.float64]) -> CollisionShape:
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
