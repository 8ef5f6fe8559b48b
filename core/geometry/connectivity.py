"""Which triangles share an edge, and which nodes of a graph are connected."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.csgraph import connected_components

from ..steps.progress import Progress, Steps, run, within
from ..steps.rows import blocks
from .mesh import TriangleMesh

# About the most sides of triangles that are sorted in one step.
_MOST_SIDES = 2**20
# Most nodes whose connected components are found in one step.
_MOST_NODES = 2**20
# So few pairs are connected one by one: SciPy takes as long to begin.
_FEW_PAIRS = 16


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
    tails = yield from within(mesh.welded_in_steps(), 0.0, 0.4)
    lower, higher = np.empty((2, tails.size), dtype=np.int32)
    for block in blocks(len(tails)):
        yield Progress("Surface", 0.4 + 0.1 * block.start / len(tails))
        heads = tails[block][:, [1, 2, 0]]
        some = slice(3 * block.start, 3 * block.stop)
        np.minimum(tails[block], heads, out=lower[some].reshape(-1, 3))
        np.maximum(tails[block], heads, out=higher[some].reshape(-1, 3))
    yield Progress("Surface", 0.5)
    n_ranges = -(-len(lower) // _MOST_SIDES)
    width = int(lower.max()) // n_ranges + 1
    range_of = np.empty(len(lower), dtype=np.int16)
    for block in blocks(len(lower)):
        yield Progress("Surface", 0.5)
        range_of[block] = lower[block] // width
    sides, new = np.empty(len(lower), dtype=np.int32), np.empty(len(lower), dtype=bool)
    start = 0
    for number in range(n_ranges):
        yield Progress("Surface", 0.5 + 0.5 * number / n_ranges)
        rows = np.flatnonzero(range_of == number).astype(np.int32)
        rows = rows[_order(higher[rows])]
        rows = rows[_order(lower[rows] - number * width)]
        end = start + len(rows)
        sides[start:end], new[start:end] = rows, True
        ends = np.stack([lower[rows], higher[rows]])
        new[start + 1 : end] = (ends[:, 1:] != ends[:, :-1]).any(axis=0)
        start = end
    yield Progress("Surface", 1.0)
    return Edges(sides, np.flatnonzero(new))


def shared_edges(
    mesh: TriangleMesh, edges: Edges
) -> tuple[NDArray[np.int32], NDArray[np.int32]]:
    """Return at once what `shared_edges_in_steps` returns."""
    return run(shared_edges_in_steps(mesh, edges))


def shared_edges_in_steps(
    mesh: TriangleMesh, edges: Edges
) -> Steps[tuple[NDArray[np.int32], NDArray[np.int32]]]:
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
    n_sides = len(edges.sides)
    new = np.zeros(n_sides, dtype=bool)
    new[edges.first] = True
    found = []
    for start in range(0, n_sides, _MOST_SIDES):
        yield Progress("Surface", start / n_sides)
        sides = edges.sides[start : start + _MOST_SIDES + 1]
        owners = mesh.polygons[sides // 3].astype(np.int32)
        shared = owners[1:] != owners[:-1]
        shared &= ~new[start + 1 : start + len(sides)]
        pairs = np.stack([owners[:-1][shared], owners[1:][shared]], axis=1)
        found.append((pairs, sides[:-1][shared]))
    yield Progress("Surface", 1.0)
    neighbors, along = zip(*found, strict=True)
    return np.concatenate(neighbors), np.concatenate(along)


def lengths_of_sides(
    mesh: TriangleMesh, sides: NDArray[np.int32]
) -> NDArray[np.float64]:
    """Return the lengths (S,) of sides of triangles, numbered as in `Edges`.

    Parameters
    ----------
    mesh : TriangleMesh
    sides : (S,) int
    """
    corners = mesh.triangles.ravel()
    ends = mesh.vertices[corners[sides + np.where(sides % 3 < 2, 1, -2)]]
    return np.linalg.norm(mesh.vertices[corners[sides]] - ends, axis=1)


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
    keys = np.unique(pairs[:, 0].astype(np.int64) * n_nodes + pairs[:, 1])
    pairs = np.stack(np.divmod(keys, n_nodes), axis=1)
    if len(pairs) > _FEW_PAIRS:
        graph = graph_of(pairs, n_nodes)
        return connected_components(graph, directed=False)[1].astype(np.int64)
    found = np.arange(n_nodes)
    for one, other in pairs:
        low, high = sorted((found[one], found[other]))
        found[found == high] = low
    return np.unique(found, return_inverse=True)[1].reshape(-1)


def components_of_labels(
    graph: sparse.csr_array, arcs: NDArray[np.int64], labels: NDArray[np.int64]
) -> NDArray[np.int32]:
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
    found: NDArray[np.int32] = connected_components(within, directed=False)[1]
    return found


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
    starts = np.arange(n_rows + 1, dtype=np.int32)
    shape = n_rows, int(numbers.max(initial=0)) + 1  # SciPy finds none without rows
    rows = sparse.csr_array((ones, numbers, starts), shape)
    order: NDArray[np.int32] = rows.tocsc().indices
    return order
