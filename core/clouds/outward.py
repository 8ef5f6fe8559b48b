"""Outward directions on a closed surface that is known only by points.

By the formula of Gauss, the winding number of a place is a sum of outward normals over
the surface, each weakened by its distance. It is 1 inside, 0 outside and 1/2 on the
surface. Normals are right if they give 1/2 at every point, and if they are the
directions in which the winding number falls: winding number normal consistency (Lin,
Shi and Liu 2024). Both conditions depend on the whole shape, so they also settle thin
limbs and both sides of a wall.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..geometry.frames import unit
from ..steps.arrays import Float32Array, FloatArray
from ..steps.progress import Progress, Steps, within

# Most points whose vectors are solved for. Memory grows with the square.
_DRAWN = 4000
# Neighbors that the distance of points is measured with.
_NEIGHBORS = 7
# Shorter distances of points, in diagonals, are scaled up to this. Their powers would
# overflow in single precision; a stray point far away makes them short.
_SHORT = 1e-3
# Iterations at each blur: one step towards 1/2, then a turn along the negative
# gradient.
_ROUNDS = 12
# Blur of the first, coarse solve, in distances of points.
_COARSE = 2.0
# Places in one block of the kernel.
_ROWS_PER_STEP = 500


@dataclass(frozen=True, eq=False)
class _Rows:
    """Kernel of the winding number, from points with vectors to a block of places.

    Attributes
    ----------
    places : (Q, 3) float32
    points : (N, 3) float32
    cubes : (Q, N) float32
        1 / d³ for each blurred distance d.
    fifths : (Q, N) float32
        3 / d⁵.
    """

    places: Float32Array
    points: Float32Array
    cubes: Float32Array
    fifths: Float32Array

    def numbers(self, vectors: Float32Array) -> Float32Array:
        """Return the winding number of each place, (Q,), times a constant."""
        heights = (vectors * self.points).sum(axis=1)
        sums = self.cubes @ np.column_stack([vectors, heights])
        return sums[:, 3] - (self.places * sums[:, :3]).sum(axis=1)

    def slopes(self, missing: Float32Array) -> Float32Array:
        """Return the steepest change (Q, 3) of vectors to reduce `missing` (N,).

        The transpose of `numbers`, for places that are some of the points.
        """
        moments = missing[:, None] * self.points
        sums = self.cubes @ np.column_stack([moments, missing])
        return self.places * sums[:, 3:] - sums[:, :3]

    def falls(self, vectors: Float32Array) -> Float32Array:
        """Return the negative gradient of the winding number at the places, (Q, 3)."""
        heights = (vectors * self.points).sum(axis=1) - self.places @ vectors.T
        heights *= self.fifths
        there = self.places * heights.sum(axis=1)[:, None]
        return self.cubes @ vectors - heights @ self.points + there


def outward_directions(points: FloatArray, blur: float) -> Steps[FloatArray]:
    """Return unit vectors out of the shape at points spread over its surface.

    Parameters
    ----------
    points : (N, 3) float
    blur : float
        Radius that the surface is blurred with, in distances of its points, so that
        the vectors do not fit noise.

    Returns
    -------
    Steps of (N, 3) float

    References
    ----------
    Lin, Shi and Liu, winding number normal consistency, 2024.
    """
    # Single precision is finest around 0: that is where most points have to be, however
    # far a stray one is.
    places = (points - np.median(points, axis=0)).astype(np.float32)
    drawn = np.random.default_rng(0).permutation(len(points))[:_DRAWN]
    spacing = _spacing(places[drawn])
    if 0 < spacing < _SHORT:
        places, spacing = places * np.float32(_SHORT / spacing), _SHORT
    few = places[drawn]
    vectors = np.zeros_like(few)
    # With little detail first, vectors that are far apart agree sooner.
    vectors = yield from within(_nearer(few, _COARSE * spacing, vectors), 0.0, 0.45)
    vectors = yield from within(_nearer(few, blur * spacing, vectors), 0.45, 0.9)
    found = []
    for some, done in _rows(places, few, blur * spacing):
        yield Progress("Normals", 0.9 + 0.1 * done)
        found.append(some.falls(vectors))
    return unit(np.concatenate(found).astype(np.float64))


def _spacing(points: Float32Array) -> float:
    """Return the usual distance of points (N, 3) from their neighbors."""
    n_nearest = min(_NEIGHBORS, len(points) - 1) + 1
    distances, _ = cKDTree(points).query(points, n_nearest)
    return float(np.median(distances[:, 1:].mean(axis=1)))


def _nearer(
    points: Float32Array, width: float, vectors: Float32Array
) -> Steps[Float32Array]:
    """Return vectors (N, 3) improved for both conditions, blurred by `width`."""
    rows = []
    for some, done in _rows(points, points, width):
        yield Progress("Normals", 0.1 * done)
        rows.append(some)
    for number in range(_ROUNDS):
        progress = Progress("Normals", 0.1 + 0.9 * number / _ROUNDS)
        yield progress
        # Lengths do not matter, so 1 stands for 1/2.
        numbers = np.concatenate([some.numbers(vectors) for some in rows])
        missing = np.float32(1.0) - numbers
        change: Float32Array = np.concatenate([some.slopes(missing) for some in rows])
        yield progress
        effect = np.concatenate([some.numbers(change) for some in rows])
        # The step length that minimizes the sum of squares of `missing`.
        fitted = vectors + np.float32((change**2).sum() / (effect @ effect)) * change
        falls = []
        for some in rows:
            yield progress
            falls.append(some.falls(fitted))
        lengths = np.linalg.norm(fitted, axis=1, keepdims=True)
        vectors = lengths * unit(np.concatenate(falls))
    return vectors


def _rows(
    places: Float32Array, points: Float32Array, width: float
) -> Iterator[tuple[_Rows, float]]:
    """Yield the kernel for blocks of places, with the share of places done before."""
    for start in range(0, len(places), _ROWS_PER_STEP):
        some = places[start : start + _ROWS_PER_STEP]
        squares = cdist(some, points, "sqeuclidean").astype(np.float32)
        squares += np.float32(width**2)
        cubes = squares ** np.float32(-1.5)
        yield _Rows(some, points, cubes, 3 * cubes / squares), start / len(places)
