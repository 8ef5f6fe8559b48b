"""Mirror symmetry: find a shape's mirror plane, and copy labels across it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps
from .frames import with_normals
from .graphs.face_graph import FaceGraph
from .graphs.pieces import Pieces

# Polygons, drawn evenly by area, that mirror images are matched to.
_POLYGONS = 30_000
# Polygons, drawn evenly by area, that are mirrored to test a plane.
_ASKED = 1_500
# A polygon is symmetric if its mirror image is this near to a polygon, in diagonals.
_NEAR = 0.015
# The shape is symmetric if more than this share of its area is.
_ENOUGH = 0.95
# Distance, in diagonals, that normals one unit apart add: the two sides of a thin wall
# are not each other's mirror image.
NORMAL_WEIGHT = 0.01
# Times that each candidate plane is tested, and fitted to its matches.
_ROUNDS = 3
# Share of the matches, nearest first, that a fit uses.
_TRUSTED = 0.8
# Greatest distance, in diagonals, at which a label is copied to a mirror image.
_IMAGED_WITHIN = 0.03
# Polygons matched in one step.
_BLOCK = 10_000


@dataclass(frozen=True, eq=False)
class Plane:
    """The points x with normal · x = offset; `normal` is a unit vector, (3,) float."""

    normal: FloatArray
    offset: float

    def heights(self, points: FloatArray) -> FloatArray:
        """Return the signed distances of points from the plane, (N,) float.

        Parameters
        ----------
        points : (N, 3) float
        """
        return points @ self.normal - self.offset

    def mirrored(self, points: FloatArray) -> FloatArray:
        """Return the mirror images of points, (N, 3) float.

        Parameters
        ----------
        points : (N, 3) float
        """
        return points - 2 * np.outer(self.heights(points), self.normal)


@dataclass(frozen=True, eq=False)
class Side:
    """One side of a plane: its polygons, matched to mirror images on the other side.

    Attributes
    ----------
    images : (M,) int
        Polygons on the other side.
    sources : (M,) int
        Polygon on this side that matches each image.
    """

    images: IntArray
    sources: IntArray

    def copied(self, labels: IntArray, graph: FaceGraph) -> IntArray:
        """Return labels with those of this side copied to the other side, (P,) int.

        A part that crosses the plane is one part with its image. The image of any other
        part p is a new part with label K + p.

        Parameters
        ----------
        labels : (P,) int
            Labels 0…K − 1.
        graph : FaceGraph
        """
        n_parts = int(labels.max()) + 1
        labels = labels.copy()
        labels[self.images] = n_parts + labels[self.sources]
        one, other = labels[graph.neighbors].T
        # A part that touches its mirror image is one part with it.
        crossing = np.minimum(one, other)[np.abs(one - other) == n_parts]
        numbers = np.arange(2 * n_parts)
        numbers[crossing + n_parts] = crossing
        return numbers[labels]


def find_sides(surface: Pieces, plane: Plane | None) -> Steps[tuple[Side, ...]]:
    """Find the two sides of a plane, or none without a plane.

    Parameters
    ----------
    surface : Pieces
    plane : Plane or None

    Returns
    -------
    Steps of tuple of Side
    """
    if plane is None:
        return ()
    sides = []
    for above in (True, False):
        side, _ = yield from side_of(surface, plane, above)
        sides.append(side)
    return tuple(sides)


def side_of(surface: Pieces, plane: Plane, above: bool) -> Steps[tuple[Side, float]]:
    """Match the polygons on one side of a plane to mirror images on the other side.

    Parameters
    ----------
    surface : Pieces
        All polygons in their order, then pieces of them: the mirror image of a center
        may lie anywhere on a polygon.
    plane : Plane
    above : bool
        True for the side with heights of 0 and above, False for the other one.

    Returns
    -------
    Steps of (Side, float)
        The side, and the share of the polygons on the other side that have a match.
    """
    centers, normals, _, polygons = surface
    heights = plane.heights(centers) * (1 if above else -1)
    n_polygons = int(polygons.max()) + 1
    rows = np.flatnonzero(heights[polygons] >= 0)
    images = np.flatnonzero(heights[:n_polygons] < 0)
    if len(rows) == 0 or len(images) == 0:
        return Side(images[:0], images[:0]), 0.0
    tree = cKDTree(with_normals(centers[rows], normals[rows], NORMAL_WEIGHT))
    nearest = []
    for start in range(0, len(images), _BLOCK):
        yield Progress("Symmetry", 0.0)
        some = images[start : start + _BLOCK]
        nearest.append(nearest_images(tree, centers[some], normals[some], plane))
    found = rows[np.concatenate(nearest)]
    ways = plane.mirrored(centers[images]) - centers[found]
    near = np.linalg.norm(ways, axis=1) <= _IMAGED_WITHIN
    return Side(images[near], polygons[found[near]]), float(near.mean())


def find_plane(surface: Pieces) -> Steps[Plane | None]:
    """Return the plane of best mirror symmetry, None if there is none."""
    # Drawn evenly by area, without randomness.
    shares = np.cumsum(surface.areas) / surface.areas.sum()
    everywhere, asked = (
        np.searchsorted(shares, (np.arange(n) + 0.5) / n).clip(max=len(shares) - 1)
        for n in (_POLYGONS, _ASKED)
    )
    rows = np.unique(everywhere)
    tree = cKDTree(
        with_normals(surface.centers[rows], surface.normals[rows], NORMAL_WEIGHT)
    )
    best, most = None, _ENOUGH
    center = surface.centers[everywhere].mean(axis=0)
    starts, normals = surface.centers[asked], surface.normals[asked]
    for normal in likely_normals(surface.centers[everywhere]):
        plane = Plane(normal, float(center @ normal))
        for _ in range(_ROUNDS):
            yield Progress("Symmetry", 0.0)
            nearest = nearest_images(tree, starts, normals, plane)
            ends = surface.centers[rows[nearest]]
            distances = np.linalg.norm(plane.mirrored(starts) - ends, axis=1)
            fit = float((distances <= _NEAR).mean())
            if fit > most:
                best, most = plane, fit
            if most == 1.0:
                return best
            plane = plane_between(starts, ends, distances)
    return best


def likely_normals(points: FloatArray) -> FloatArray:
    """Return the axes of space and the principal axes of points, (6, 3) float.

    Parameters
    ----------
    points : (N, 3) float
    """
    _, principal = np.linalg.eigh(np.cov(points.T))
    return np.concatenate([np.eye(3), principal.T])


def plane_between(starts: FloatArray, ends: FloatArray, distances: FloatArray) -> Plane:
    """Return the plane halfway between points and their mirror images.

    Only the matches with the smallest distances are used.

    Parameters
    ----------
    starts, ends : (N, 3) float
        Points, and the points matched to their mirror images.
    distances : (N,) float
        Distance from each mirror image to its match.

    Returns
    -------
    Plane
        Its normal is the main direction from points to images.
    """
    trusted = distances <= np.quantile(distances, _TRUSTED)
    ways = (ends - starts)[trusted]
    normal = np.linalg.eigh(ways.T @ ways)[1][:, -1]
    return Plane(normal, float(((starts + ends)[trusted] / 2 @ normal).mean()))


def nearest_images(
    tree: cKDTree, points: FloatArray, normals: FloatArray, plane: Plane
) -> IntArray:
    """Return the row of a tree nearest to the mirror image of each point, (N,) int.

    Parameters
    ----------
    tree : scipy.spatial.cKDTree
        Built from what `with_normals` returns.
    points, normals : (N, 3) float
    plane : Plane
    """
    upright = Plane(plane.normal, 0.0)
    turned = upright.mirrored(normals)
    images = with_normals(plane.mirrored(points), turned, NORMAL_WEIGHT)
    return tree.query(images)[1]
