"""Transfer of labels from samples to polygons, and back."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..steps.arrays import FloatArray, Int32Array, IntArray
from ..steps.progress import Progress, Steps, within
from ..steps.rows import RowsByNumber, blocks
from .frames import with_normals
from .graphs.face_graph import FaceGraph
from .sampling import Samples

# Nearest samples that vote for the label of a polygon.
_NEAREST = 8
# Distance, in mean distances of samples, that normals one unit apart add.
_NORMAL_WEIGHT = 1.0
# Distance at which a sample's weight has halved, in mean distances of samples.
_SOFTENING = 0.3
# Polygons whose nearest samples are found in one step.
_BLOCK = 10_000
# Polygons whose nearest samples are kept at most, but for those of one call: 25 MB.
_MOST_KEPT = 2**18
# Shells touch where samples of both are this near, in mean distances of samples.
_TOUCH = 1.5


class NearestSamples:
    """Finds the samples nearest to polygons, and keeps them for the next time.

    Parameters
    ----------
    samples : Samples
    spacing : float
        Mean distance of samples, by `spacing_of`.
    """

    def __init__(self, samples: Samples, spacing: float) -> None:
        self._spacing, self._n_nearest = spacing, min(_NEAREST, len(samples))
        self._weight = _NORMAL_WEIGHT * spacing
        at = with_normals(samples.positions, samples.normals, self._weight)
        self._tree = cKDTree(at)
        self._forget()

    def _forget(self) -> None:
        self._rows = np.empty(0, dtype=np.int32)
        self._away = np.empty((0, self._n_nearest))
        self._nearest = np.empty((0, self._n_nearest), dtype=np.int32)

    def of(
        self, graph: FaceGraph, numbers: IntArray
    ) -> Steps[tuple[FloatArray, Int32Array]]:
        """Return how far the n nearest samples of polygons are away, and which.

        Parameters
        ----------
        graph : FaceGraph
            Of P polygons.
        numbers : (P,) int
            Under which they are kept.

        Returns
        -------
        Steps of (P, n) float in mean distances of samples, and (P, n) int32
        """
        if len(self._away) > _MOST_KEPT:
            self._forget()
        n_missing = max(int(numbers.max()) + 1 - len(self._rows), 0)
        self._rows = np.pad(self._rows, (0, n_missing), constant_values=-1)
        new = np.flatnonzero(self._rows[numbers] < 0)
        away, nearest = [self._away], [self._nearest]
        for rows in blocks(len(new), _BLOCK):
            yield Progress("Surface", rows.start / len(new))
            block = new[rows]
            at = with_normals(graph.centers[block], graph.normals[block], self._weight)
            distances, found = self._tree.query(at, range(1, self._n_nearest + 1))
            away.append(distances / self._spacing)
            nearest.append(found.astype(np.int32))
        yield Progress("Surface", 1.0)
        self._rows[numbers[new]] = len(self._away) + np.arange(len(new))
        self._away, self._nearest = np.concatenate(away), np.concatenate(nearest)
        yield Progress("Surface", 1.0)
        kept = self._rows[numbers]
        return self._away[kept], self._nearest[kept]


def carry(
    samples: Samples,
    polygon_of: IntArray,
    graph: FaceGraph,
    known: NearestSamples | None = None,
    numbers: IntArray | None = None,
) -> Steps[Transfer]:
    """Find the samples nearest to each polygon, and with them make a `Transfer`.

    Parameters
    ----------
    samples : Samples
    polygon_of : (N,) int
        Polygon that each sample lies on.
    graph : FaceGraph
        Graph of these polygons, or of the points of a cloud.
    known : NearestSamples, optional
        What was found before.
    numbers : (P,) int, optional
        The number of each polygon in `known`.

    Returns
    -------
    Steps of Transfer
    """
    n_polygons = graph.n_polygons
    known = known or NearestSamples(samples, spacing_of(samples, graph))
    steps = known.of(graph, np.arange(n_polygons) if numbers is None else numbers)
    away, nearest = yield from within(steps, 0.0, 0.8)
    samples_of = RowsByNumber(polygon_of // _BLOCK, -(-n_polygons // _BLOCK))
    shares = []
    for number, block in enumerate(blocks(n_polygons, _BLOCK)):
        yield Progress("Surface", 0.8 + 0.2 * block.start / n_polygons)
        own = samples_of.of(number)
        rows = polygon_of[own] - block.start
        shares.append(_shares(away[block], nearest[block], own, rows, len(samples)))
    yield Progress("Surface", 1.0)
    all_shares = sparse.vstack(shares, "csr")
    yield Progress("Surface", 1.0)
    return _linked(samples, polygon_of, graph, nearest, all_shares)


def spacing_of(samples: Samples, graph: FaceGraph) -> float:
    """Return the mean distance of as many samples spread over the whole area."""
    return float(np.sqrt(graph.areas.sum() / len(samples)))


def _shares(
    distances: FloatArray,
    nearest: Int32Array,
    own: IntArray,
    polygon_of: IntArray,
    n_samples: int,
) -> sparse.csr_array:
    """Return weights of samples (P, N): by distance, plus 1 on a polygon's own ones.

    `distances` and `nearest` are (P, n), in mean distances of samples. `own` (S,) are
    the samples on these polygons, and `polygon_of` (S,) where they lie.
    """
    n_polygons, n_nearest = nearest.shape
    says = (1.0 / (1.0 + distances / _SOFTENING)).ravel()
    rows = np.repeat(np.arange(n_polygons), n_nearest)
    values = np.concatenate([says, np.ones(len(own))])
    places = np.concatenate([[rows, nearest.ravel()], [polygon_of, own]], axis=1)
    shares = sparse.csr_array((values, tuple(places)), shape=(n_polygons, n_samples))
    totals = np.asarray(shares.sum(axis=1)).ravel()
    return sparse.csr_array(sparse.diags_array(1.0 / totals) @ shares)


def _linked(
    samples: Samples,
    polygon_of: IntArray,
    graph: FaceGraph,
    nearest: Int32Array,
    shares: sparse.csr_array,
) -> Transfer:
    """Return the transfer to a graph, after its shells are linked.

    `nearest` (P, n) are the samples nearest to each polygon.
    """
    shells = graph.shells()
    numbers, first = np.unique(shells, return_index=True)
    unsampled = np.setdiff1d(numbers, shells[polygon_of])
    # A shell without a sample is linked to the polygon of the nearest sample.
    small = first[unsampled]
    hung = np.stack([small, polygon_of[nearest[small, 0]]], axis=1)
    # Others are linked where samples of two are near.
    pairs = cKDTree(samples.positions).query_pairs(
        _TOUCH * spacing_of(samples, graph), output_type="ndarray"
    )
    touching = polygon_of[pairs]
    touching = touching[shells[touching[:, 0]] != shells[touching[:, 1]]]
    graph = replace(graph, links=np.concatenate([touching, hung]))
    return Transfer(polygon_of, shares, graph, len(unsampled), len(numbers))


@dataclass(frozen=True, eq=False)
class Transfer:
    """Carries values of samples to polygons, and labels of polygons to samples.

    Attributes
    ----------
    polygon_of : (N,) int
        Polygon that each sample lies on.
    shares : (P, N) sparse float
        Weight of each sample in the vote of each polygon; rows sum to 1.
    graph : FaceGraph
        Graph of these polygons, with links between shells that touch.
    n_unsampled, n_shells : int
        Number of shells without a sample, and of all shells.
    """

    polygon_of: IntArray
    shares: sparse.csr_array
    graph: FaceGraph
    n_unsampled: int
    n_shells: int

    def to_polygons(self, labels: IntArray, n_labels: int) -> IntArray:
        """Return the label with the largest weight of samples on each polygon.

        Parameters
        ----------
        labels : (N,) int
            Labels 0…K − 1 of the samples.
        n_labels : int
            Number of labels K.

        Returns
        -------
        (P,) int
        """
        votes = self.shares @ np.eye(n_labels)[labels]
        return np.asarray(votes).argmax(axis=1)

    def to_samples(self, labels: IntArray) -> IntArray:
        """Return the label of the polygon that each sample lies on.

        Parameters
        ----------
        labels : (P,) int

        Returns
        -------
        (N,) int
        """
        return labels[self.polygon_of]
