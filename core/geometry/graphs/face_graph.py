"""The graph of a mesh's polygons: which are neighbors, and how they meet."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ...steps.arrays import BoolArray, FloatArray, Int32Array, IntArray
from ...steps.memo import Memo, digest
from ...steps.progress import Progress, Steps, within
from ...steps.rows import blocks
from ..frames import cross, unit
from ..mesh import TriangleMesh
from .components import components_at_once, components_of_labels, graph_of
from .edges import ends_of_sides, shared_edges

# A seam along an edge costs exp(-CREASE * bend) of the edge's length; `bend` is its
# concave angle in radians.
CREASE = 4.0
# Labels whose pieces are kept: with another smallest part, most are asked for again.
_MOST_KNOWN = 96


@dataclass(frozen=True, eq=False)
class FaceGraph:
    """A graph of polygons (or points of a cloud) that share edges.

    Attributes
    ----------
    areas : (P,) float
    centers, normals : (P, 3) float
        Area-weighted means of each polygon. Normals are unit vectors, or 0.
    neighbors : (E, 2) int
        The two polygons at each shared edge.
    lengths : (E,) float
        Length of the shared edge.
    bends : (E,) float
        Angle between the normals in radians, positive at creases (concave).
    links : (L, 2) int
        Touching polygons of different shells.
    outline : (P,) float or None
        Length of the outline along each polygon of a flat mesh.
    """

    areas: FloatArray
    centers: FloatArray
    normals: FloatArray
    neighbors: NDArray[np.integer[Any]]
    lengths: FloatArray
    bends: FloatArray
    links: IntArray = field(default_factory=lambda: np.zeros((0, 2), np.int64))
    outline: FloatArray | None = None

    @property
    def n_polygons(self) -> int:
        """Number of polygons P."""
        return len(self.areas)

    @property
    def weights(self) -> FloatArray:
        """Expected share of the samples on each polygon, (P,), sum 1."""
        sampled = self.areas if self.outline is None else self.outline
        return sampled / sampled.sum()

    @property
    def seam_costs(self) -> FloatArray:
        """Cost of a seam along each edge, (E,): creases cost less than ridges."""
        return self.lengths * np.exp(-CREASE * np.maximum(self.bends, 0.0))

    @cached_property
    def seams_between(self) -> sparse.csr_array:
        """Cost of all seams between every two polygons, (P, P), symmetric."""
        ends = np.concatenate([self.neighbors, self.neighbors[:, ::-1]])
        costs = np.tile(self.seam_costs, 2), tuple(ends.T)
        return sparse.csr_array(costs, shape=2 * (self.n_polygons,))

    def areas_of(self, labels: IntArray) -> FloatArray:
        """Return the total area of each label 0…K − 1, (K,) float.

        Parameters
        ----------
        labels : (P,) int
        """
        return np.bincount(labels, self.areas).astype(np.float64)

    def shells(self) -> IntArray:
        """Return the shell number of each polygon, (P,) int."""
        return connected_components(self._graph, directed=False)[1].astype(np.int64)

    @cached_property
    def _graph(self) -> sparse.csr_array:
        """Adjacency matrix (P, P) of the polygons, without links."""
        return graph_of(self.neighbors, self.n_polygons)

    @cached_property
    def _arcs(self) -> IntArray:
        """(2, A) ends of each stored entry of the adjacency matrix."""
        tails = np.repeat(np.arange(self.n_polygons), np.diff(self._graph.indptr))
        return np.stack([tails, self._graph.indices])

    @cached_property
    def _known(self) -> Memo[bytes, Int32Array]:
        """Maps the digest of labels to the component of one label of each polygon."""
        return Memo(_MOST_KNOWN)

    def pieces(self, labels: IntArray, firm_area: float) -> IntArray:
        """Return the piece of each polygon, connected and of one label, (P,) int.

        A link joins pieces that are each a whole shell, or have at least `firm_area`.
        Small fragments beside another shell stay separate.

        Parameters
        ----------
        labels : (P,) int
        firm_area : float
        """
        make = partial(components_of_labels, self._graph, self._arcs, labels)
        pieces = self._known.recall(digest(labels), make).astype(np.int64)
        tied = self.links[labels[self.links[:, 0]] == labels[self.links[:, 1]]]
        ends = pieces[tied]
        ends = ends[ends[:, 0] != ends[:, 1]]
        if len(ends) == 0:
            return pieces
        fit = self.areas_of(pieces) >= firm_area
        if not fit[ends].all():
            across, whole = pieces[self._arcs], np.ones(len(fit), dtype=bool)
            whole[across[:, across[0] != across[1]]] = False
            ends = ends[(fit | whole)[ends].all(axis=1)]
        return components_at_once(ends, len(fit))[pieces]

    def borders(self, labels: IntArray, n_labels: int) -> sparse.csr_array:
        """Return the border length between every two labels, (K, K) sparse float.

        Parameters
        ----------
        labels : (P,) int
        n_labels : int
        """
        crossing, one, other = self._crossing(labels)
        lengths = self._border_lengths[crossing]
        ends = np.concatenate([one, other]), np.concatenate([other, one])
        shape = n_labels, n_labels
        borders = sparse.coo_array((np.tile(lengths, 2), ends), shape=shape)
        return borders.tocsr()

    def alone(self, labels: IntArray, n_labels: int) -> BoolArray:
        """Return whether each label 0…K − 1 touches no other label, (K,) bool."""
        alone = np.ones(n_labels, dtype=bool)
        alone[np.concatenate(self._crossing(labels)[1:])] = False
        return alone

    def _crossing(self, labels: IntArray) -> tuple[IntArray, IntArray, IntArray]:
        """Return where labels differ, of all edges and then links, and both labels."""
        one, other = (labels[ends] for ends in self._ends)
        crossing = np.flatnonzero(one != other)
        return crossing, one[crossing], other[crossing]

    @cached_property
    def _border_lengths(self) -> FloatArray:
        """(E + L,) lengths of edges and links: never 0, since labels border there."""
        lengths = np.concatenate([self.lengths, np.zeros(len(self.links))])
        return np.where(lengths == 0, np.finfo(float).tiny, lengths)

    @cached_property
    def _ends(self) -> IntArray:
        """(2, E + L) ends of edges and links, each row contiguous."""
        return np.concatenate([self.neighbors, self.links]).T.astype(np.int64, "C")

    def part(self, kept: IntArray) -> FaceGraph:
        """Return the graph of some polygons, numbered in the order of `kept`.

        Parameters
        ----------
        kept : (M,) int
        """
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


def face_graph(mesh: TriangleMesh) -> Steps[FaceGraph]:
    """Return the polygons of `mesh` as a FaceGraph without links and outline.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of FaceGraph
    """
    yield from mesh.normals_in_steps()
    # Area of each polygon, and its center and normal times its area.
    areas = np.zeros(mesh.n_polygons)
    centers = np.zeros((len(areas), 3))
    yield Progress("Surface", 0.0)
    normals = np.zeros((len(areas), 3))
    for rows in blocks(len(mesh.triangles)):
        yield Progress("Surface", 0.4 * rows.start / len(mesh.triangles))
        weights = mesh.areas[rows]
        middles = mesh.vertices[mesh.triangles[rows]].sum(axis=1) / 3
        columns = [np.ones_like(weights), *middles.T, *mesh.normals[rows].T]
        totals = [areas, *centers.T, *normals.T]
        for total, column in zip(totals, columns, strict=True):
            np.add.at(total, mesh.polygons[rows], weights * column)
    for rows in blocks(len(areas)):
        yield Progress("Surface", 0.4 + 0.1 * rows.start / len(areas))
        normals[rows] = unit(normals[rows])
        centers[rows] /= np.where(areas[rows] > 0, areas[rows], 1.0)[:, None]
    # A polygon without area takes a vertex as its center.
    empty = np.flatnonzero((areas == 0)[mesh.polygons])[::-1]
    centers[mesh.polygons[empty]] = mesh.vertices[mesh.triangles[empty, 0]]
    neighbors, sides = yield from within(shared_edges(mesh), 0.5, 0.7)
    lengths, bends = np.empty((2, len(neighbors)))
    for rows in blocks(len(neighbors)):
        yield Progress("Surface", 0.7 + 0.3 * rows.start / len(neighbors))
        ends = np.stack(ends_of_sides(mesh.triangles, sides[rows]))
        along = np.subtract(*mesh.vertices[ends[::-1]])
        lengths[rows] = np.linalg.norm(along, axis=1)
        one, other = normals[neighbors[rows].T]
        bends[rows] = _bends(one, other, along)
    return FaceGraph(areas, centers, normals, neighbors, lengths, bends)


def _bends(normals: FloatArray, others: FloatArray, along: FloatArray) -> FloatArray:
    """Return the signed angle (E,) between two normals (E, 3), positive at creases.

    `along` (E, 3) is the edge as it runs around the second polygon. What counts is on
    which side this begins there: the center of a face around a hole may be anywhere.
    """
    angles = np.arccos(np.clip((normals * others).sum(axis=1), -1.0, 1.0))
    rises = (cross(others, along) * normals).sum(axis=1)
    return np.where(rises > 0, angles, -angles)
