"""Finds the planes along which large faces are cut where parts meet on them."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ...steps.arrays import FloatArray, Int32Array, IntArray
from ...steps.progress import run
from ...steps.rows import RowsByNumber
from ..frames import unit
from ..graphs.components import components_at_once
from ..graphs.edges import ends_of_sides, shared_edges
from ..graphs.face_graph import face_graph
from .refined import Cut, RefinedMesh

# Weight of a piece of the seam along a concave crease, where the seam surely belongs.
_CREASE_WEIGHT = 25.0
# Least angle of such a crease, in radians.
_LEAST_CREASE = 0.3
# A plane stands upright on the surface where the seam does not say how it is tilted.
_UPRIGHT = 1.0
# A plane serves a face if the seam is this near to it on average, in longest edges.
_NEAR = 1.0


class _Seams(NamedTuple):
    """The edges (S,) of a refined mesh between polygons of different parts."""

    starts: FloatArray
    ends: FloatArray
    normals: FloatArray
    weights: FloatArray
    face: IntArray  # that the edge runs through, -1 along an original edge
    seam: IntArray  # number of the connected seam between two parts


def find_cuts(refined: RefinedMesh, labels: IntArray) -> list[Cut]:
    """Return planes that cut the faces of a mesh along the seams of parts.

    One plane is fitted to each connected seam between two parts. Where the seam is far
    from its plane, each face gets a plane of its own.

    Parameters
    ----------
    refined : RefinedMesh
    labels : (Q,) int
        Part of each polygon of the refined mesh.

    Returns
    -------
    list of Cut
        The planes with most faces first.
    """
    seams = _seams_of(refined, labels)
    cuts: list[Cut] = []
    n_seams = int(seams.seam.max(initial=-1)) + 1
    edges = RowsByNumber(seams.seam, n_seams)
    for seam in range(n_seams):
        cuts += _cuts_of_seam(seams, edges.of(seam), refined.size)
    return sorted(cuts, key=lambda cut: -len(cut.faces))


def _cuts_of_seam(seams: _Seams, rows: IntArray, size: float) -> list[Cut]:
    """Return the planes that cut the faces of one connected seam."""
    within = rows[seams.face[rows] >= 0]
    if len(within) == 0:
        return []
    point, normal = _fitted(seams, rows)
    faces, numbers = np.unique(seams.face[within], return_inverse=True)
    edges = RowsByNumber(numbers, len(faces))
    along: list[int] = []
    cuts = []
    for number, face in enumerate(faces.tolist()):
        own = within[edges.of(number)]
        starts, ends = seams.starts[own], seams.ends[own]
        lengths = np.linalg.norm(ends - starts, axis=1)
        away = np.abs(((starts + ends) / 2 - point) @ normal)
        if np.average(away, weights=lengths) <= _NEAR * size:
            along.append(face)
        else:
            cuts.append(Cut(*_fitted(seams, own), np.array([face])))
    return [*([Cut(point, normal, np.array(along))] if along else []), *cuts]


def _fitted(seams: _Seams, rows: IntArray) -> tuple[FloatArray, FloatArray]:
    """Return a point and the normal of the plane that is nearest to some edges."""
    weights = seams.weights[rows]
    points = np.concatenate([seams.starts[rows], seams.ends[rows]])
    both = np.tile(weights, 2)
    center = np.average(points, axis=0, weights=both)
    offsets = points - center
    spread = (offsets * both[:, None]).T @ offsets / both.sum()
    within = rows[seams.face[rows] >= 0]
    normals, weights = seams.normals[within], seams.weights[within]
    upright = (normals * weights[:, None]).T @ normals / weights.sum()
    spread = spread + _UPRIGHT * np.trace(spread) * upright
    return center, np.linalg.eigh(spread)[1][:, 0]


def _seams_of(refined: RefinedMesh, labels: IntArray) -> _Seams:
    """Return the edges between parts, with the connected seam each belongs to."""
    mesh = refined.mesh
    neighbors, sides = run(shared_edges(mesh))
    one, other = neighbors.T
    kept = labels[one] != labels[other]
    one, other, sides = one[kept], other[kept], sides[kept]
    starts, ends = mesh.vertices[np.stack(ends_of_sides(mesh.triangles, sides))]
    graph = run(face_graph(mesh))
    normals = unit(graph.normals[one] + graph.normals[other])
    creases = graph.bends[kept] > _LEAST_CREASE
    weights = np.where(creases, _CREASE_WEIGHT, 1.0) * graph.lengths[kept]
    weights += np.finfo(float).tiny
    inside = refined.faces[one] == refined.faces[other]
    return _Seams(
        starts,
        ends,
        normals,
        weights,
        np.where(inside, refined.faces[one], -1),
        _connected(mesh.welded_triangles, sides, labels[one], labels[other]),
    )


def _connected(
    welded: Int32Array, sides: Int32Array, one: IntArray, other: IntArray
) -> IntArray:
    """Return the number of the connected seam of each edge; `one`, `other`: parts."""
    if len(sides) == 0:
        return np.zeros(0, dtype=np.int64)
    pair = np.minimum(one, other) * (max(one.max(), other.max()) + 1)
    pair = pair + np.maximum(one, other)
    stride = int(welded.max()) + 1
    ends = np.stack(ends_of_sides(welded, sides), axis=1)
    _, nodes = np.unique(pair[:, None] * stride + ends, return_inverse=True)
    nodes = nodes.reshape(-1, 2)
    seams = components_at_once(nodes, int(nodes.max()) + 1)[nodes[:, 0]]
    return np.unique(seams, return_inverse=True)[1].astype(np.int64)
