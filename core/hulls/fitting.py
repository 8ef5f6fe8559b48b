"""Fit the collision shapes that the user asks for around convex hulls."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from ..geometry.mesh import TriangleMesh
from ..geometry.primitives import CollisionShape, Hull
from ..parameters.hulls import HullParameters
from .convex_hull import THIN, offset, simplified
from .enclosing.shapes import around, roughly_around
from .measure.uncovered import uncovered


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
    kinds : tuple of str, optional
        Kind of shape of each part, in their order; empty for that of the parameters.
    """

    parameters: HullParameters
    unit: float
    max_error: float
    kinds: tuple[str, ...] = ()

    def of_part(self, row: int) -> Fit:
        """Return the fit of shapes around a part, if parts get one each."""
        if not self.kinds or self.parameters.pieces != "PARTS":
            return self
        parameters = replace(self.parameters, shape=self.kinds[row])
        return replace(self, parameters=parameters, kinds=())

    @property
    def margin(self) -> float:
        """Distance by which surfaces move outwards, where the longest side is 2."""
        return self.parameters.margin / self.unit

    def has_room(self, hull: Hull) -> bool:
        """Return whether the margin alone is within the largest error, at corners too.

        Cuts leave corners of a hull as sharp as they are, or make them sharper.
        """
        has_room = abs(self.margin) < self.max_error
        if not has_room or self.margin == 0 or self.parameters.shape != "HULL":
            return has_room
        moved = offset(hull, self.margin)
        inner, outer = (hull, moved) if self.margin > 0 else (moved, hull)
        return uncovered(_as_shape(inner), outer) < self.max_error

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
            return _as_shape(simplified(offset(hull, self.margin), most))
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

    def is_sharp(self, rough: CollisionShape) -> bool:
        """Return whether `rough_shape` is `shape`, but for what simplifying removes."""
        most = self.parameters.max_vertices
        return rough.kind == "HULL" and len(rough.hull.vertices) <= most

    def left_out(self, shape: CollisionShape, hull: Hull) -> float:
        """Return how far what `max_vertices` leaves out of a hull is from its shape.

        Parameters
        ----------
        shape : CollisionShape
            That was fitted around the hull.
        hull : Hull

        Returns
        -------
        float
            0 if it is within the largest error.
        """
        rough = self.rough_shape(hull)
        if rough.kind != "HULL" or self.is_sharp(rough):
            return 0.0
        distance = uncovered(shape, rough.hull)
        return distance if distance > self.max_error else 0.0


def fit_for(
    mesh: TriangleMesh,
    parameters: HullParameters,
    scene_unit: float,
    parts: Iterable[int] = (),
    kinds: Mapping[int, str] | None = None,
) -> tuple[Fit, float]:
    """Return how shapes fit a mesh, and how much an error of 1 is in the chosen unit.

    Parameters
    ----------
    mesh : TriangleMesh
    parameters : HullParameters
    scene_unit : float
        Length in the scene of 1 in the units of the mesh.
    parts : iterable of int, optional
        Numbers of the parts, in their order.
    kinds : mapping of int to str, optional
        Kind of shape of single parts.

    Raises
    ------
    DecompositionError
        If the largest error is too small for the mesh.
    """
    size = float(np.ptp(mesh.bounds, axis=0).max()) / 2
    factor = parameters.unit_of_errors(size * scene_unit)
    every = tuple((kinds or {}).get(part, parameters.shape) for part in parts)
    return Fit(parameters, size, parameters.max_error / factor, every), factor


def _as_shape(hull: Hull) -> CollisionShape:
    """Return a hull as a collision shape."""
    return CollisionShape("HULL", hull, np.zeros(3), np.eye(3), np.zeros(3))


def _grown(shape: CollisionShape, margin: float) -> CollisionShape:
    """Return a box, sphere, cylinder or capsule with its surface moved outwards."""
    least = np.minimum(shape.sizes, THIN / 2)
    moving = shape.sizes > 0
    moving[2] &= shape.kind != "CAPSULE"  # its ends move with its radius
    return replace(shape, sizes=np.maximum(shape.sizes + margin * moving, least))
