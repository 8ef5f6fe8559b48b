"""Parts between closed loops of creases, such as the steps of a shaft.

Lines of sight alone would rather cut a wide plate across than leave it whole beside the
pin on it. People cut where a crease runs around the pin, however much psi that costs.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...geometry.connectivity import components_at_once
from ...geometry.face_graph import FaceGraph
from ..partition import Partitioner, count_parts
from .pieces import connected_parts, merge_to

# Least concave angle of a crease, in radians, and of the corners of an outline.
_CREASED = 0.3
_CORNER = 0.15
# Pieces with a smaller share of the area are not counted.
_LEAST_PIECE = 0.01
# Psi that pieces may lack, for each unit that their seams cost less. Machines and
# tables need up to 0.07; from 0.4 on, animals would be cut at creases alone.
_SEAM_PRICE = 0.15


class CreaseParts:
    """The pieces of a shape between closed loops of creases.

    Parameters
    ----------
    partitioner : Partitioner
        What makes other parts. Where it sees no likely pairs, as in point clouds, flat
        and low-poly shapes, no pieces are proposed.
    """

    def __init__(self, partitioner: Partitioner) -> None:
        self._partitioner = partitioner

    @cached_property
    def parts(self) -> NDArray[np.int64]:
        """(P,) piece of each node, small ones merged; 0 for all if none is proposed."""
        graph = self._partitioner.graph
        if graph.outline is not None:
            return self._between_corners(graph)
        if not self._partitioner.visibility.is_guessed:
            return np.zeros(graph.n_polygons, dtype=np.int64)
        return connected_parts(
            graph, crease_pieces(graph), _LEAST_PIECE * graph.areas.sum()
        )

    def _between_corners(self, graph: FaceGraph) -> NDArray[np.int64]:
        """Return the pieces (P,) of a flat shape between its concave corners.

        There are many. So neighbors are merged while their seam costs more than they
        gain in psi.
        """
        by, area = self._partitioner, graph.areas.sum()
        # A small piece has little of both the area and the outline.
        shares = np.maximum(graph.areas / area, graph.weights)
        pieces = connected_parts(
            replace(graph, areas=shares),
            crease_pieces(graph, _CORNER),
            by.parameters.smallest_part,
        )
        costs = replace(graph, lengths=graph.seam_costs)
        borders = costs.borders(pieces, count_parts(pieces)).toarray()
        merged = merge_to(
            by.parameters.max_parts,
            by.tally(pieces),
            borders,
            by.parameters.alpha,
            _SEAM_PRICE / np.sqrt(area),
        )
        return merged[pieces]

    def resized(self, n_parts: int) -> NDArray[np.int64]:
        """Return the pieces (P,), split or merged so that there are `n_parts`."""
        return self._partitioner.resized(self.parts, n_parts)

    def beat(self, rivals: NDArray[np.int64], low: int, high: int) -> bool:
        """Return whether there are `low` to `high` pieces, and better ones than rivals.

        Parameters
        ----------
        rivals : (P,) int
            Other parts of each node.
        low, high : int
        """
        many = max(low, 2) <= count_parts(self.parts) <= high
        return many and self.gain(rivals, self.parts) >= 0

    def gain(self, rivals: NDArray[np.int64], parts: NDArray[np.int64]) -> float:
        """Return what parts gain by cheap seams, less what they lose in psi.

        Parameters
        ----------
        rivals, parts : (P,) int
        """
        by = self._partitioner
        saved = seam_cost(by.graph, rivals) - seam_cost(by.graph, parts)
        return _SEAM_PRICE * saved - (by.psi_seen(rivals) - by.psi_seen(parts))


def crease_pieces(graph: FaceGraph, creased: float = _CREASED) -> NDArray[np.int64]:
    """Return the pieces that are left when a surface is cut along all of its creases.

    A crease that ends somewhere on the surface divides nothing. Shells that touch are
    one piece.

    Parameters
    ----------
    graph : FaceGraph
    creased : float, optional
        Least concave angle of a crease, in radians.

    Returns
    -------
    (P,) int
        Piece of each polygon, in 0…K − 1.
    """
    smooth = graph.neighbors[graph.bends <= creased]
    ties = np.concatenate([smooth, graph.links])
    return components_at_once(ties, graph.n_polygons)


def seam_cost(graph: FaceGraph, labels: NDArray[np.int64]) -> float:
    """Return the length of all seams, less in creases, in square roots of the area.

    Parameters
    ----------
    graph : FaceGraph
    labels : (P,) int

    Returns
    -------
    float
    """
    one, other = labels[graph.neighbors].T
    return float(graph.seam_costs[one != other].sum() / np.sqrt(graph.areas.sum()))
