"""Which way is out of a closed surface that only points of it are known of.

By the formula of Gauss the winding number around a place is a sum over the surface of
its outward normals, each weakened by its distance: 1 inside, 0 outside, one half on the
surface itself. Normals are right that give one half at every point, and that are the
ways in which the number falls: winding number normal consistency (Lin, Shi and Liu
2024). Both know the whole shape, thin limbs and both sides of a wall.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree
from scipy.spatial.distance import cdist

from ..geometry.frames import unit
from ..steps.progress import Progress, Steps, within

# Points that have an unknown normal each; memory grows with the square.
_DRAWN = 4000
# Neighbors that their distance is measured by.
_NEIGHBORS = 7
# Times that normals are brought nearer to one half, and turned to where numbers fall,
# of the blurred shape, and then of the shape itself.
_ROUNDS = 12
# What blurs it first, in distances of points.
_COARSE = 2.0
# Places that are looked at at a time.
_ROWS_PER_STEP = 500

Single = NDArray[np.float32]


@dataclass(frozen=True, eq=False)
class _Rows:
    """What vectors at points do at some places.

    Attributes
    ----------
    places : (Q, 3) float32
    points : (N, 3) float32
    cubes, fifths : (Q, N) float32
        Inverse powers of the distances, three times that of the fifth.
    """

    places: Single
    points: Single
    cubes: Single
    fifths: Single

    def numbers(self, vectors: Single) -> Single:
        """Return the winding numbers around the places, (Q,), by some constant."""
        heights = (vectors * self.points).sum(axis=1)
        sums = self.cubes @ np.column_stack([vectors, heights])
        numbers: Single = sums[:, 3] - (self.places * sums[:, :3]).sum(axis=1)
        return numbers

    def slopes(self, missing: Single) -> Single:
        """Return in which way vectors give more of what is missing, (Q, 3).

        The transpose of `numbers`, where places are some of the points.
        """
        moments = missing[:, None] * self.points
        sums = self.cubes @ np.column_stack([moments, missing])
        slopes: Single = self.places * sums[:, 3:] - sums[:, :3]
        return slopes

    def falls(self, vectors: Single) -> Single:
        """Return the way in which the winding number falls at the places, (Q, 3)."""
        heights = (vectors * self.points).sum(axis=1) - self.places @ vectors.T
        heights *= self.fifths
        there = self.places * heights.sum(axis=1)[:, None]
        falls: Single = self.cubes @ vectors - heights @ self.points + there
        return falls


def outward_directions(
    points: NDArray[np.float64], blur: float
) -> Steps[NDArray[np.float64]]:
    """Return unit vectors out of the shape at points spread over its surface, (N, 3).

    Parameters
    ----------
    points : (N, 3) float
        Around the origin.
    blur : float
        What blurs the surface, in distances of its points: noise is not to be
        explained.
    """
    places = points.astype(np.float32)
    few = places[np.random.default_rng(0).permutation(len(points))[:_DRAWN]]
    n_nearest = min(_NEIGHBORS, len(few) - 1) + 1
    distances, _ = cKDTree(few).query(few, n_nearest)
    spacing = float(np.median(distances[:, 1:].mean(axis=1)))
    vectors = np.zeros_like(few)
    # What is far apart comes to agree the sooner the less of the detail is seen.
    vectors = yield from within(_nearer(few, _COARSE * spacing, vectors), 0.0, 0.45)
    vectors = yield from within(_nearer(few, blur * spacing, vectors), 0.45, 0.9)
    found = []
    for some, done in _rows(places, few, blur * spacing):
        yield Progress("Normals", 0.9 + 0.1 * done)
        found.append(some.falls(vectors))
    return unit(np.concatenate(found).astype(np.float64))


def _nearer(points: Single, width: float, vectors: Single) -> Steps[Single]:
    """Return vectors (N, 3) that have been brought nearer to both, in some rounds."""
    rows = []
    for some, done in _rows(points, points, width):
        yield Progress("Normals", 0.1 * done)
        rows.append(some)
    for number in range(_ROUNDS):
        progress = Progress("Normals", 0.1 + 0.9 * number / _ROUNDS)
        yield progress
        # Lengths do not matter, so that one half may be 1.
        missing = np.float32(1.0) - _all(some.numbers(vectors) for some in rows)
        change = _all(some.slopes(missing) for some in rows)
        yield progress
        effect = _all(some.numbers(change) for some in rows)
        # The step in this direction that leaves the least missing, in squares.
        fitted = vectors + np.float32((change**2).sum() / (effect @ effect)) * change
        falls = []
        for some in rows:
            yield progress
            falls.append(some.falls(fitted))
        lengths = np.linalg.norm(fitted, axis=1, keepdims=True)
        vectors = lengths * unit(np.concatenate(falls))
    return vectors


def _all(values: Iterable[Single]) -> Single:
    return np.concatenate(list(values))


def _rows(
    places: Single, points: Single, width: float
) -> Iterator[tuple[_Rows, float]]:
    """Yield what vectors at points do at some places after the other.

    With the share of the places that is done.
    """
    for start in range(0, len(places), _ROWS_PER_STEP):
        some = places[start : start + _ROWS_PER_STEP]
        squares = cdist(some, points, "sqeuclidean").astype(np.float32)
        squares += np.float32(width**2)
        cubes = squares ** np.float32(-1.5)
        yield _Rows(some, points, cubes, 3 * cubes / squares), start / len(places)
