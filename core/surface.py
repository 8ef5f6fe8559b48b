"""The polygons of a mesh as a graph: what labels move along."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from .shapes import TriangleMesh


@dataclass(frozen=True, eq=False)
class Surface:
    """Polygons, and the edges that neighbors share.

    Attributes
    ----------
    areas : (P,) float
    centers, normals : (P, 3) float
        Means over each polygon's area; normals are unit vectors or 0.
    neighbors : (E, 2) int
        Polygons on both sides of an edge.
    lengths : (E,) float
        Length of the edge.
    bends : (E,) float
        Angle between the two normals in radians: positive where the surface is
        concave (a crease seen from outside), negative where it is convex.
    links : (L, 2) int
        Polygons of different shells that touch.
    outline : (P,) float or None
        Length of the outline at each polygon of a flat mesh.
    """

    areas: NDArray[np.float64]
    centers: NDArray[np.float64]
    normals: NDArray[np.float64]
    neighbors: NDArray[np.int64]
    lengths: NDArray[np.float64]
    bends: NDArray[np.float64]
    links: NDArray[np.int64] = field(default_factory=lambda: np.zeros((0, 2), np.int64))
    outline: NDArray[np.float64] | None = None

    @property
    def n_polygons(self) -> int:
        """Number of polygons P."""
        return len(self.areas)

    @property
    def weights(self) -> NDArray[np.float64]:
        """Share of the samples that each polygon can expect, (P,)."""
        sampled = self.areas if self.outline is None else self.outline
        return sampled / sampled.sum()

    def areas_of(self, labels: NDArray[np.int64]) -> NDArray[np.float64]:
        """Return the area under each label 0…K − 1, (K,)."""
        return np.bincount(labels, self.areas).astype(np.float64)

    def shells(self) -> NDArray[np.int64]:
        """Return the number of the connected shell of each polygon, (P,)."""
        return _components(self.neighbors, self.n_polygons)

    def pieces(self, labels: NDArray[np.int64], firm_area: float) -> NDArray[np.int64]:
        """Return connected pieces of polygons with one label, (P,) int.

        Links connect whole shells and what is larger than `firm_area`, not the specks
        that a label may have next to another shell.
        """
        ends = labels[self.neighbors]
        alike = self.neighbors[ends[:, 0] == ends[:, 1]]
        pieces = _components(alike, self.n_polygons)
        firm = self.areas_of(pieces) >= firm_area
        one, other = pieces[self.neighbors].T
        whole = np.ones(len(firm), dtype=bool)
        whole[one[one != other]] = whole[other[one != other]] = False
        tied = (firm | whole)[pieces][self.links].all(axis=1)
        tied &= labels[self.links[:, 0]] == labels[self.links[:, 1]]
        return _components(pieces[self.links[tied]], len(firm))[pieces]

    def borders(self, labels: NDArray[np.int64], n_labels: int) -> sparse.csr_array:
        """Return the length of the border between every two labels, (K, K)."""
        pairs = labels[np.concatenate([self.neighbors, self.links])]
        # A link is a border where there is no other.
        lengths = np.concatenate([self.lengths, np.zeros(len(self.links))])
        crossing = pairs[:, 0] != pairs[:, 1]
        one, other = pairs[crossing].T
        lengths = np.maximum(lengths[crossing], np.finfo(float).tiny)
        borders = sparse.coo_array(
            (
                np.concatenate([lengths, lengths]),
                (np.concatenate([one, other]), np.concatenate([other, one])),
            ),
            shape=(n_labels, n_labels),
        )
        return borders.tocsr()

    def part(self, kept: NDArray[np.int64]) -> Surface:
        """Return the surface of some polygons, rows in ascending order."""
        places = np.full(self.n_polygons, -1)
        places[kept] = np.arange(len(kept))
        neighbors, links = places[self.neighbors], places[self.links]
        within = (neighbors >= 0).all(axis=1)
        return Surface(
            self.areas[kept],
            self.centers[kept],
            self.normals[kept],
            neighbors[within],
            self.lengths[within],
            self.bends[within],
            links[(links >= 0).all(axis=1)],
            None if self.outline is None else self.outline[kept],
        )

    def linked(self, links: NDArray[np.int64]) -> Surface:
        """Return the surface with links (L, 2) between polygons that touch."""
        return replace(self, links=links)


def surface_of(mesh: TriangleMesh) -> Surface:
    """Return the graph of the polygons of `mesh`.

    Vertices at one place count as one, since many file formats split them.
    """
    n_polygons = mesh.n_polygons
    areas = np.bincount(mesh.polygons, mesh.areas, n_polygons).astype(np.float64)
    weighted = mesh.areas[:, None] * mesh.vertices[mesh.triangles].mean(axis=1)
    centers = _sum_by(mesh.polygons, weighted, n_polygons)
    safe = np.where(areas > 0, areas, 1.0)[:, None]
    # A polygon without area still lies somewhere.
    first = np.zeros(n_polygons, dtype=np.int64)
    first[mesh.polygons[::-1]] = mesh.triangles[::-1, 0]
    centers = np.where(areas[:, None] > 0, centers / safe, mesh.vertices[first])
    normals = _sum_by(mesh.polygons, mesh.areas[:, None] * mesh.normals, n_polygons)
    norms = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, norms, out=np.zeros_like(normals), where=norms > 0)
    neighbors, ends = _shared_edges(mesh)
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    bends = _bends(centers, normals, neighbors)
    return Surface(areas, centers, normals, neighbors, lengths, bends)


def _bends(
    centers: NDArray[np.float64],
    normals: NDArray[np.float64],
    neighbors: NDArray[np.int64],
) -> NDArray[np.float64]:
    """Return the angle between neighbors, positive where they form a crease."""
    one, other = neighbors.T
    angles = np.arccos(np.clip((normals[one] * normals[other]).sum(axis=1), -1.0, 1.0))
    rises = ((centers[other] - centers[one]) * normals[one]).sum(axis=1)
    return np.where(rises > 0, angles, -angles)


def _shared_edges(
    mesh: TriangleMesh,
) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
    """Return neighbors (E, 2) by a common edge, and its two ends (E, 2, 3)."""
    sides = [0, 1, 1, 2, 2, 0]
    edges = np.sort(mesh.welded_triangles[:, sides].reshape(-1, 2), axis=1)
    ends = mesh.vertices[mesh.triangles[:, sides]].reshape(-1, 2, 3)
    owners = np.repeat(mesh.polygons, 3)
    keys = edges[:, 0] * (edges.max() + 1) + edges[:, 1]
    order = np.argsort(keys, kind="stable")
    keys, owners, ends = keys[order], owners[order], ends[order]
    shared = (keys[1:] == keys[:-1]) & (owners[1:] != owners[:-1])
    neighbors = np.stack([owners[:-1][shared], owners[1:][shared]], axis=1)
    return neighbors, ends[:-1][shared]


def _sum_by(
    groups: NDArray[np.int64], rows: NDArray[np.float64], n_groups: int
) -> NDArray[np.float64]:
    """Return the sum of the rows of each group, (n_groups, 3)."""
    return np.stack(
        [np.bincount(groups, rows[:, axis], n_groups) for axis in range(3)], axis=1
    )


def _components(pairs: NDArray[np.int64], n_nodes: int) -> NDArray[np.int64]:
    """Return the connected component of each node, (n_nodes,)."""
    graph = sparse.coo_array(
        (np.ones(len(pairs), dtype=bool), (pairs[:, 0], pairs[:, 1])),
        shape=(n_nodes, n_nodes),
    )
    _, components = connected_components(graph, directed=False)
    return components.astype(np.int64)
