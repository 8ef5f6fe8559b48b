"""Flat meshes: shapes of two dimensions, seen by their outline as in figure 3.

Samples of a flat shape lie on its outline, normals and lines of sight in its plane.
All of it comes from low walls along the outline, which rays are cast at: a segment
between two points of such walls stays between their upper and lower rims, so that it
meets a wall exactly where it crosses the outline.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from .face_graph import FaceGraph, face_graph
from .frames import frames
from .mesh import TriangleMesh

# Faces are in one plane when no vertex is farther from another along its normal; those
# lie in it that cover this share of their area there, unlike the sides of a thin plate.
_FLAT = 1e-4
_LYING = 0.5
# Faces of less area are wound like most: rounding decides which way they seem to face.
_TINY = 1e-8
# Share of its hull that a convex face fills.
_CONVEX = 0.999
# Height of the walls, in diagonals: less than the distance between samples.
_HEIGHT = 1e-3


@dataclass(frozen=True, eq=False)
class FlatMesh:
    """A mesh in one plane.

    Attributes
    ----------
    faces : TriangleMesh
        The mesh, with all triangles wound alike.
    walls : TriangleMesh
        Rectangles across the plane along the outline, facing away from the faces.
        The polygon of each is that of the face at its foot.
    normal : (3,) float
        Of the plane, a unit vector.
    """

    faces: TriangleMesh
    walls: TriangleMesh
    normal: NDArray[np.float64]

    def graph(self) -> FaceGraph:
        """Return the graph that labels move along."""
        lengths = self.walls.areas / _HEIGHT
        outline = np.bincount(self.walls.polygons, lengths, self.faces.n_polygons)
        return replace(face_graph(self.faces), outline=outline.astype(np.float64))

    @property
    def notes(self) -> tuple[str, ...]:
        """What the user should know."""
        if self.faces.n_polygons > 1:
            return ()
        axes = np.concatenate(frames(self.normal[None]))
        hull = ConvexHull(self.walls.vertices @ axes.T)
        if self.faces.areas.sum() >= _CONVEX * hull.volume:  # its area, in a plane
            return ()
        return (
            "The mesh is a single flat face, and faces are never cut; give it more to"
            " carry parts (Face > Triangulate Faces, then Edge > Subdivide).",
        )


def flat_mesh(mesh: TriangleMesh) -> FlatMesh | None:
    """Return what a normalized mesh is in two dimensions, None if it is not flat."""
    upright = mesh.normals @ mesh.normals[mesh.areas.argmax()]
    normal = (np.sign(upright) * mesh.areas) @ mesh.normals
    normal = normal / np.linalg.norm(normal)
    heights = mesh.vertices @ normal
    used = heights[mesh.triangles]
    if np.ptp(used) > _FLAT:
        return None
    totals = np.bincount(mesh.polygons, mesh.areas)
    lifts = np.bincount(mesh.polygons, mesh.areas * (mesh.normals @ normal))
    lifts = np.where(totals > _TINY, lifts, lifts.sum())[mesh.polygons]
    turned = np.where(lifts[:, None] < 0, mesh.triangles[:, ::-1], mesh.triangles)
    faces = replace(mesh, triangles=turned)
    lying = np.abs(lifts) > _LYING * totals[mesh.polygons]
    tails, heads, owners = _outline(faces, lying)
    middle = mesh.vertices + np.outer(used.mean() - heights, normal)
    rims = np.stack([middle - _HEIGHT / 2 * normal, middle + _HEIGHT / 2 * normal])
    a, b, c, d = np.concatenate([rims[0, [tails, heads]], rims[1, [heads, tails]]])
    corners = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    walls = TriangleMesh(
        corners, np.arange(len(corners)).reshape(-1, 3), np.repeat(owners, 2)
    )
    return FlatMesh(faces, walls, normal)


def _outline(
    faces: TriangleMesh, lying: NDArray[np.bool_]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return the edges that have faces on one side alone.

    This finds holes, and the outline of what is folded or lies in several layers, too.

    Parameters
    ----------
    faces : TriangleMesh
        Wound alike.
    lying : (T,) bool
        Which triangles count.

    Returns
    -------
    tails, heads : (E,) int
        Rows of the vertices; the faces are on the left, seen from above.
    owners : (E,) int
        Polygon on the left, one of them.
    """
    sides = [0, 1, 1, 2, 2, 0]
    welded = faces.welded_triangles[lying][:, sides].reshape(-1, 2)
    edges = faces.triangles[lying][:, sides].reshape(-1, 2)
    forward = welded[:, 0] < welded[:, 1]
    keys = welded.min(axis=1) * (welded.max() + 1) + welded.max(axis=1)
    _, first, edge_of, uses = np.unique(
        keys, return_index=True, return_inverse=True, return_counts=True
    )
    n_forward = np.bincount(edge_of.reshape(-1), forward)
    first = first[(n_forward == 0) | (n_forward == uses)]
    tails, heads = edges[first].T
    return tails, heads, np.repeat(faces.polygons[lying], 3)[first]
