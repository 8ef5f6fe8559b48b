"""Which nodes of a graph are connected, and which lie beside other labels."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ...steps.arrays import BoolArray, Int32Array, IntArray
from ...steps.progress import Progress, Steps

# Most nodes whose connected components are found in one step.
_MOST_NODES = 2**20


def components(pairs: NDArray[np.integer[Any]], n_nodes: int) -> Steps[IntArray]:
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
        n_found, one = 0, pairs[:, 0] // _MOST_NODES
        yield Progress("Surface", 0.0)
        # The block of both nodes of a pair, or −1.
        blocks_of = np.where(one == pairs[:, 1] // _MOST_NODES, one, -1)
        for block, start in enumerate(range(0, n_nodes, _MOST_NODES)):
            yield Progress("Surface", 0.8 * start / n_nodes)
            inside = pairs[blocks_of == block] - start
            yield Progress("Surface", 0.8 * start / n_nodes)
            nodes = found[start : start + _MOST_NODES]
            graph = graph_of(inside, len(nodes))
            yield Progress("Surface", 0.8 * start / n_nodes)
            n_more, nodes[:] = connected_components(graph, directed=False)
            nodes += n_found
            n_found += n_more
            yield Progress("Surface", 0.8 * start / n_nodes)
        pairs = found[pairs[blocks_of == -1]]
    yield Progress("Surface", 0.9)
    return components_at_once(pairs, n_found)[found]


def components_at_once(pairs: NDArray[np.integer[Any]], n_nodes: int) -> IntArray:
    """Return what `components` does, for a small graph.

    Parameters
    ----------
    pairs : (E, 2) int
        Nodes that are connected.
    n_nodes : int
    """
    graph = graph_of(pairs, n_nodes)
    return connected_components(graph, directed=False)[1].astype(np.int64)


def components_of_labels(
    graph: sparse.csr_array, arcs: IntArray, labels: IntArray
) -> Int32Array:
    """Return the component of each node where only equal labels are connected, (N,).

    Parameters
    ----------
    graph : (N, N) sparse
        Adjacency matrix.
    arcs : (2, A) int
        Row and column of each stored entry, in 64 bits: NumPy is quicker so.
    labels : (N,) int
    """
    alike = labels[arcs[0]] == labels[arcs[1]]
    starts = np.zeros(len(alike) + 1, dtype=np.int32)
    np.cumsum(alike, out=starts[1:])
    # Any numbers will do as the weights of the arcs that are left.
    rest = graph.data[: starts[-1]], graph.indices[alike], starts[graph.indptr]
    within = sparse.csr_array(rest, graph.shape)
    return connected_components(within, directed=False)[1]


def nodes_at_seams(neighbors: NDArray[np.integer[Any]], labels: IntArray) -> BoolArray:
    """Return the nodes that have a neighbor with another label, (N,).

    Parameters
    ----------
    neighbors : (E, 2) int
    labels : (N,) int
    """
    at_seams = np.zeros(len(labels), dtype=bool)
    one, other = labels[neighbors].T
    at_seams[neighbors[one != other]] = True
    return at_seams


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
