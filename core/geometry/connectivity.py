"""Which triangles share an edge, and which nodes of a graph are connected."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ..steps.progress import Progress, Steps
from .mesh import TriangleMesh

# Most nodes whose connected components are found in one step.
_MOST_NODES = 2**20


class Edges(NamedTuple):
    """The sides of all triangles, sorted by edge; coinciding vertices count as one.

    Attributes
    ----------
    sides : (3T,) int32
        Side 3t + i of triangle t runs from its corner i to the next one.
    first : (E,) int
        Place in `sides` of the first side of each edge.
    """

    sides: NDArray[np.int32]
    first: NDArray[np.int64]


def sort_edges(mesh: TriangleMesh) -> Steps[Edges]:
    """Sort the sides of a mesh's triangles by edge.

    Parameters
    ----------
    mesh : TriangleMesh

    Returns
    -------
    Steps of Edges
    """
    yield Progress("Surface", 0.0)
    tails = mesh.welded_triangles
    yield Progress("Surface", 0.3)
    heads = tails[:, [1, 2, 0]]
    lower = np.minimum(tails, heads).ravel()
    higher = np.maximum(tails, heads).ravel()
    yield Progress("Surface", 0.5)
    sides = _order(higher)
    yield Progress("Surface", 0.7)
    sides = sides[_order(lower[sides])]
    yield Progress("Surface", 0.9)
    lower, higher = lower[sides], higher[sides]
    new = np.ones(len(sides), dtype=bool)
    new[1:] = (lower[1:] != lower[:-1]) | (higher[1:] != higher[:-1])
    return Edges(sides, np.flatnonzero(new))


def shared_edges(
    mesh: TriangleMesh, edges: Edges
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return which polygons have a common edge.

    Parameters
    ----------
    mesh : TriangleMesh
    edges : Edges
        Its edges.

    Returns
    -------
    neighbors : (E, 2) int32
        Pairs of polygons.
    sides : (E,) int32
        A side of a triangle along the edge of each pair.
    """
    owners = mesh.polygons.astype(np.int32)[edges.sides // 3]
    shared = owners[1:] != owners[:-1]
    shared[edges.first[1:] - 1] = False
    neighbors = np.stack([owners[:-1][shared], owners[1:][shared]], axis=1)
    return neighbors, edges.sides[:-1][shared]


def components(
    pairs: NDArray[np.integer[Any]], n_nodes: int
) -> Steps[NDArray[np.int64]]:
    """Return the connected component of each node of a graph.

    Parameters
    ----------
    pairs : (E, 2) int
        Nodes that are connected.
    n_nodes : int

    Returns
    -------
    Steps of (`n_nodes`,) int
        Components are numbered in the order of their first nodes.
    """
    found, n_found = np.arange(n_nodes), n_nodes
    if n_nodes > _MOST_NODES:
        # Most neighbors have near numbers: few are in different blocks.
        n_found, blocks_of = 0, pairs // _MOST_NODES
        for block, start in enumerate(range(0, n_nodes, _MOST_NODES)):
            inside = (blocks_of == block).all(axis=1)
            yield Progress("Surface", 0.8 * start / n_nodes)
            nodes = found[start : start + _MOST_NODES]
            graph = graph_of(pairs[inside] - start, len(nodes))
            yield Progress("Surface", 0.8 * start / n_nodes)
            n_more, nodes[:] = connected_components(graph, directed=False)
            nodes += n_found
            n_found += n_more
            yield Progress("Surface", 0.8 * start / n_nodes)
        pairs = found[pairs[(blocks_of[:, 0] != blocks_of[:, 1])]]
    graph = graph_of(pairs, n_found)
    yield Progress("Surface", 0.9)
    components: NDArray[np.int64] = connected_components(graph, directed=False)[1]
    return components.astype(np.int64)[found]


def components_at_once(
    pairs: NDArray[np.integer[Any]], n_nodes: int
) -> NDArray[np.int64]:
    """Return the connected component of each node of a small graph, (`n_nodes`,).

    Parameters
    ----------
    pairs : (E, 2) int
        Nodes that are connected.
    n_nodes : int
    """
    found = connected_components(graph_of(pairs, n_nodes), directed=False)[1]
    return found.astype(np.int64)


def graph_of(pairs: NDArray[np.integer[Any]], n_nodes: int) -> sparse.csr_array:
    """Return the adjacency matrix (n_nodes, n_nodes) of pairs of nodes.

    Parameters
    ----------
    pairs : (E, 2) int
    n_nodes : int
    """
    return sparse.csr_array(
        (np.ones(len(pairs)), tuple(pairs.T)), shape=(n_nodes, n_nodes)
    )


def _order(numbers: NDArray[np.int32]) -> NDArray[np.int32]:
    """Return a stable order of numbers from 0. SciPy's counting sort beats NumPy's."""
    n_rows = len(numbers)
    ones = np.ones(n_rows, dtype=np.int8)
    rows = sparse.csr_array((ones, numbers, np.arange(n_rows + 1, dtype=np.int32)))
    order: NDArray[np.int32] = rows.tocsc().indices
    return order
