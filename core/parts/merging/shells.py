"""The shells of a shape as its parts, such as the boards of a shelf.

Likely pairs and the wish for symmetric parts may divide such a board, or take one side
of a rod as a part. People seldom do: it was made as one thing, and runs through others.
"""

from __future__ import annotations

from dataclasses import replace

from ...geometry.graphs.components import components_at_once
from ...steps.arrays import IntArray
from ..part_psi import count_parts
from ..partition import Partitioner
from .pieces import connected_parts, merge_to


def whole_shells(
    partitioner: Partitioner, parts: IntArray, most: int
) -> IntArray | None:
    """Return the shells of a shape, if psi gains by none of the seams within them.

    Parameters
    ----------
    partitioner : Partitioner
    parts : (P,) int
        Part of each node; seams are tried where these meet.
    most : int
        Largest number of parts.

    Returns
    -------
    (P,) int or None
        Shell of each node; small ones join the nearest. None if there is one shell, or
        too many, or if one is better divided by psi, counted from lines of sight alone.
    """
    linked = partitioner.graph
    graph = replace(linked, links=linked.links[:0])
    shells = components_at_once(graph.neighbors, graph.n_polygons)
    if count_parts(shells) > 1:
        shells = connected_parts(linked, shells, partitioner.smallest_area)
    n_shells = count_parts(shells)
    if not 1 < n_shells <= most:
        return None
    finer = parts * n_shells + shells
    finer = connected_parts(linked, finer, partitioner.smallest_area)
    touching = graph.borders(finer, count_parts(finer)).toarray() > 0
    tally, alpha = partitioner.tally_seen(finer), partitioner.parameters.alpha
    merged = merge_to(most, tally, touching, alpha, further=True)
    return shells if count_parts(merged) == n_shells else None
