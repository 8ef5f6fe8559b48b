"""Fit the collision shapes that the user asks for around convex hulls."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..geometry.primitives import CollisionShape, Hull
from ..parameters.hulls import HullParameters
from .convex_hull import THIN, offset, simplified
from .enclosing import around, roughly_around


@dataclass(frozen=True)
class Fit:
    """Which shapes are fitted, and how closely.

    Attributes
    ----------
    parameters : HullParameters
    unit : float
        Half of the longest side of the whole shape, in the units of the mesh. Hulls
        are scaled so that it is 1.
    max_error : float
        Largest error, where the longest side is 2.
    """

    parameters: HullParameters
    unit: float
    max_error: float

    @property
    def margin(self) -> float:
        """Distance by which surfaces move outwards, where the longest side is 2."""
        return self.parameters.margin / self.unit

    @property
    def has_room(self) -> bool:
        """Whether the margin alone is within the largest error."""
        return abs(self.margin) < self.max_error

    def shape(self, hull: Hull) -> CollisionShape:
        """Fit the kind of shape that the parameters ask for around a hull.

        Boxes, spheres, cylinders and capsules contain the hull. Simplified hulls
        contain it to a ten thousandth of the longest side, if `max_vertices` allows for
        it.

        Parameters
        ----------
        hull : Hull
            The longest side of the whole shape is 2.

        Returns
        -------
        CollisionShape
            In the space of `hull`.
        """
        kind, most = self.parameters.shape, self.parameters.max_vertices
        if kind == "HULL":
            return _as_shape(simplified(offset(hull, self.margin), most, THIN / 10))
        return _grown(around(hull, kind), self.margin)

    def rough_shape(self, hull: Hull) -> CollisionShape:
        """Fit a shape quickly: a little larger than `shape`, or with more vertices.

        Parameters
        ----------
        hull : Hull

        Returns
        -------
        CollisionShape
        """
        kind = self.parameters.shape
        if kind == "HULL":
            return _as_shape(offset(hull, self.margin))
        return _grown(roughly_around(hull, kind), self.margin)


def _as_shape(hull: Hull) -> CollisionShape:
    """Return a hull as a collision shape."""
    return CollisionShape("HULL", hull, np.zeros(3), np.eye(3), np.zeros(3))


def _grown(shape: CollisionShape, margin: float) -> CollisionShape:
    """Return a box, sphere, cylinder or capsule with its surface moved outwards."""
    least = np.where(shape.sizes > 0, THIN / 2, 0.0)
    moving = shape.sizes > 0
    moving[2] &= shape.kind != "CAPSULE"  # its ends move with its radius
    return replace(shape, sizes=np.maximum(shape.sizes + margin * moving, least))
