"""The shells of a shape as its parts, such as the boards of a shelf.

Where one shell enters another there is no edge, so that seams have no crease to run in.
Lines of sight alone cut a patch off one of them there, or one side of a rod. People
seldom do: each was made as one thing. So the line in which shells cross counts as such
a crease, though less: it shows what was put together, not what is seen.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ...geometry.graphs.face_graph import FaceGraph
from ...sight.prepared import PreparedShape
from ...solids.crossings import find_crossings
from ...steps.arrays import IntArray
from ...steps.progress import Steps
from ..part_psi import count_parts
from ..partition import Partitioner
from .pieces import connected_parts, merge_to

# Shells with fewer samples are not told from those beside them by what they see.
_FEW_SAMPLES = 10
# Least angle at which shells cross, in radians.
_CLEAR = 0.25
# Smaller shells, relative to the area, save nothing: half of an eye is hidden.
_LEAST_SHELL = 0.015
# A crossing counts this share of a crease. With 0.5, some columns of a temple are no
# parts; with 1, more shells are than parts after a Boolean union.
_SHARE = 0.65


def with_crossings(partitioner: Partitioner) -> Steps[FaceGraph]:
    """Return the graph with edges where shells cross; links between such shells go.

    Parameters
    ----------
    partitioner : Partitioner

    Returns
    -------
    Steps of FaceGraph
        The same one for point clouds, for parts of a shape and where only some pairs of
        samples are known.
    """
    graph, shape = partitioner.graph, partitioner.visibility.shape
    shells = shape.shells
    if not partitioner.visibility.shows_all_of_solid or shells is None:
        return graph
    targets = shape.targets
    counted = np.where(shape.marcher.closed, shells, -1)
    found = yield from find_crossings(targets, counted)
    clear = found.bends > _CLEAR
    pairs, areas = found.pairs[clear], np.bincount(shells, targets.areas)
    large = areas >= _LEAST_SHELL * areas.sum()
    nodes = partitioner.memo.off_patches(np.arange(graph.n_polygons))[targets.polygons]
    connected = graph.shells()
    crosses = np.isin(connected, connected[nodes[pairs]])
    lengths = _SHARE * found.lengths[clear] * large[shells[pairs]].all(axis=1)
    return replace(
        graph,
        neighbors=np.concatenate([graph.neighbors, nodes[pairs]]),
        lengths=np.concatenate([graph.lengths, lengths]),
        bends=np.concatenate([graph.bends, found.bends[clear]]),
        links=graph.links[~crosses[graph.links].all(axis=1)],
    )


def whole_shells(
    partitioner: Partitioner, most: int, priced: FaceGraph
) -> IntArray | None:
    """Return the shells, those merged by which psi gains more than their seam saves.

    Parameters
    ----------
    partitioner : Partitioner
    most : int
        Largest number of parts.
    priced : FaceGraph
        With edges where shells cross, and what seams there cost as lengths.

    Returns
    -------
    (P,) int or None
        Part of each node: one shell or several; small shells join the nearest. None if
        there is one shell. Psi is counted from lines of sight alone.
    """
    visibility, graph = partitioner.visibility, partitioner.graph
    shape, told = visibility.shape, visibility.shape.shells
    if told is None:
        return None
    few = _FEW_SAMPLES / len(visibility.samples) * shape.targets.areas.sum()
    least = max(partitioner.smallest_area, few)
    shells = partitioner.memo.on_patches(_large_shells(shape, told, least))
    areas = np.where(shells == 0, 0.0, graph.areas)
    shells = connected_parts(replace(graph, areas=areas), shells, least)
    n_shells = count_parts(shells)
    if n_shells == 1:
        return None
    borders = priced.borders(shells, n_shells).toarray()
    tally, alpha = partitioner.tally_seen(shells), partitioner.parameters.alpha
    return merge_to(most, tally, borders, alpha, 1.0, further=True)[shells]


def _large_shells(shape: PreparedShape, shells: IntArray, least: float) -> IntArray:
    """Return the number of the shell of each node, (P,), from 1.

    It is 0 for those of small shells, and where no ray meets the surface, as on faces
    that are there twice.

    Parameters
    ----------
    shape : PreparedShape
    shells : (T,) int
        Shell of each triangle of its targets.
    least : float
        Area of a large shell, in squared diagonals.
    """
    large = np.bincount(shells, shape.targets.areas) >= least
    found = np.zeros(shape.n_nodes, dtype=np.int64)
    found[shape.targets.polygons] = np.where(large, np.cumsum(large), 0)[shells]
    return found
