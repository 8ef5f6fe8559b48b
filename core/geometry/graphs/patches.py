"""Patches: small connected groups of polygons that stand for a large mesh.

Parts of a mesh of millions of polygons are searched on some 8,000 patches, so that
the time of the search does not depend on the mesh. Only the polygons along the seams
count on their own again, when the seams are cut.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...steps.arrays import BoolArray, FloatArray, IntArray
from ...steps.progress import Progress, Steps, within
from ...steps.rows import blocks
from ..frames import unit
from ..labels import sums_by_label
from .components import components
from .face_graph import CREASE, FaceGraph

# Edges with a larger angle, in radians, are borders of patches.
_SHARP = 0.7
# A patch with less than this share of the mean area joins a neighbor, even across a
# sharp edge.
_LEAST_SHARE = 0.3
# Weight of a sharp edge in the choice of that neighbor.
_SHARP_WEIGHT = 0.01
# Rounds in which small patches join neighbors.
_ROUNDS = 4
# Cells get numbers by these factors. Only cells beside each other are compared.
_CELL_NUMBERS = (1, 1 << 21, 1 << 42)


@dataclass(frozen=True, eq=False)
class Patches:
    """The nodes of a graph in patches.

    Attributes
    ----------
    fine : FaceGraph
        Graph of the P nodes.
    coarse : FaceGraph
        Graph of the patches.
    of_nodes : (P,) int
        Patch of each node.
    """

    fine: FaceGraph
    coarse: FaceGraph
    of_nodes: IntArray

    def labels_of(self, labels: IntArray) -> IntArray:
        """Return the label that most of the area of each patch has, (G,).

        Parameters
        ----------
        labels : (P,) int
            Label of each node, from 0.
        """
        n_labels, n_patches = int(labels.max()) + 1, self.coarse.n_polygons
        cells = self.of_nodes * n_labels + labels
        areas = np.bincount(cells, self.fine.areas, n_patches * n_labels)
        return areas.reshape(n_patches, n_labels).argmax(axis=1)

    def opened(self, chosen: BoolArray) -> Steps[tuple[FaceGraph, IntArray]]:
        """Return the graph in which the nodes of some patches count on their own.

        Parameters
        ----------
        chosen : (G,) bool
            The patches to open.

        Returns
        -------
        graph : FaceGraph
            First the other patches in their order, then the nodes of the chosen ones.
        places : (P,) int
            Place of each of the P nodes in that graph.
        """
        patches = np.flatnonzero(~chosen)
        yield Progress("Seams", 0.0)
        free = chosen[self.of_nodes]
        nodes = np.flatnonzero(free)
        yield Progress("Seams", 0.1)
        places = (np.cumsum(~chosen) - 1)[self.of_nodes]
        places[nodes] = len(patches) + np.arange(len(nodes))
        beside = np.empty(len(self.fine.neighbors), dtype=bool)
        for rows in blocks(len(beside)):
            yield Progress("Seams", 0.2 + 0.7 * rows.start / len(beside))
            beside[rows] = free[self.fine.neighbors[rows]].any(axis=1)
        fine, coarse = self.fine, self.coarse.part(patches)
        graph = FaceGraph(
            np.concatenate([coarse.areas, fine.areas[nodes]]),
            np.concatenate([coarse.centers, fine.centers[nodes]]),
            np.concatenate([coarse.normals, fine.normals[nodes]]),
            np.concatenate([coarse.neighbors, places[fine.neighbors[beside]]]),
            np.concatenate([coarse.lengths, fine.lengths[beside]]),
            np.concatenate([coarse.bends, fine.bends[beside]]),
            outline=None
            if coarse.outline is None or fine.outline is None
            else np.concatenate([coarse.outline, fine.outline[nodes]]),
        )
        return graph, places


def find_patches(graph: FaceGraph, n_patches: int) -> Steps[Patches]:
    """Group the nodes of a graph into connected patches of about equal area.

    Space is divided into cubes. The nodes in a cube that are connected without a sharp
    edge are a patch, and small patches join a neighbor. There is no randomness.

    Parameters
    ----------
    graph : FaceGraph
        Without links.
    n_patches : int
        Wanted number of patches. There are more if many nodes are not connected.

    Returns
    -------
    Steps of Patches
    """
    yield Progress("Patches", 0.0)
    area = graph.areas.sum() / n_patches
    # A mirror plane through the origin halves cubes, so that patches are symmetric.
    cells = np.zeros(graph.n_polygons, dtype=np.int64)
    for column, number in zip(graph.centers.T, _CELL_NUMBERS, strict=True):
        cells += np.round(column / np.sqrt(area)).astype(np.int64) * number
        yield Progress("Patches", 0.2)
    inside = cells[graph.neighbors[:, 0]] == cells[graph.neighbors[:, 1]]
    yield Progress("Patches", 0.3)
    smooth = np.abs(graph.bends) <= _SHARP
    steps = components(graph.neighbors[inside & smooth], graph.n_polygons)
    patches = yield from within(steps, 0.4, 0.6)
    crossing = np.flatnonzero(
        patches[graph.neighbors[:, 0]] != patches[graph.neighbors[:, 1]]
    )
    pairs, inside = patches[graph.neighbors[crossing]], inside[crossing]
    weights = graph.lengths[crossing] * np.where(smooth[crossing], 1.0, _SHARP_WEIGHT)
    yield Progress("Patches", 0.7)
    areas = graph.areas_of(patches)
    # Where every edge is sharp, as on noisy surfaces, small patches of a cube are one.
    small = areas < _LEAST_SHARE * area
    specks = pairs[inside & small[pairs].all(axis=1)]
    groups = yield from within(components(specks, len(areas)), 0.7, 0.8)
    for turn in range(_ROUNDS):
        done = 0.8 + 0.1 * turn / _ROUNDS
        yield Progress("Patches", done)
        joins = _joins(groups[pairs], weights, np.bincount(groups, areas) / area)
        n_groups = int(groups.max()) + 1
        parents = yield from within(components(joins, n_groups), done, done)
        groups = parents[groups]
    patches = groups[patches]
    coarse = yield from within(contracted(graph, patches), 0.9, 1.0)
    return Patches(graph, coarse, patches)


def _joins(pairs: IntArray, weights: FloatArray, areas: NDArray[Any]) -> IntArray:
    """Return small patches and the neighbors that they join, (J, 2).

    It is the larger neighbor with the longest common border. `areas` are shares of the
    mean area.
    """
    n_patches = len(areas)
    places = np.argsort(np.argsort(-areas, kind="stable"))
    tiny = areas < _LEAST_SHARE
    both = np.concatenate([pairs, pairs[:, ::-1]])
    wanted = tiny[both[:, 0]] & (places[both[:, 1]] < places[both[:, 0]])
    keys, owners = np.unique(both[wanted] @ (n_patches, 1), return_inverse=True)
    lengths = np.bincount(owners, np.tile(weights, 2)[wanted], len(keys))
    small, others = np.divmod(keys, n_patches)
    order = np.lexsort([others, -lengths, small])
    first = order[np.diff(small[order], prepend=-1) > 0]
    return np.stack([small[first], others[first]], axis=1)


def contracted(graph: FaceGraph, groups: IntArray) -> Steps[FaceGraph]:
    """Return the graph of groups of nodes, without links.

    Between two groups there is one edge. It is as long as all edges between their
    nodes, and a seam along it costs as much.

    Parameters
    ----------
    graph : FaceGraph
    groups : (P,) int
        Group of each node, in 0…G − 1, each used.

    Returns
    -------
    Steps of FaceGraph
    """
    yield Progress("Patches", 0.0)
    areas, counts = graph.areas_of(groups), np.bincount(groups)
    empty = (areas == 0)[groups]
    weights = np.where(empty, 1.0, graph.areas)[:, None]
    totals = np.where(areas == 0, counts, areas)[:, None]
    n_groups = len(areas)
    yield Progress("Patches", 0.3)
    pairs = groups[graph.neighbors]
    yield Progress("Patches", 0.5)
    crossing = np.flatnonzero(pairs[:, 0] != pairs[:, 1])
    keys = np.sort(pairs[crossing], axis=1) @ (n_groups, 1)
    keys, edges = np.unique(keys, return_inverse=True)
    yield Progress("Patches", 0.6)
    lengths = np.bincount(edges, graph.lengths[crossing], len(keys))
    costs = np.bincount(edges, graph.seam_costs[crossing], len(keys))
    shares = np.divide(costs, lengths, out=np.ones(len(keys)), where=lengths > 0)
    yield Progress("Patches", 0.7)
    centers = sums_by_label(weights * graph.centers, groups, n_groups) / totals
    yield Progress("Patches", 0.9)
    return FaceGraph(
        areas,
        centers,
        unit(sums_by_label(weights * graph.normals, groups, n_groups)),
        np.stack(np.divmod(keys, n_groups), axis=1),
        lengths.astype(np.float64),
        -np.log(np.maximum(shares, np.finfo(float).tiny)) / CREASE,
        outline=None
        if graph.outline is None
        else np.bincount(groups, graph.outline).astype(np.float64),
    )
