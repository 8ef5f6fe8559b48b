"""Parts between closed loops of creases, such as the steps of a shaft.

Lines of sight alone would rather cut a wide plate across than leave it whole beside the
pin on it, and leave a shaft whole whose steps are low. People cut where a crease runs
around, however much psi that costs.
"""

from __future__ import annotations

from collections.abc import Container
from dataclasses import replace
from functools import cached_property

import numpy as np

from ...geometry.graphs.face_graph import FaceGraph
from ...geometry.labels import sums_by_label
from ...steps.arrays import BoolArray, IntArray
from ...steps.memo import computed_once
from ...steps.progress import Steps, run
from ..part_psi import count_parts
from ..partition import Partitioner
from .flush import flush_seams
from .pieces import connected_parts, pieces_between
from .shells import whole_shells, with_crossings

# Least concave angle of a crease, in radians, and of the corners of an outline.
_CREASED = 0.25
_CORNER = 0.15
# Pieces with a smaller share of the area are not counted. Nor is less of a part: less
# than this share of it, as few nodes may be exchanged where small pieces join others.
_LEAST_PIECE = 0.01
_ALL = 0.99
# Pieces whose mean normal is longer than this are flat.
_FLAT = 0.85
# A fillet is narrower than this, relative to the square root of the area, and its
# borders bend by less than this on average, in radians.
_NARROW = 0.05
_ROUNDED = 1.05
# Weight of loops among the borders across which small pieces join others.
_TINY = 1e-6
# What a seam as long as the square root of the area costs, in psi. From 0.17 to 0.25
# little changes. With 0.15 low steps are missed, with 0.3 birds lose their wings.
_SEAM_PRICE = 0.2
# A seam that gains less than this share of that price is none.
_IDLE = 0.1


class CreaseParts:
    """The pieces of a shape between closed loops of creases.

    Parameters
    ----------
    partitioner : Partitioner
        What makes other parts. For point clouds, for parts of a shape and where only
        some pairs of samples are known, no pieces are proposed.
    """

    def __init__(self, partitioner: Partitioner) -> None:
        self._partitioner = partitioner

    @cached_property
    def pieces(self) -> IntArray:
        """(P,) piece of each node, small ones merged; 0 for all if none is proposed."""
        graph = self._graph
        if graph.outline is not None:
            return self._between_corners(graph)
        if not self._partitioner.visibility.shows_all_of_solid:
            return np.zeros(graph.n_polygons, dtype=np.int64)
        least = _LEAST_PIECE * graph.areas.sum()
        seams = graph.bends > _CREASED
        seams |= flush_seams(graph, seams)
        pieces = connected_parts(graph, pieces_between(graph, seams), least)
        if count_parts(pieces) == 1:
            return pieces
        return _joined(graph, pieces, _flat(graph, pieces) | _fillets(graph, pieces))

    def _between_corners(self, graph: FaceGraph) -> IntArray:
        """Return the pieces (P,) of a flat shape between its concave corners.

        There are many. So neighbors are merged while their seam costs more than they
        gain in psi.
        """
        partitioner, area = self._partitioner, graph.areas.sum()
        # A small piece has little of both the area and the outline.
        shares = np.maximum(graph.areas / area, graph.weights)
        pieces = connected_parts(
            replace(graph, areas=shares),
            pieces_between(graph, graph.bends > _CORNER),
            partitioner.parameters.smallest_part,
        )
        most, price = partitioner.parameters.max_parts, _price(graph)
        priced = replace(graph, lengths=graph.seam_costs)
        return partitioner.merged(pieces, most, priced, price, further=True)

    def better(
        self, parts: IntArray, low: int, high: int, *others: IntArray
    ) -> IntArray:
        """Return the best of some parts, the pieces, both seams, shells, and one part.

        If `low` is below `high`, seams that gain next to nothing are left out of it.

        Parameters
        ----------
        parts : (P,) int
            Part of each node, of `low` to `high`, found without the pieces.
        low, high : int
            Least and largest number of parts. One part competes only if `low` is 1.
        *others : (P,) int
            More such parts.

        Returns
        -------
        (P,) int
            `parts` itself if nothing is better and all its seams gain.
        """
        found, n_pieces = list(others), count_parts(self.pieces)
        partitioner = self._partitioner
        if n_pieces > 1:
            n_parts = min(max(n_pieces, low), high)
            found.append(run(partitioner.resized_in_steps(self.pieces, n_parts)))
            found.append(self._with_loops(parts, high))
            found.append(np.zeros_like(parts))
        if low < high and partitioner.visibility.shows_all_of_solid:
            shells = whole_shells(partitioner, high, self._priced)
            found += [] if shells is None else [shells]
        rivals = [each for each in found if low <= count_parts(each) <= high]
        best = max([parts, *rivals], key=self._worth) if rivals else parts
        best = self._without_idle_seams(best, low) if low < high else best
        return parts if best is parts else self._evened(best, range(low, high + 1))

    def _evened(self, parts: IntArray, wanted: Container[int]) -> IntArray:
        """Return symmetric parts, (P,), or the same ones if these are clearly worse.

        Psi is counted from likely pairs, as wherever parts are made symmetric.
        """
        partitioner = self._partitioner
        if not partitioner.by_psi:
            return parts
        even = run(partitioner.symmetric(parts, wanted))
        rated = [(each.psi - self._price_of(each.parts), each.parts) for each in even]
        rating, best = max(rated, key=lambda each: each[0], default=(-np.inf, parts))
        least = partitioner.psi(parts) - self._price_of(parts)
        return best if rating >= least - partitioner.sampling_error else parts

    def _without_idle_seams(self, parts: IntArray, low: int) -> IntArray:
        """Return the parts, (P,), merged where a seam gains a small share of its cost.

        They stay as they are if fewer than `low` would be left.
        """
        n_parts = count_parts(parts)
        merged = self._partitioner.merged(
            parts, n_parts, self._priced, _IDLE, further=True
        )
        return merged if low <= count_parts(merged) < n_parts else parts

    def _with_loops(self, parts: IntArray, most: int) -> IntArray:
        """Return the parts, cut along the loops too; at most so many (P,)."""
        partitioner, n_pieces = self._partitioner, count_parts(self.pieces)
        # What is small joins across seams rather than across loops: these are cut.
        lengths = np.where(self._on_loops, _TINY, 1.0) * self._graph.lengths
        graph = replace(self._graph, lengths=lengths)
        finer = parts * n_pieces + self.pieces
        finer = connected_parts(graph, finer, partitioner.smallest_area)
        small = _slivers(self._graph, finer, parts) | _fillets(self._graph, finer)
        finer = _joined(graph, finer, small)
        return partitioner.merged(finer, most, self._priced, 1.0)

    def _worth(self, parts: IntArray) -> float:
        """Return psi of parts (P,), less what their seams cost."""
        return self._partitioner.psi_seen(parts) - self._price_of(parts)

    def _price_of(self, parts: IntArray) -> float:
        """Return what the seams of parts (P,) cost."""
        one, other = parts[self._graph.neighbors].T
        return float(self._priced.lengths[one != other].sum())

    @computed_once
    def graph_in_steps(self) -> Steps[FaceGraph]:
        """Return the graph, with edges where shells cross."""
        return (yield from with_crossings(self._partitioner))

    @property
    def _graph(self) -> FaceGraph:
        return run(self.graph_in_steps())

    @cached_property
    def _priced(self) -> FaceGraph:
        """The graph; its lengths are what a seam along each edge costs, in psi.

        To leave an edge of a loop uncut would cost what a seam there saves by the
        crease. So that much is taken off.
        """
        graph = self._graph
        saved = np.where(self._on_loops, graph.lengths - graph.seam_costs, 0.0)
        return replace(graph, lengths=_price(graph) * (graph.seam_costs - saved))

    @cached_property
    def _on_loops(self) -> BoolArray:
        """(E,) whether each edge is on a loop, between two pieces."""
        one, other = self.pieces[self._graph.neighbors].T
        return one != other


