"""Collision shapes and their errors: what `build_hulls` gives."""

from __future__ import annotations

from dataclasses import dataclass

from ..geometry.primitives import CollisionShape
from ..parameters.hulls import HullParameters
from ..parameters.parameter import check, field_of
from ..steps.arrays import FloatArray, IntArray


@dataclass(frozen=True, eq=False, repr=False)
class HullDecomposition:
    """Convex collision shapes that together approximate a shape, in its units.

    Its arrays are read-only.

    Attributes
    ----------
    shapes : tuple of CollisionShape
        Sorted, the largest first.
    errors : (K,) float
        Error of each shape as it is written, with its kind, margin and vertices, in
        `error_unit`: an upper bound, seldom more than a few percent above the error.
        The error is the largest of

        - R_v of CoACD: 0.3 times the radius of a ball that has the volume of the shape
          outside the solid;
        - the distance of any point on the shape, if it is outside the solid, from the
          surface of the solid within the shape;
        - the depth below the surface of the shape of any point on the surface of the
          solid within the shape;
        - the distance from the shape of any point of its piece, which margins below 0
          and `max_vertices` may leave uncovered.
    parts : (K,) int
        Number of the part of each collision shape, −1 if no parts were given.
    volume_ratio : float
        Sum of the volumes of the collision shapes, divided by that of the solid; `inf`
        for a shape without an inside.
    notes : tuple of str
        Sentences to the user.
    error_unit : str
        'RELATIVE', where 1 is half of the longest side of the shape, or 'SCENE', for
        lengths.
    half_side : float
        Half of the longest side of the shape, as a length in the scene.

    Examples
    --------
    >>> from weak_convex_decomposition import build_hulls
    >>> vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    >>> hulls = build_hulls(vertices, faces)
    >>> round(hulls.shapes[0].volume, 3)
    0.167
    """

    shapes: tuple[CollisionShape, ...]
    errors: FloatArray
    parts: IntArray
    volume_ratio: float
    notes: tuple[str, ...]
    error_unit: str = "RELATIVE"
    half_side: float = 1.0

    def __post_init__(self) -> None:
        """Protect what the next result of the same shape may share."""
        self.errors.flags.writeable = self.parts.flags.writeable = False

    def errors_in(self, unit: str) -> FloatArray:
        """Return the errors in a unit, (K,) float.

        Parameters
        ----------
        unit : str
            'RELATIVE' or 'SCENE'.

        Raises
        ------
        DecompositionError
            If there is no such unit.
        """
        check(field_of(HullParameters, "error_unit"), unit)
        if unit == self.error_unit:
            return self.errors
        factor = self.half_side if unit == "SCENE" else 1 / self.half_side
        return self.errors * factor

    @property
    def n_hulls(self) -> int:
        """Number of collision shapes K."""
        return len(self.shapes)

    @property
    def has_parts(self) -> bool:
        """Whether parts were given, so that each collision shape belongs to one."""
        return bool(self.parts.min() >= 0)

    def __repr__(self) -> str:
        """Return the number of hulls and the largest error in one line."""
        hulls = "1 hull" if self.n_hulls == 1 else f"{self.n_hulls} hulls"
        return f"HullDecomposition({hulls}, largest error {self.errors.max():.3f})"
