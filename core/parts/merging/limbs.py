"""Merges neighbors that only a bend divides, such as the quarters of a ring.

Lines of sight end at a bend, but people keep a bent limb whole. Van Kaick et al. 2014,
"Shape Segmentation by Approximate Convexity Analysis", merge weakly convex parts whose
thickness is alike. The seam has to agree here: nothing may begin or end there.
"""

from __future__ import annotations

from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from ...geometry.frames import unit
from ...geometry.graphs.components import components_at_once
from ...geometry.graphs.face_graph import FaceGraph
from ...geometry.labels import sums_by_label
from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps
from ..part_psi import count_parts
from ..partition import Partitioner

# Largest ratio of the thicknesses of two parts of one limb.
_MOST_RATIO = 1.3
# Largest ratio of their areas between these distances from the seam, in thicknesses. An
# oblique seam makes the areas beside it unequal, not those farther away.
_MOST_WIDENING = 1.5
_WIDTH_FROM, _WIDTH_TO = 0.5, 1.2
# Largest mean turn of the surface across the seam, in radians. Around a bend it is 0,
# since what turns in on one side turns out on the other. Around a neck it is positive.
_MOST_TURN = 0.25
# Largest mean angle of the edges along the seam, in radians: above 0 in a crease. Half
# of a seam may follow the crease on the inner side of an elbow.
_MOST_CREASE = 0.9
# Parts with more neighbors than this, whose thicknesses are within this ratio of their
# own, are junctions, such as the pivot of pliers.
_MOST_NEIGHBORS = 2
_MOST_OF_JUNCTION = 1.5
# Largest share of the seam that lies beside a third part.
_MOST_SHARED = 0.3
# The surface is compared up to this far from the seam, in thicknesses.
_REACH = 0.5
# Samples on an outline are neighbors up to this far apart, in their mean distances.
_NEXT = 3.0
# Most edges of a seam that are looked at.
_MOST_EDGES = 256