def _price(graph: FaceGraph) -> float:
    """Return what a seam costs per length, in psi."""
    return float(_SEAM_PRICE / np.sqrt(graph.areas.sum()))


def _flat(graph: FaceGraph, pieces: IntArray) -> BoolArray:
    """Return whether each piece is as flat as the floor of a pocket or a dish, (K,)."""
    areas = graph.areas_of(pieces)
    normals = sums_by_label(graph.areas[:, None] * graph.normals, pieces, len(areas))
    return np.linalg.norm(normals, axis=1) > _FLAT * areas


def _fillets(graph: FaceGraph, pieces: IntArray) -> BoolArray:
    """Return whether each piece is a strip that rounds off a crease, (K,)."""
    n_pieces, areas = count_parts(pieces), graph.areas_of(pieces)
    lengths = graph.borders(pieces, n_pieces).sum(axis=1)
    bent = replace(graph, lengths=graph.lengths * graph.bends)
    bends = bent.borders(pieces, n_pieces).sum(axis=1)
    narrow = 2 * areas < _NARROW * np.sqrt(areas.sum()) * lengths
    return narrow & (bends < _ROUNDED * lengths)


def _slivers(graph: FaceGraph, finer: IntArray, parts: IntArray) -> BoolArray:
    """Return which pieces, (K,), are what lies between a seam and a loop beside it.

    `finer` (P,) are pieces of `parts` (P,).
    """
    areas, of_parts = graph.areas_of(finer), np.empty(count_parts(finer))
    of_parts[finer] = graph.areas_of(parts)[parts]
    return areas < np.minimum(_LEAST_PIECE * graph.areas.sum(), _ALL * of_parts)


def _joined(graph: FaceGraph, pieces: IntArray, small: BoolArray) -> IntArray:
    """Return pieces (P,), of which the `small` ones, (K,) bool, join a neighbor."""
    areas = np.where(small[pieces], 0.0, graph.areas)
    least = areas[areas > 0].min(initial=np.inf)
    return connected_parts(replace(graph, areas=areas), pieces, least)
