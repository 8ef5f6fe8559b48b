"""Keeps intermediate results of a visibility, so that other parts are found quickly."""

from __future__ import annotations

from functools import cached_property
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..clusters.embedding import coordinates_for, embed
from ..geometry.graphs.face_graph import FaceGraph
from ..geometry.graphs.patches import Patches, find_patches
from ..geometry.graphs.pieces import whole_polygons, with_small_pieces
from ..geometry.symmetry import Plane, Side, find_plane, find_sides
from ..geometry.transfer import NearestSamples, Transfer, carry, spacing_of
from ..parameters.parts import Parameters
from ..sight.pair_tally import PairTally
from ..sight.visibility import Visibility
from ..steps.arrays import FloatArray, IntArray
from ..steps.memo import Memo, computed_once
from ..steps.progress import Steps, run, within
from .details.surface import PartSurface

# Most polygons that are their own patches. More are grouped into a fifth as many. With
# half as many, parts are no better, and take twice the time when parameters change.
_MOST_NODES = 40_000
# A smoothness, a least psi and a digest of parts.
SeamsKey: TypeAlias = tuple[float, float | None, bytes]


class Candidate(NamedTuple):
    """Parts before their seams are cut.

    Attributes
    ----------
    parts : (P,) int
        Part of each node.
    psi : float
        Their quality (eq. 5).
    even : bool
        Whether the parts were made symmetric to the shape's mirror plane.
    """

    parts: IntArray
    psi: float
    even: bool = False


class FoundMemo:
    """Results for one set of clusters, refinement, alpha and smallest part.

    Attributes
    ----------
    candidates : Memo
        Maps a number of parts to its candidate.
    plain : Memo
        Maps a number of parts to the connected parts from k-means' clusters.
    even : Memo
        Maps the number of a side and the digest of parts to symmetric parts.
    searches : Memo
        Maps the first and last number tried to the candidate for each number.
    given : Memo
        Maps a number given, the least and largest number, and a smoothness to `Search`.
    seams, looks, fine : Memo
        Map a smoothness, a least psi and the digest of parts to the parts with their
        seams cut, well or for a first look, with the digest of ragged nodes behind, to
        smooth ones; a smoothness and parts of patches to those of the nodes in them.
    """

    def __init__(self) -> None:
        self.candidates: Memo[int, Candidate] = Memo()
        self.plain: Memo[int, IntArray] = Memo()
        self.even: Memo[tuple[int, bytes], IntArray] = Memo(64)
        self.given: Memo[tuple[int, int, int, float], Any] = Memo(32)
        self.searches: Memo[tuple[int, int], dict[int, Candidate]] = Memo()
        self.seams: Memo[SeamsKey, Any] = Memo(32)
        self.looks: Memo[SeamsKey, Any] = Memo(32)
        self.fine: Memo[tuple[float, bytes], NDArray[np.uint16]] = Memo(16)