class LimbMerger:
    """Merges parts that only a bend divides.

    Parameters
    ----------
    partitioner : Partitioner
        What made the parts.
    """

    def __init__(self, partitioner: Partitioner) -> None:
        self._visibility = partitioner.visibility
        self._samples = partitioner.visibility.samples
        self._transfer = partitioner.transfer

    def merge(self, parts: IntArray) -> Steps[IntArray]:
        """Return the parts after neighbors are merged that only a bend divides.

        Two parts are one limb if they are about equally thick, neither is much wider
        near their seam, the surface does not turn inwards all around the seam, as in a
        crease or a neck, no third part lies along it, and neither is a junction.

        Parameters
        ----------
        parts : (P,) int
            Part of each node, in 0…K − 1.

        Returns
        -------
        Steps of (P,) int
        """
        bends = yield from self._bends(parts)
        return components_at_once(bends, count_parts(parts))[parts]

    def _bends(self, parts: IntArray) -> Steps[IntArray]:
        """Return the pairs (B, 2) of parts of one limb."""
        thickness = self._thicknesses(parts)
        flat = self._transfer.graph.outline is not None
        labels = self._transfer.to_samples(parts) if flat else parts
        ends = np.sort(labels[self._surface.neighbors], axis=1)
        crossing = np.flatnonzero(ends[:, 0] != ends[:, 1])
        pairs, of_pair = np.unique(ends[crossing], axis=0, return_inverse=True)
        thin, thick = np.sort(thickness[pairs], axis=1).T
        near = pairs[thick <= _MOST_OF_JUNCTION * thin]
        limbs = np.bincount(near.ravel(), minlength=len(thickness)) <= _MOST_NEIGHBORS
        alike = (thin > 0) & (thick <= _MOST_RATIO * thin)
        bends = limbs[pairs].all(axis=1) & alike
        for number in np.flatnonzero(bends):
            yield Progress("Seams", number / len(pairs))
            edges = crossing[of_pair.reshape(-1) == number]
            bends[number] = self._runs_on(labels, pairs[number], edges, thin[number])
        return pairs[bends]

    def _runs_on(
        self, labels: IntArray, pair: IntArray, edges: IntArray, thickness: float
    ) -> bool:
        """Return whether the surface runs on from one part to the other.

        Parameters
        ----------
        labels : (Q,) int
            Part of each point of the surface.
        pair : (2,) int
            The two parts.
        edges : (E,) int
            Pairs of neighbors along their seam.
        thickness : float
            That of the thinner part.
        """
        surface, edges = self._surface, edges[:: -(-len(edges) // _MOST_EDGES)]
        lengths = np.maximum(surface.lengths[edges], np.finfo(float).tiny)
        lengths = lengths / lengths.sum()
        if lengths @ surface.bends[edges] > _MOST_CREASE:
            return False
        turns, shared = self._turns(labels, pair, edges, _REACH * thickness)
        if lengths @ turns > _MOST_TURN or lengths @ shared > _MOST_SHARED:
            return False
        seam = cKDTree(surface.centers[surface.neighbors[edges]].mean(axis=1))
        beside = np.flatnonzero(np.isin(labels, pair))
        far = seam.query(surface.centers[beside])[0] / thickness
        first = labels[beside] == pair[0]
        if min(far[first].max(), far[~first].max()) < _WIDTH_TO:
            return True  # a piece too short to have a width
        areas = ((far > _WIDTH_FROM) & (far < _WIDTH_TO)) * surface.areas[beside]
        sides = np.bincount(first, areas, 2)
        return bool(sides.max() <= _MOST_WIDENING * sides.min())

    @cached_property
    def _surface(self) -> FaceGraph:
        """The graph of the nodes; of a flat shape, that of the samples."""
        graph, samples = self._transfer.graph, self._samples
        if graph.outline is None:
            return graph
        next_to = _NEXT * graph.outline.sum() / len(samples)
        tree = cKDTree(samples.positions)
        pairs = tree.query_pairs(next_to, output_type="ndarray")
        areas, lengths = np.ones(len(samples)), np.ones(len(pairs))
        places = samples.positions, samples.normals
        return FaceGraph(areas, *places, pairs, lengths, np.zeros(len(pairs)))

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self._surface.centers)

    def _turns(
        self, labels: IntArray, pair: IntArray, edges: IntArray, reach: float
    ) -> tuple[FloatArray, BoolArray]:
        """Return how far the surface turns inwards across each edge of a seam, (E,).

        Return also whether a third part is within reach.
        """
        surface, numbers = self._surface, np.arange(len(edges))
        ends = surface.neighbors[edges]
        near = self._tree.query_ball_point(surface.centers[ends].mean(axis=1), reach)
        rows = np.concatenate(
            [np.repeat(numbers, list(map(len, near))), *[numbers] * 2]
        )
        around = np.concatenate([*near, *ends.T]).astype(np.int64)
        columns = np.ones(len(around)), surface.centers[around], surface.normals[around]
        values = surface.areas[around, None] * np.column_stack(columns)
        sides, other = [], np.ones(len(around), dtype=bool)
        for part in pair:
            own = labels[around] == part
            other &= ~own
            sums = sums_by_label(values[own], rows[own], len(edges))
            total = np.maximum(sums[:, :1], np.finfo(float).tiny)
            sides.append((sums[:, 1:4] / total, unit(sums[:, 4:])))
        (center, normal), (other_center, other_normal) = sides
        across = unit(other_center - center)
        turns = (across * (normal - other_normal)).sum(axis=1)
        return turns, np.bincount(rows, other, len(edges)) > 0

    def _thicknesses(self, parts: IntArray) -> FloatArray:
        """Return the median thickness of each part, (K,), nan if it is unknown."""
        labels, thickness = self._transfer.to_samples(parts), self._visibility.thickness
        known = np.isfinite(thickness)
        medians = np.full(count_parts(parts), np.nan)
        for part in np.unique(labels[known]):
            medians[part] = np.median(thickness[known & (labels == part)])
        return medians
