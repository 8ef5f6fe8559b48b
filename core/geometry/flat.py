"""Flat meshes as two-dimensional shapes, sampled on their outline (figure 3).

The samples of a flat shape lie on its outline. Their normals and lines of sight lie
in its plane. Low walls are built along the outline, and rays are cast at them. A
segment between two points on walls stays between the upper and lower rims, so it
hits a wall exactly where it crosses the outline.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import ConvexHull

from ..steps.arrays import BoolArray, FloatArray, IntArray
from ..steps.progress import Steps, within
from .frames import frames, unit
from .graphs.edges import ends_of_sides, shared_edges
from .graphs.face_graph import FaceGraph, face_graph
from .mesh import TriangleMesh

# Greatest extent of a flat mesh along its normal, in diagonals.
_FLAT = 1e-4
# Triangles, about, that show that most meshes are not flat.
_FEW = 1000
# A face lies in the plane if its projection keeps this share of its area. The sides
# of a thin plate do not.
_LYING = 0.5
# Faces of less area, in squared diagonals, are wound like the majority: their own
# normals depend on rounding.
_TINY = 1e-8
# Least share of its convex hull's area that a convex face fills.
_CONVEX = 0.999
# Height of the walls, in diagonals. It is less than the distance between samples.
_HEIGHT = 1e-3


@dataclass(frozen=True, eq=False)
class FlatMesh:
    """A mesh in one plane, with walls along its outline.

    Attributes
    ----------
    faces : TriangleMesh
        The mesh, with all triangles wound the same way.
    walls : TriangleMesh
        Rectangles at right angles to the plane, along the outline, facing away from
        the faces. Each has the polygon number of the face at its foot.
    normal : (3,) float
        Unit normal of the plane.
    """

    faces: TriangleMesh
    walls: TriangleMesh
    normal: FloatArray

    def graph(self) -> Steps[FaceGraph]:
        """Return the graph of the faces, with the outline length of each polygon.

        Returns
        -------
        Steps of FaceGraph
        """
        graph = yield from within(face_graph(self.faces), 0.0, 0.8)
        lengths = self.walls.areas / _HEIGHT
        outline = np.bincount(self.walls.polygons, lengths, self.faces.n_polygons)
        # Between two concave corners of the outline is a crease: people cut there.
        _, sides = yield from within(shared_edges(self.faces), 0.8, 1.0)
        ends = ends_of_sides(self.faces.welded_triangles, sides)
        bends = self._concave_angles()[np.stack(ends)].min(axis=0)
        return replace(graph, outline=outline.astype(np.float64), bends=bends)

    @property
    def outline(self) -> FloatArray:
        """Both ends of each edge of the outline, (E, 2, 3)."""
        a, b, c, _, _, d = self.walls.vertices.reshape(-1, 6, 3).swapaxes(0, 1)
        return np.stack([a + d, b + c], axis=1) / 2

    def _concave_angles(self) -> FloatArray:
        """Return by how much the outline turns inwards at each vertex, in radians."""
        corners = self.faces.welded_triangles
        places = self.faces.vertices[self.faces.triangles]
        ahead, behind = (
            unit((np.roll(places, n, axis=1) - places).reshape(-1, 3)) for n in (-1, 1)
        )
        angles = np.arccos(np.clip((ahead * behind).sum(axis=1), -1.0, 1.0))
        # Where two corners coincide, a triangle turns by no angle at all.
        same = (corners == np.roll(corners, -1, axis=1)).any(axis=1)
        inner = np.bincount(corners.ravel(), np.where(same.repeat(3), 0.0, angles))
        turns = inner - np.pi
        turns[inner > 2 * np.pi - 1e-3] = 0.0
        return np.maximum(turns, 0.0)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences to the user, a tuple of str."""
        if self.faces.n_polygons > 1:
            return ()
        axes = np.concatenate(frames(self.normal[None]))
        hull = ConvexHull(self.walls.vertices @ axes.T)
        if self.faces.areas.sum() >= _CONVEX * hull.volume:  # its area, in a plane
            return ()
        return (
            "The mesh is a single flat face; choose Cut Faces for Seams, or give it"
            " more to carry parts (Face > Triangulate Faces, then Edge > Subdivide).",
        )