class PartMemo:
    """A visibility, with the intermediate results that were computed from it.

    They only save time: parts do not depend on them, other than a first look.

    Parameters
    ----------
    visibility : Visibility

    Attributes
    ----------
    visibility : Visibility
    patches : Patches or None
        The patches of a large graph, which get labels in its nodes' place; known once
        `transfer_in_steps` has run.
    tallies : Memo
        Maps the digest and number of labels, and whether seen, to counts of pairs.
    on_nodes, pieces : Memo
        Map the digest and number of labels of samples to those of the nodes, and a
        smallest area and the digest of labels to connected parts.
    moves : Memo
        Maps the digest and number of labels, and alpha, to the labels after all moves.
    clusters : Memo
        Maps a normalization, a seed, and the numbers of clusters and of coordinates to
        the labels of samples by k-means.
    surfaces : Memo
        Maps the digest of a part's place to its surface.
    tried : dict of int to Candidate
        The candidates of the latest search, by number of parts; none at first.
    """

    def __init__(self, visibility: Visibility) -> None:
        self.visibility = visibility
        self.patches: Patches | None = None
        self.tried: dict[int, Candidate] = {}
        self._transfer: Transfer | None = None
        # Once it was looked for: (None,) if the shape has no mirror plane.
        self._plane: tuple[Plane | None] | None = None
        self.tallies: Memo[tuple[bytes, int, bool], PairTally] = Memo(256)
        self.on_nodes: Memo[tuple[bytes, int], IntArray] = Memo(64)
        self.pieces: Memo[tuple[float, bytes], IntArray] = Memo(24)
        self.moves: Memo[tuple[bytes, int, float], IntArray] = Memo(32)
        self.clusters: Memo[tuple[str, int, int, int], IntArray] = Memo(1024)
        self.surfaces: Memo[bytes, PartSurface] = Memo(16)
        self._embeddings: Memo[tuple[int, bool], FloatArray] = Memo(2)
        self._found: Memo[tuple[str, int, str, float, float], FoundMemo] = Memo(3)

    def found_with(self, parameters: Parameters) -> FoundMemo:
        """Return the memo of what is found with these parameters.

        Parameters
        ----------
        parameters : Parameters
            `normalization`, `seed`, `refinement`, `alpha` and `smallest_part` are used.

        Returns
        -------
        FoundMemo
        """
        key = (
            parameters.normalization,
            parameters.seed,
            parameters.refinement,
            parameters.alpha,
            parameters.smallest_part,
        )
        return self._found.recall(key, FoundMemo)

    def embedding(self, n_parts: int, parameters: Parameters) -> FloatArray:
        """Return the embedding of the samples, with enough coordinates for the parts.

        Parameters
        ----------
        n_parts : int
            Least number of coordinates.
        parameters : Parameters
            Only `normalization` is used.

        Returns
        -------
        (N, n) float
            Leading eigenvectors; n < `n_parts` only if there are too few samples.
        """
        n_coordinates = coordinates_for(n_parts)
        stochastic = parameters.normalization == "STOCHASTIC"
        return self._embeddings.recall(
            (n_coordinates, stochastic),
            lambda: embed(self.visibility.affinity, n_coordinates, stochastic),
        )

    @property
    def transfer(self) -> Transfer:
        """Carries labels of samples to the nodes of the graph, or to its patches."""
        return run(self.transfer_in_steps())

    def transfer_in_steps(self) -> Steps[Transfer]:
        """Return the steps that make `transfer`, if it is not known yet."""
        if self._transfer is None:
            graph = yield from within(self.visibility.shape.graph_in_steps(), 0.0, 0.6)
            nodes = self.visibility.nodes
            if graph.n_polygons > _MOST_NODES:
                grouping = find_patches(graph, _MOST_NODES // 5)
                self.patches = yield from within(grouping, 0.6, 0.9)
                graph, nodes = self.patches.coarse, self.patches.of_nodes[nodes]
            steps = carry(self.visibility.samples, nodes, graph)
            self._transfer = yield from within(steps, 0.9, 1.0)
        return self._transfer

    def on_patches(self, labels: IntArray) -> IntArray:
        """Return labels (P,) of the nodes as those of the patches, if there are any."""
        return labels if self.patches is None else self.patches.labels_of(labels)

    def off_patches(self, labels: IntArray) -> IntArray:
        """Return labels of the patches, if there are any, as those of the nodes."""
        return labels if self.patches is None else labels[self.patches.of_nodes]

    @cached_property
    def _nearest(self) -> NearestSamples:
        """Finds the samples that are nearest to nodes of other graphs."""
        samples = self.visibility.samples
        return NearestSamples(samples, spacing_of(samples, self.transfer.graph))

    def on(
        self, graph: FaceGraph, nodes: IntArray, numbers: IntArray
    ) -> Steps[PartMemo]:
        """Return a memo of the same visibility, for parts of another graph.

        What depends on samples alone is shared.

        Parameters
        ----------
        graph : FaceGraph
            Of the same surface, without links.
        nodes : (N,) int
            Node of this graph that each sample lies on.
        numbers : (P,) int
            A number of each node that is the same in all such graphs.

        Returns
        -------
        Steps of PartMemo
        """
        memo, samples = PartMemo(self.visibility), self.visibility.samples
        memo._transfer = yield from carry(samples, nodes, graph, self._nearest, numbers)
        memo._plane = self._plane
        memo.tallies, memo.moves = self.tallies, self.moves
        memo.clusters, memo._embeddings = self.clusters, self._embeddings
        return memo

    @computed_once
    def sides(self) -> Steps[tuple[Side, ...]]:
        """Return the two sides of the shape's mirror plane, none if it has no plane.

        Returns
        -------
        Steps of tuple of Side
        """
        graph = (yield from self.transfer_in_steps()).graph
        surface, shape = whole_polygons(graph), self.visibility.shape
        if self._plane is None:
            plane = yield from find_plane(surface)
            is_whole_mesh = shape.plane is None and graph.n_polygons == shape.n_nodes
            if plane is None and is_whole_mesh and not shape.is_cloud:
                small = yield from with_small_pieces(graph, shape.targets)
                if small is not None:
                    surface, plane = small, (yield from find_plane(small))
            self._plane = (plane,)
        return (yield from find_sides(surface, *self._plane))
