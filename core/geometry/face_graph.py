"""The polygons of a mesh as a graph: what labels move along."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from .frames import unit
from .mesh import TriangleMesh


@dataclass(frozen=True, eq=False)
class FaceGraph:
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
        return _components(self._graph)

    @cached_property
    def _graph(self) -> sparse.csr_array:
        """Return the neighbors as a matrix: pieces are asked for over and over."""
        return _graph_of(self.neighbors, self.n_polygons)

    @cached_property
    def _tails(self) -> NDArray[np.int64]:
        """Return the row of each entry of the matrix."""
        return np.repeat(np.arange(self.n_polygons), np.diff(self._graph.indptr))

    def pieces(self, labels: NDArray[np.int64], firm_area: float) -> NDArray[np.int64]:
        """Return connected pieces of polygons with one label, (P,) int.

        Links connect whole shells and what is larger than `firm_area`, not the specks
        that a label may have next to another shell.
        """
        pieces = self._pieces_of_shells(labels)
        if len(self.links) == 0:
            return pieces
        firm = self.areas_of(pieces) >= firm_area
        one, other = pieces[self.neighbors].T
        crossing = np.flatnonzero(one != other)
        whole = np.ones(len(firm), dtype=bool)
        whole[one[crossing]] = whole[other[crossing]] = False
        tied = (firm | whole)[pieces][self.links].all(axis=1)
        tied &= labels[self.links[:, 0]] == labels[self.links[:, 1]]
        return _components(_graph_of(pieces[self.links[tied]], len(firm)))[pieces]

    def _pieces_of_shells(self, labels: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return connected pieces of polygons with one label, without links."""
        graph = self._graph
        alike = labels[self._tails] == labels[graph.indices]
        starts = np.concatenate([[0], np.cumsum(alike)])[graph.indptr]
        rest = graph.data[alike], graph.indices[alike], starts
        return _components(sparse.csr_array(rest, graph.shape))

    def borders(self, labels: NDArray[np.int64], n_labels: int) -> sparse.csr_array:
        """Return the length of the border between every two labels, (K, K)."""
        pairs = labels[np.concatenate([self.neighbors, self.links])]
        # A link is a border where there is no other.
        lengths = np.concatenate([self.lengths, np.zeros(len(self.links))])
        crossing = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
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

    def alone(self, labels: NDArray[np.int64], n_labels: int) -> NDArray[np.bool_]:
        """Return which labels border on no other, (K,)."""
        alone = np.ones(n_labels, dtype=bool)
        for pairs in (labels[self.neighbors], labels[self.links]):
            alone[pairs[pairs[:, 0] != pairs[:, 1]]] = False
        return alone

    def part(self, kept: NDArray[np.int64]) -> FaceGraph:
        """Return the surface of some polygons, rows in ascending order."""
        places = np.full(self.n_polygons, -1)
        places[kept] = np.arange(len(kept))
        neighbors, links = places[self.neighbors], places[self.links]
        within = (neighbors >= 0).all(axis=1)
        return FaceGraph(
            self.areas[kept],
            self.centers[kept],
            self.normals[kept],
            neighbors[within],
            self.lengths[within],
            self.bends[within],
            links[(links >= 0).all(axis=1)],
            None if self.outline is None else self.outline[kept],
        )

    def linked(self, links: NDArray[np.int64]) -> FaceGraph:
        """Return the surface with links (L, 2) between polygons that touch."""
        return replace(self, links=links)


def face_graph(mesh: TriangleMesh) -> FaceGraph:
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
    sums = _sum_by(mesh.polygons, mesh.areas[:, None] * mesh.normals, n_polygons)
    normals = unit(sums)
    neighbors, ends = _shared_edges(mesh)
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    bends = _bends(centers, normals, neighbors)
    return FaceGraph(areas, centers, normals, neighbors, lengths, bends)


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
    keys = mesh.edge_keys
    order = np.argsort(keys, kind="stable")
    keys, owners = keys[order], mesh.polygons[order // 3]
    shared = (keys[1:] == keys[:-1]) & (owners[1:] != owners[:-1])
    neighbors = np.stack([owners[:-1][shared], owners[1:][shared]], axis=1)
    starts = order[:-1][shared]
    ends = np.stack([starts, starts + np.where(starts % 3 < 2, 1, -2)], axis=1)
    return neighbors, mesh.vertices[mesh.triangles.ravel()[ends]]


def _sum_by(
    groups: NDArray[np.int64], rows: NDArray[np.float64], n_groups: int
) -> NDArray[np.float64]:
    """Return the sum of the rows of each group, (n_groups, 3)."""
    return np.stack(
        [np.bincount(groups, rows[:, axis], n_groups) for axis in range(3)], axis=1
    )


def _graph_of(pairs: NDArray[np.int64], n_nodes: int) -> sparse.csr_array:
    """Return the graph of pairs of nodes, (n_nodes, n_nodes)."""
    return sparse.csr_array(
        (np.ones(len(pairs)), tuple(pairs.T)), shape=(n_nodes, n_nodes)
    )


def _components(graph: sparse.csr_array) -> NDArray[np.int64]:
    """Return the connected component of each node."""
    return connected_components(graph, directed=False)[1].astype(np.int64)
