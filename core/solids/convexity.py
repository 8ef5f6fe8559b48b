"""Whether a closed mesh is convex: then no ray and no sample is needed."""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from ..geometry.frames import HEIGHTS_AT_ONCE, heights_above
from ..geometry.graphs.edges import Edges, corner_of_sides
from ..geometry.mesh import TriangleMesh
from ..steps.arrays import FloatArray
from ..steps.beside import beside
from ..steps.progress import Progress, Steps, within
from ..steps.rows import blocks, used_rows
from .shells import Shells
from .slivers import solid_edges
from .volume import signed_volume

# Heights that count as rounding, in diagonals: vertices are in single precision. Rays
# start a thousand times deeper below the surface.
_ROUNDING = 1e-6
# Share of the volume that counts as rounding.
_SAME_VOLUME = 1e-5
# Largest number of edges that are looked at in a step.
_MOST_EDGES = 2**17


def is_convex(mesh: TriangleMesh, shells: Shells) -> Steps[bool]:
    """Return whether a mesh is the surface of one convex solid, but for rounding.

    It is if it is one closed shell, no edge is concave, all vertices lie on its convex
    hull, and it encloses the volume of the hull. Every two of its points then see each
    other. Most other meshes have a concave edge, which is found quickly.

    Parameters
    ----------
    mesh : TriangleMesh
        Oriented: closed shells face outwards.
    shells : Shells
        Its shells.

    Returns
    -------
    Steps of bool
    """
    if len(shells.closed) > 1 or not shells.closed[0]:
        return False
    edges, _ = yield from within(solid_edges(mesh), 0.0, 0.0)
    if edges.crowded:
        return False
    if (yield from _has_concave_edge(mesh, edges)):
        return False
    done = Progress("Surface", 1.0)
    all_used = used_rows(mesh.triangles, len(mesh.vertices))
    points = mesh.vertices[(yield from within(all_used, 1.0, 1.0))]
    try:
        hull = yield from beside(lambda: ConvexHull(points), done)
    except QhullError:  # it is flat
        return False
    volume = yield from within(signed_volume(mesh), 1.0, 1.0)
    if abs(volume - hull.volume) > _SAME_VOLUME * hull.volume:
        return False
    inner = np.setdiff1d(np.arange(len(hull.points)), hull.vertices)
    if not len(inner):
        return True
    planes = np.unique(hull.equations, axis=0)  # Qhull gives one for each triangle
    steps = _on_planes(hull.points[inner], planes, _ROUNDING * mesh.diagonal)
    return (yield from steps)


def _has_concave_edge(mesh: TriangleMesh, edges: Edges) -> Steps[bool]:
    """Return whether a triangle has a neighbor that rises above it.

    Every edge of the mesh has exactly two triangles.
    """
    yield from mesh.normals_in_steps()
    pairs = edges.sides.reshape(-1, 2)  # sides, three for each triangle
    for rows in blocks(len(pairs), _MOST_EDGES):
        yield Progress("Surface", rows.start / len(pairs))
        one, other = pairs[rows].T
        opposite = corner_of_sides(mesh.triangles, other, 2)
        starts = corner_of_sides(mesh.triangles, one, 0)
        offsets = mesh.vertices[opposite] - mesh.vertices[starts]
        heights = np.einsum("ed,ed->e", offsets, mesh.normals[one // 3])
        if heights.max() > _ROUNDING * mesh.diagonal:
            return True
    return False


def _on_planes(points: FloatArray, planes: FloatArray, rounding: float) -> Steps[bool]:
    """Return whether each point within planes lies on one of them."""
    for rows in blocks(len(points), HEIGHTS_AT_ONCE // len(planes)):
        yield Progress("Surface", 1.0)
        if heights_above(planes, points[rows]).max(axis=1).min() < -rounding:
            return False
    return True
