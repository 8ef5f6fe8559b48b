"""Refines a mesh, so that seams can be found that run through its large faces."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from ...steps.arrays import FloatArray, IntArray
from ..mesh import TriangleMesh

# About the number of triangles that the surface of a mesh of few is refined to.
_ENOUGH = 6000
# Mean area of the triangles that remain, in squared longest edges.
_MEAN_AREA = 0.2
# A mesh of more triangles is not refined further.
_MOST = 40_000


class Cut(NamedTuple):
    """A plane that cuts some faces of a mesh.

    Attributes
    ----------
    point, normal : (3,) float
        A point of the plane, in the units of the mesh, and its unit normal.
    faces : (F,) int
        The faces that it cuts.
    """

    point: FloatArray
    normal: FloatArray
    faces: IntArray


@dataclass(frozen=True, eq=False)
class RefinedMesh:
    """A mesh whose large faces are divided into small triangles.

    Attributes
    ----------
    mesh : TriangleMesh
        The same surface. Each triangle of a divided face is a polygon of its own.
    faces : (Q,) int
        Polygon of the original mesh that each polygon is a piece of.
    size : float
        Greatest length wanted of edges in divided faces, in the units of the mesh.
        Some stay longer where the mesh has reached 40,000 triangles.
    """

    mesh: TriangleMesh
    faces: IntArray
    size: float

    def centers(self) -> tuple[FloatArray, FloatArray]:
        """Return the center (Q, 3) and area (Q,) of each polygon."""
        mesh, n_polygons = self.mesh, len(self.faces)
        middles = mesh.vertices[mesh.triangles].mean(axis=1)
        areas = np.bincount(mesh.polygons, mesh.areas, n_polygons).astype(np.float64)
        # Polygons without area have centers, too.
        weights = mesh.areas + np.finfo(float).tiny
        totals = np.bincount(mesh.polygons, weights, n_polygons)
        sums = [
            np.bincount(mesh.polygons, weights * column, n_polygons)
            for column in middles.T
        ]
        return np.stack(sums, axis=1) / totals[:, None], areas


def refined(mesh: TriangleMesh) -> RefinedMesh:
    """Divide the triangles of a mesh until no edge is long, or there are 40,000.

    Both triangles at an edge divide it at the same point, so that no gap opens.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    RefinedMesh
        The mesh itself, if its triangles are small already.
    """
    size = float(np.sqrt(mesh.areas.sum() / (_ENOUGH * _MEAN_AREA)))
    places, first = np.unique(mesh.welded_triangles, return_index=True)
    vertices = mesh.vertices[mesh.triangles.ravel()[first]]
    triangles = np.searchsorted(places, mesh.welded_triangles)
    owners = np.arange(len(triangles))
    while len(triangles) < _MOST:
        middles, more = _middles_of_long(vertices, triangles, size)
        if len(more) == 0:
            break
        vertices = np.concatenate([vertices, more])
        while (middles >= 0).any():
            triangles, middles, rows = _halved(vertices, triangles, middles)
            owners = owners[rows]
    if len(triangles) == len(mesh.triangles):
        return RefinedMesh(mesh, np.arange(mesh.n_polygons), size)
    order = np.argsort(mesh.polygons[owners], kind="stable")
    triangles, owners = triangles[order], owners[order]
    polygons = mesh.polygons[owners]
    divided = np.bincount(polygons) > np.bincount(mesh.polygons)
    starts = np.ones(len(polygons), dtype=bool)
    starts[1:] = divided[polygons[1:]] | (polygons[1:] != polygons[:-1])
    fine = replace(
        mesh,
        vertices=vertices,
        triangles=triangles,
        polygons=np.cumsum(starts) - 1,
    )
    return RefinedMesh(fine, polygons[starts], size)


def _middles_of_long(
    vertices: FloatArray, triangles: IntArray, size: float
) -> tuple[IntArray, FloatArray]:
    """Return new vertices (N, 3) on long edges, the longest of some triangle.

    Return also the number of the new vertex on each side (T, 3), −1 for none.
    """
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2)
    pairs, edges = np.unique(
        np.sort(ends.reshape(-1, 2), axis=1), axis=0, return_inverse=True
    )
    edges = edges.reshape(triangles.shape)
    lengths = np.linalg.norm(np.diff(vertices[pairs], axis=1)[:, 0], axis=1)
    longest = edges[np.arange(len(edges)), lengths[edges].argmax(axis=1)]
    cut = np.zeros(len(pairs), dtype=bool)
    cut[longest] = lengths[longest] > size
    numbers = np.where(cut, len(vertices) + np.cumsum(cut) - 1, -1)
    return numbers[edges], vertices[pairs[cut]].mean(axis=1)


def _halved(
    vertices: FloatArray, triangles: IntArray, middles: IntArray
) -> tuple[IntArray, IntArray, IntArray]:
    """Halve triangles at the longest of their sides that have a new vertex.

    Return the triangles, the new vertices on their sides that are left, and the former
    triangle of each.
    """
    corners = vertices[triangles]
    lengths = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)
    side = np.where(middles >= 0, lengths, -1.0).argmax(axis=1)
    turned = (side[:, None] + np.arange(3)) % 3
    a, b, c = np.take_along_axis(triangles, turned, axis=1).T
    middle, beyond, before = np.take_along_axis(middles, turned, axis=1).T
    cut = middle >= 0
    none = np.full(int(cut.sum()), -1)
    halves = np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)
    left = (
        np.stack([none, none, before[cut]], axis=1),
        np.stack([none, beyond[cut], none], axis=1),
    )
    rows = np.arange(len(triangles))
    return (
        np.concatenate([triangles[~cut], *(half[cut] for half in halves)]),
        np.concatenate([middles[~cut], *left]),
        np.concatenate([rows[~cut], rows[cut], rows[cut]]),
    )