def flat_mesh(mesh: TriangleMesh) -> FlatMesh | None:
    """Return a mesh as a flat shape, or None if it is not flat.

    Parameters
    ----------
    mesh : TriangleMesh
        Normalized: its bounding box has diagonal 1.

    Returns
    -------
    FlatMesh or None
    """
    if _surely_thick(mesh):
        return None
    upright = mesh.normals @ mesh.normals[mesh.areas.argmax()]
    normal = (np.sign(upright) * mesh.areas) @ mesh.normals
    normal = normal / np.linalg.norm(normal)
    heights = mesh.vertices @ normal
    used = heights[mesh.triangles]
    if np.ptp(used) > _FLAT:
        return None
    lifts, lying = _lifts(mesh, normal)
    turned = np.where(lifts[:, None] < 0, mesh.triangles[:, ::-1], mesh.triangles)
    faces = replace(mesh, triangles=turned)
    tails, heads, owners = _outline(faces, lying)
    middle = mesh.vertices + np.outer(used.mean() - heights, normal)
    rims = np.stack([middle - _HEIGHT / 2 * normal, middle + _HEIGHT / 2 * normal])
    a, b, c, d = np.concatenate([rims[0, [tails, heads]], rims[1, [heads, tails]]])
    corners = np.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
    walls = TriangleMesh(
        corners, np.arange(len(corners)).reshape(-1, 3), np.repeat(owners, 2)
    )
    return FlatMesh(faces, walls, normal)


def _surely_thick(mesh: TriangleMesh) -> bool:
    """Return whether a few vertices show already that a mesh is not flat."""
    few = mesh.triangles[:: -(-len(mesh.triangles) // _FEW)].ravel()
    # Their extent is at least twice their standard deviation, in any direction.
    return bool(np.linalg.eigvalsh(np.cov(mesh.vertices[few].T))[0] > _FLAT**2)


def _lifts(mesh: TriangleMesh, normal: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Return which triangles to turn, (T,), and which lie in the plane, (T,).

    Those whose value is negative are to be turned. The triangles of a polygon have one
    value, unless it crosses itself: its triangles then face both ways.
    """
    heights, rows = mesh.areas * (mesh.normals @ normal), mesh.polygons
    totals = np.bincount(rows, mesh.areas)
    lifts = np.bincount(rows, heights)
    lifts = np.where(totals > _TINY, lifts, lifts.sum())
    lying = np.abs(lifts) > _LYING * totals
    crossed = ~lying & (np.bincount(rows, np.abs(heights)) > _LYING * totals)
    return np.where(crossed[rows], heights, lifts[rows]), (lying | crossed)[rows]


def _outline(
    faces: TriangleMesh, lying: BoolArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Return the edges that have faces on only one side.

    This also finds holes, and the outline of folded or layered faces.

    Parameters
    ----------
    faces : TriangleMesh
        All triangles wound the same way.
    lying : (T,) bool
        Whether each triangle lies in the plane; the others are ignored.

    Returns
    -------
    tails, heads : (E,) int
        Vertices at the ends of each edge; faces are on its left, seen from above.
    owners : (E,) int
        Polygon on the left, one of them where there are several.
    """
    sides = [0, 1, 1, 2, 2, 0]
    welded = faces.welded_triangles[lying][:, sides].reshape(-1, 2).astype(np.int64)
    edges = faces.triangles[lying][:, sides].reshape(-1, 2)
    forward = welded[:, 0] < welded[:, 1]
    keys = welded.min(axis=1) * (welded.max() + 1) + welded.max(axis=1)
    _, first, edge_of, uses = np.unique(
        keys, return_index=True, return_inverse=True, return_counts=True
    )
    n_forward = np.bincount(edge_of, forward)
    first = first[(n_forward == 0) | (n_forward == uses)]
    tails, heads = edges[first].T
    return tails, heads, np.repeat(faces.polygons[lying], 3)[first]
