"""Shapes that are their own mirror image: the plane, and labels copied across it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..steps.progress import Progress, Steps
from .face_graph import FaceGraph

# Polygons that stand for the graph, and those whose mirror images are looked for.
_POLYGONS = 30_000
_ASKED = 1_500
# Distance from its mirror image, in diagonals, at which a polygon counts as symmetric,
# and the share of the area that has to be.
_NEAR = 0.015
_ENOUGH = 0.95
# How far apart two polygons of normals one unit apart count, in diagonals: the two
# sides of a thin wall are not each other's mirror image.
_NORMAL_WEIGHT = 0.01
# A plane moves to where the nearest polygons want it, so many times.
_ROUNDS = 3
_TRUSTED = 0.8
# An image may be this far from a polygon that it gives its label to, in diagonals.
_IMAGED_WITHIN = 0.03
# Polygons whose images are looked for in a step.
_BLOCK = 10_000


@dataclass(frozen=True, eq=False)
class Plane:
    """The points x of normal · x = offset; `normal` (3,) float is a unit vector."""

    normal: NDArray[np.float64]
    offset: float

    def heights(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the distances (N,) of points from the plane, with their signs."""
        heights: NDArray[np.float64] = points @ self.normal - self.offset
        return heights

    def mirrored(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the mirror images of points, (N, 3)."""
        return points - 2 * np.outer(self.heights(points), self.normal)


@dataclass(frozen=True, eq=False)
class Side:
    """What lies on one side of a plane, and where its mirror image is on the other.

    Attributes
    ----------
    images : (M,) int
        Polygons on the other side.
    sources : (M,) int
        The polygon that each of them is the image of.
    """

    images: NDArray[np.int64]
    sources: NDArray[np.int64]

    def copied(self, labels: NDArray[np.int64], graph: FaceGraph) -> NDArray[np.int64]:
        """Return labels (P,) in 0…K − 1 with this side's copied to the other side.

        A part that crosses the plane goes on on the other side; the mirror image of
        one that does not is a part of its own: that of part p is K + p.
        """
        n_parts = int(labels.max()) + 1
        labels = labels.copy()
        labels[self.images] = n_parts + labels[self.sources]
        one, other = labels[graph.neighbors].T
        # A part and its mirror image that touch are one.
        crossing = np.unique(np.minimum(one, other)[np.abs(one - other) == n_parts])
        labels[np.isin(labels, crossing + n_parts)] -= n_parts
        return labels


def find_sides(graph: FaceGraph) -> Steps[tuple[Side, ...]]:
    """Return both sides of a shape's mirror plane, none if it has no such plane."""
    plane = yield from _find_plane(graph)
    if plane is None:
        return ()
    sides = []
    for above in (True, False):
        side, _ = yield from side_of(graph, plane, above)
        sides.append(side)
    return tuple(sides)


def side_of(graph: FaceGraph, plane: Plane, above: bool) -> Steps[tuple[Side, float]]:
    """Return one side of a plane, and which share of the other one is its image."""
    heights = plane.heights(graph.centers) * (1 if above else -1)
    sources, images = np.flatnonzero(heights >= 0), np.flatnonzero(heights < 0)
    if len(sources) == 0 or len(images) == 0:
        return Side(images[:0], sources[:0]), 0.0
    tree = cKDTree(places(graph.centers[sources], graph.normals[sources]))
    nearest = []
    for start in range(0, len(images), _BLOCK):
        yield Progress("Symmetry", 0.0)
        block = images[start : start + _BLOCK]
        centers, normals = graph.centers[block], graph.normals[block]
        nearest.append(sources[nearest_images(tree, centers, normals, plane)])
    found = np.concatenate(nearest)
    ways = plane.mirrored(graph.centers[images]) - graph.centers[found]
    near = np.linalg.norm(ways, axis=1) <= _IMAGED_WITHIN
    return Side(images[near], found[near]), float(near.mean())


def _find_plane(graph: FaceGraph) -> Steps[Plane | None]:
    """Return the plane that a surface is most symmetric to, if it is to any."""
    # Evenly by area, each time the same.
    shares = np.cumsum(graph.areas) / graph.areas.sum()
    everywhere, asked = (
        np.searchsorted(shares, (np.arange(n) + 0.5) / n).clip(max=len(shares) - 1)
        for n in (_POLYGONS, _ASKED)
    )
    rows = np.unique(everywhere)
    tree = cKDTree(places(graph.centers[rows], graph.normals[rows]))
    best, most = None, _ENOUGH
    center = graph.centers[everywhere].mean(axis=0)
    starts, normals = graph.centers[asked], graph.normals[asked]
    for normal in likely_normals(graph.centers[everywhere]):
        plane = Plane(normal, float(center @ normal))
        for _ in range(_ROUNDS):
            yield Progress("Symmetry", 0.0)
            nearest = nearest_images(tree, starts, normals, plane)
            ends = graph.centers[rows[nearest]]
            distances = np.linalg.norm(plane.mirrored(starts) - ends, axis=1)
            fit = float((distances <= _NEAR).mean())
            if fit > most:
                best, most = plane, fit
            if most == 1.0:
                return best
            plane = plane_between(starts, ends, distances)
    return best


def likely_normals(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the axes of space and the principal axes of points, (6, 3)."""
    _, principal = np.linalg.eigh(np.cov(points.T))
    return np.concatenate([np.eye(3), principal.T])


def plane_between(
    starts: NDArray[np.float64],
    ends: NDArray[np.float64],
    distances: NDArray[np.float64],
) -> Plane:
    """Return the plane halfway between points and their images, normal to the way."""
    trusted = distances <= np.quantile(distances, _TRUSTED)
    ways = (ends - starts)[trusted]
    normal = np.linalg.eigh(ways.T @ ways)[1][:, -1]
    return Plane(normal, float(((starts + ends)[trusted] / 2 @ normal).mean()))


def nearest_images(
    tree: cKDTree,
    points: NDArray[np.float64],
    normals: NDArray[np.float64],
    plane: Plane,
) -> NDArray[np.int64]:
    """Return the row of a tree of `places` nearest to each mirror image, (N,)."""
    upright = Plane(plane.normal, 0.0)
    images = places(plane.mirrored(points), upright.mirrored(normals))
    rows: NDArray[np.int64] = tree.query(images)[1]
    return rows


def places(
    points: NDArray[np.float64], normals: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return places in which points that face the same way are near, (N, 6)."""
    return np.hstack([points, _NORMAL_WEIGHT * normals])
