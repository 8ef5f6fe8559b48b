"""Convex shapes of a few numbers, or of a few vertices."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .convex_hull import Hull, convex_hull, directions

# Vertices around a cylinder, and of a sphere.
_AROUND = 24
_ON_SPHERE = 162


@dataclass(frozen=True, eq=False)
class CollisionShape:
    """A convex shape around a piece.

    Attributes
    ----------
    kind : str
        'HULL', 'BOX', 'SPHERE', 'CYLINDER' or 'CAPSULE'.
    hull : Hull
        The shape itself, if it is a hull; the convex hull that it is put around if not.
    center : (3,) float
    axes : (3, 3) float
        Its axes as rows, right-handed; cylinders and capsules are along the last one.
    sizes : (3,) float
        Half the sides of a box. Radius, radius and half the height of the others, of
        capsules without their round ends; for a sphere this is 0.
    """

    kind: str
    hull: Hull
    center: NDArray[np.float64]
    axes: NDArray[np.float64]
    sizes: NDArray[np.float64]

    @property
    def volume(self) -> float:
        """Volume of the shape."""
        a, b, half = self.sizes
        ball = 4 / 3 * np.pi * a**3
        return {
            "HULL": self.hull.volume,
            "BOX": float(8 * a * b * half),
            "SPHERE": float(ball),
            "CYLINDER": float(2 * np.pi * a**2 * half),
            "CAPSULE": float(2 * np.pi * a**2 * half + ball),
        }[self.kind]

    def heights(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far points (M, 3) are out of the shape, negative inside, (M,)."""
        if self.kind == "HULL":
            return self.hull.heights(points)
        local = (points - self.center) @ self.axes.T
        if self.kind == "BOX":
            return (np.abs(local) - self.sizes).max(axis=1)
        radius, _, half = self.sizes
        if self.kind == "CYLINDER":
            around = np.hypot(local[:, 0], local[:, 1]) - radius
            return np.maximum(around, np.abs(local[:, 2]) - half)
        local[:, 2] -= np.clip(local[:, 2], -half, half)
        return np.linalg.norm(local, axis=1) - radius

    def moved(self, scale: float, center: NDArray[np.float64]) -> CollisionShape:
        """Return the shape scaled about the origin, which then moves to `center`."""
        hull = replace(
            self.hull,
            vertices=self.hull.vertices * scale + center,
            planes=np.column_stack(
                [
                    self.hull.planes[:, :3],
                    self.hull.planes[:, 3] * scale - self.hull.planes[:, :3] @ center,
                ]
            ),
            volume=self.hull.volume * scale**3,
        )
        return replace(
            self,
            hull=hull,
            center=self.center * scale + center,
            sizes=self.sizes * scale,
        )

    def outline(self) -> Hull:
        """Return the shape as a polyhedron; vertices of round ones lie on it."""
        if self.kind == "HULL":
            return self.hull
        ends = np.array([[0.0, 0.0, self.sizes[2]], [0.0, 0.0, -self.sizes[2]]])
        if self.kind == "BOX":
            local = self.sizes * (2.0 * np.indices((2, 2, 2)).reshape(3, -1).T - 1)
        elif self.kind == "CYLINDER":
            turns = 2 * np.pi * np.arange(_AROUND) / _AROUND
            circle = np.stack([np.cos(turns), np.sin(turns), 0 * turns], axis=1)
            local = (ends[:, None] + self.sizes[0] * circle).reshape(-1, 3)
        else:
            ball = self.sizes[0] * directions(_ON_SPHERE)
            local = np.concatenate(
                [
                    end + ball[ball[:, 2] * sign >= 0]
                    for end, sign in zip(ends, (1, -1), strict=True)
                ]
            )
        return convex_hull(
            local @ self.axes + self.center, float(self.sizes.max()) / 1e3
        )
