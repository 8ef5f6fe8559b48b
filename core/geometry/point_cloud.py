"""Point clouds that can be decomposed: checked, read-only arrays."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from ..errors import DecompositionError
from ..steps.arrays import FloatArray, IntArray
from .array_checks import check_size, rows_of_three
from .mesh import SAME_PLACE

# Least number of points of a cloud. Fewer do not show a surface.
_FEWEST = 16
# Points lie in a line, or plane, if they spread less than this across it: a root mean
# square distance, in diagonals.
_LEAST_WIDTH = 1e-4
# Least diagonal of half of the points, those in the middle, in diagonals of all. Sight
# starts as far below the surface.
_LEAST_MIDDLE = 1e-3


@dataclass(frozen=True, eq=False)
class PointCloud:
    """Points on a surface, with or without normals (section 5).

    Parameters
    ----------
    points : (N, 3) float
        In the units of the object.
    normals : (N, 3) float or None
        Outward vectors of any length but 0; None to have them estimated.

    Raises
    ------
    TypeError
        If points or normals are no numbers.
    DecompositionError
        If an array has a wrong shape, if there are too few points, if all lie at one
        place or in a line, or too far apart or too near to compute with, also half of
        them beside far stray points, if there is not one normal per point, or if values
        are not finite or normals zero.

    Examples
    --------
    >>> import numpy as np
    >>> from weak_convex_decomposition import PointCloud
    >>> normals = np.random.default_rng(0).normal(size=(100, 3))
    >>> normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    >>> PointCloud(2 * normals, normals).points.shape
    (100, 3)
    """

    points: FloatArray
    normals: FloatArray | None = None

    def __post_init__(self) -> None:
        """Check the arrays and keep read-only copies, normals at length 1."""
        points = rows_of_three(self.points, "Points").astype(np.float64)
        _check_points(points)
        points.flags.writeable = False
        object.__setattr__(self, "points", points)
        if self.normals is not None:
            normals = rows_of_three(self.normals, "Normals").astype(np.float64)
            normals = _unit_normals(normals, len(points))
            normals.flags.writeable = False
            object.__setattr__(self, "normals", normals)

    def __len__(self) -> int:
        """Return the number of points."""
        return len(self.points)

    @property
    def center(self) -> FloatArray:
        """Center of the bounding box, (3,)."""
        low, high = self.bounds
        return (low + high) / 2

    @property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Lowest and highest corner of the bounding box, (3,) each."""
        return self.points.min(axis=0), self.points.max(axis=0)

    @property
    def diagonal(self) -> float:
        """Length of the bounding box's diagonal, in the units of the object."""
        return math.dist(*self.bounds)

    @property
    def plane(self) -> FloatArray | None:
        """Unit normal of the plane that all points lie in, (3,), None without."""
        widths, axes = _spread(self.points)
        return axes[2] if widths[2] < _LEAST_WIDTH else None

    def normalized(self) -> PointCloud:
        """Return the cloud centered at the origin, with a bounding box of diagonal 1.

        Returns
        -------
        PointCloud
        """
        return replace(self, points=(self.points - self.center) / self.diagonal)

    def distinct(self) -> tuple[PointCloud, IntArray]:
        """Return the cloud without copies of points, and the row of each point there.

        Distances of neighbors tell how dense a cloud is; copies would make them 0.
        Copies may differ by rounding, and so may their normals.

        Returns
        -------
        cloud : PointCloud
            This one if it has no copies. Points that differ in their normals stay.
        rows : (N,) int

        Raises
        ------
        DecompositionError
            If there are too few points without the copies.
        """
        places = np.round((self.points - self.center) / (SAME_PLACE * self.diagonal))
        x, y, z = places.T
        mixed = np.sort(x + np.sqrt(2) * y + np.pi * z)
        if (mixed[1:] != mixed[:-1]).all():  # far quicker than to compare points
            return self, np.arange(len(self))
        normals = () if self.normals is None else (self.normals,)
        _, first, copies = np.unique(
            np.hstack([places, *(np.round(each / SAME_PLACE) for each in normals)]),
            axis=0,
            return_index=True,
            return_inverse=True,
        )
        if len(first) == len(self):
            return self, np.arange(len(self))
        kept = np.sort(first)
        rows = np.searchsorted(kept, first)[copies.reshape(-1)]
        return PointCloud(self.points[kept], *(each[kept] for each in normals)), rows


def _check_points(points: FloatArray) -> None:
    """Raise DecompositionError if the points cannot be points of a surface."""
    if len(points) < _FEWEST:
        raise DecompositionError(
            f"There are no faces, and too few points for a point cloud, {len(points)};"
            f" add faces, or choose an object of at least {_FEWEST} different points."
        )
    if not np.isfinite(points).all():
        raise DecompositionError(
            "The point cloud has coordinates that are not finite numbers; delete"
            " those points."
        )
    check_size(points.min(axis=0), points.max(axis=0))
    diagonal = np.linalg.norm(np.ptp(points, axis=0))
    if diagonal == 0:
        raise DecompositionError(
            "All points of the cloud are at one place; choose an object with a surface."
        )
    middle = _middle_half(points)
    share = np.linalg.norm(np.ptp(middle, axis=0)) / diagonal
    if 0 < share < _LEAST_MIDDLE:  # 0 for copies, which are left out later
        raise DecompositionError(
            f"Half of the points lie within {share:.1g} of the diagonal of all, too"
            " near to see their shape; delete stray points that are far from it, or"
            " make an object of each far piece."
        )
    if _is_line(points) and _is_line(middle):
        raise DecompositionError(
            "All points of the cloud lie in a line; choose an object with a surface."
        )


def _middle_half(points: FloatArray) -> FloatArray:
    """Return the half of the points that is nearest to one in their middle."""
    center = np.median(points, axis=0)
    for _ in range(2):  # a median may lie between pieces, so start at a point
        squares = ((points - center) ** 2).sum(axis=1)
        center = points[squares.argmin()]
    return points[np.argpartition(squares, len(points) // 2)[: len(points) // 2]]


def _is_line(points: FloatArray) -> bool:
    """Return whether points spread next to nothing across their longest direction."""
    return bool(_spread(points)[0][1] < _LEAST_WIDTH)


def _spread(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return how far points spread, in diagonals, and along which rows: most first."""
    spread = points - points.mean(axis=0)
    diagonal = np.linalg.norm(np.ptp(points, axis=0))
    scaled = spread / diagonal if diagonal > 0 else spread
    _, squares, axes = np.linalg.svd(scaled.T @ scaled / len(points))
    return np.sqrt(squares), axes


def _unit_normals(normals: FloatArray, n_points: int) -> FloatArray:
    """Return normals (N, 3) at length 1, or raise if they are unusable."""
    if len(normals) != n_points:
        raise DecompositionError(
            f"The point cloud has {n_points} points but {len(normals)} normals; give"
            " one per point, or no normals to have them estimated."
        )
    # Squares of very long and very short ones would leave double precision.
    _, exponents = np.frexp(np.abs(normals).max(axis=1, keepdims=True))
    normals = np.ldexp(normals, -exponents)
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    if not np.isfinite(lengths).all() or lengths.min() == 0:
        raise DecompositionError(
            "The point cloud has normals that are zero or not finite numbers; delete"
            " those points, or the normals to have them estimated."
        )
    return normals / lengths
