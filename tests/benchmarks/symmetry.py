"""Mirror asymmetry of parts: the share of a symmetric shape that is cut one-sidedly.

No Blender and no lines of sight: points spread over the surface, and for each the face
that lies where its mirror image is.
"""

from dataclasses import dataclass

import numpy as np
from princeton import overlaps
from scipy.optimize import linear_sum_assignment
from scipy.spatial import cKDTree
from weak_convex_decomposition.core.geometry.frames import with_normals
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.geometry.sampling import Samples, sample_surface
from weak_convex_decomposition.core.geometry.symmetry import (
    NORMAL_WEIGHT,
    Plane,
    likely_normals,
    nearest_images,
    plane_between,
)
from weak_convex_decomposition.core.steps.progress import run

# Points that stand for the surface, and every how manieth is mirrored.
POINTS = 40_000
STEP = 10
# Distance from its mirror image, in diagonals, at which a surface counts as symmetric,
# and the share of it that has to be.
NEAR = 0.01
ENOUGH = 0.95
# A plane moves to where the nearest points want it, so many times.
ROUNDS = 4


@dataclass(frozen=True, eq=False)
class Mirror:
    """What lies on both sides of the mirror plane of a shape.

    Attributes
    ----------
    faces : (N,) int
        Face of each of N points of equal area.
    images : (N,) int
        Face where the point's mirror image is.
    """

    faces: np.ndarray
    images: np.ndarray

    def asymmetry(self, labels: np.ndarray) -> float:
        """Return the share of the area that is cut otherwise than its mirror image.

        Each part has one other, or itself, for its mirror image: such that as much as
        possible of the area has the label that its mirror image calls for.
        """
        _, labels = np.unique(labels, return_inverse=True)
        table = overlaps(labels[self.faces], labels[self.images])
        matches = linear_sum_assignment(table, maximize=True)
        return 1.0 - float(table[matches].sum() / len(self.faces))


def find_mirror(mesh: TriangleMesh) -> Mirror | None:
    """Return the best mirror plane's two sides, or None for a shape without one."""
    mesh = run(mesh.normalized_in_steps())
    samples = sample_surface(mesh, POINTS, np.random.default_rng(0))
    reflector = _Reflector(samples)
    found = [
        image
        for normal in likely_normals(samples.positions)
        for image in reflector.improved(normal)
    ]
    rows, fit = max(found, key=lambda image: image[1])
    if fit < ENOUGH:
        return None
    faces = mesh.polygons[samples.triangles]
    return Mirror(faces[::STEP], faces[rows])


class _Reflector:
    """Mirrors points of a surface, and finds what lies there."""

    def __init__(self, samples: Samples) -> None:
        self.samples = samples
        self.points = samples.positions[::STEP]
        self.normals = samples.normals[::STEP]
        self.tree = cKDTree(
            with_normals(samples.positions, samples.normals, NORMAL_WEIGHT)
        )

    def improved(self, normal: np.ndarray) -> list[tuple[np.ndarray, float]]:
        """Return rows of the samples at the mirror images, and how well they fit.

        For a plane through the center with this normal, and for what becomes of it.
        """
        found = []
        plane = Plane(normal, float(self.samples.positions.mean(axis=0) @ normal))
        for _ in range(ROUNDS):
            rows = nearest_images(self.tree, self.points, self.normals, plane)
            ends = self.samples.positions[rows]
            distances = np.linalg.norm(ends - plane.mirrored(self.points), axis=1)
            found.append((rows, float((distances <= NEAR).mean())))
            plane = plane_between(self.points, ends, distances)
        return found
