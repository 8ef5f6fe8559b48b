"""Parts that divide a shell only where that is worth the seam.

Likely pairs and the wish for symmetric parts may divide a board of a shelf, or take one
side of a rod as a part. People seldom do: such a shell was made as one thing, and runs
through others.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from ...geometry.graphs.components import components_at_once
from ..part_psi import count_parts
from ..partition import Partitioner
from .pieces import connected_parts, merge_to


def within_shells(
    by: Partitioner,
    parts: NDArray[np.int64],
    costs: NDArray[np.float64],
    low: int,
    high: int,
) -> NDArray[np.int64] | None:
    """Cut parts along the borders of shells, and merge what is left within a shell.

    Parameters
    ----------
    by : Partitioner
    parts : (P,) int
        Part of each node.
    costs : (E,) float
        What a seam along each edge costs, in psi.
    low, high : int
        Least and largest number of parts. If they differ, neighbors are merged while
        their seam costs more than they gain in psi.

    Returns
    -------
    (P,) int or None
        None if there is one shell, or too many.
    """
    graph = replace(by.graph, lengths=costs, links=by.graph.links[:0])
    shells = components_at_once(graph.neighbors, graph.n_polygons)
    if count_parts(shells) > 1:
        shells = connected_parts(by.graph, shells, by.smallest_area)
    n_shells = count_parts(shells)
    if not 1 < n_shells <= high:
        return None
    finer = connected_parts(by.graph, parts * n_shells + shells, by.smallest_area)
    borders = graph.borders(finer, count_parts(finer)).toarray()
    tally, alpha = by.tally_seen(finer), by.parameters.alpha
    return merge_to(high, tally, borders, alpha, 1.0, further=low < high)[finer]
