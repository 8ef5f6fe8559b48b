"""Transfer of labels from samples to polygons, and back."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.spatial import cKDTree

from ..steps.progress import Progress, Steps
from .face_graph import FaceGraph
from .sampling import Samples

# Nearest samples that vote for the label of a polygon.
_NEAREST = 8
# Distance, in mean distances of samples, that normals one unit apart add.
_NORMAL_WEIGHT = 1.0
# Distance at which a sample's weight has halved, in mean distances of samples.
_SOFTENING = 0.3
# Polygons whose nearest samples are found in one step.
_BLOCK = 10_000
# Shells touch where samples of both are this near, in mean distances of samples.
_TOUCH = 1.5
# Labels that cover equal areas of a face, but for rounding.
_EQUAL = 1e-3
# A label that got less of the area it covers lost its place to others.
_LOST = 0.1


def carry(
    samples: Samples, polygon_of: NDArray[np.int64], graph: FaceGraph
) -> Steps[Transfer]:
    """Find the samples nearest to each polygon, and with them make a `Transfer`.

    Parameters
    ----------
    samples : Samples
    polygon_of : (N,) int
        Polygon that each sample lies on.
    graph : FaceGraph
        Graph of these polygons, or of the points of a cloud.

    Returns
    -------
    Steps of Transfer
    """
    spacing = _spacing(samples, graph)
    weight = _NORMAL_WEIGHT * spacing
    tree = cKDTree(np.hstack([samples.positions, weight * samples.normals]))
    places = np.hstack([graph.centers, weight * graph.normals])
    order = np.argsort(polygon_of, kind="stable")
    ends = np.searchsorted(polygon_of[order], np.arange(0, len(places), _BLOCK))
    found = []
    for start, own in zip(
        range(0, len(places), _BLOCK), np.split(order, ends[1:]), strict=True
    ):
        yield Progress("Surface", start / len(places))
        block = places[start : start + _BLOCK]
        distances, nearest = tree.query(block, min(_NEAREST, len(samples)))
        away, rows = distances / spacing, polygon_of[own] - start
        found.append((nearest, _shares(away, nearest, own, rows, len(samples))))
    yield Progress("Surface", 1.0)
    nearest = np.concatenate([rows for rows, _ in found])
    shares = sparse.vstack([share for _, share in found], "csr")
    return Transfer(samples, polygon_of, graph, nearest, shares)


def labels_by_area(
    labels: NDArray[np.int64], origins: NDArray[np.int64], areas: NDArray[np.float64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Return the label that covers most of each face, from labels of its fragments.

    Of labels that cover equal areas, the lowest counts. A label that so gets little of
    what it covers leaves it to others: it would stay as a few stray faces.

    Parameters
    ----------
    labels : (E,) int
        Labels of the fragments, from 0.
    origins : (E,) int
        The face that each fragment comes from.
    areas : (E,) float
        Of the fragments.

    Returns
    -------
    faces : (F,) int
        The faces with fragments, sorted.
    found : (F,) int
        Their labels.
    counts : (F,) int
        How many labels share each.
    """
    stride = int(labels.max()) + 1
    cells, places = np.unique(origins * stride + labels, return_inverse=True)
    rows, candidates = np.divmod(cells, stride)
    covered = np.bincount(places, areas).astype(np.float64)
    faces, starts, counts = np.unique(rows, return_index=True, return_counts=True)

    def largest(values: NDArray[np.float64]) -> NDArray[np.int64]:
        """Return the first cell of the largest value of each face."""
        most = np.repeat(np.maximum.reduceat(values, starts), counts)
        best = np.flatnonzero(values >= (1 - _EQUAL) * most)
        return best[np.unique(rows[best], return_index=True)[1]]

    best = largest(covered)
    got = np.bincount(candidates[best], covered[best], stride)
    lost = got < _LOST * np.bincount(candidates, covered, stride)
    best = largest(np.where(lost[candidates], 0.0, covered))
    return faces, candidates[best], counts


def _spacing(samples: Samples, graph: FaceGraph) -> float:
    """Return the mean distance of samples."""
    return float(np.sqrt(graph.areas.sum() / len(samples)))


def _shares(
    distances: NDArray[np.float64],
    nearest: NDArray[np.int64],
    own: NDArray[np.int64],
    polygon_of: NDArray[np.int64],
    n_samples: int,
) -> sparse.csr_array:
    """Return weights of samples (P, N): by distance, plus 1 on a polygon's own ones.

    `distances` and `nearest` are (P, n), in mean distances of samples. `own` (S,) are
    the samples on these polygons, and `polygon_of` (S,) where they lie.
    """
    n_polygons, n_nearest = nearest.shape
    says = (1.0 / (1.0 + distances / _SOFTENING)).ravel()
    rows = np.repeat(np.arange(n_polygons), n_nearest)
    shares = sparse.csr_array(
        (
            np.concatenate([says, np.ones(len(own))]),
            (
                np.concatenate([rows, polygon_of]),
                np.concatenate([nearest.ravel(), own]),
            ),
        ),
        shape=(n_polygons, n_samples),
    )
    totals = np.asarray(shares.sum(axis=1)).ravel()
    return sparse.csr_array(sparse.diags_array(1.0 / totals) @ shares)


class Transfer:
    """Carries values of samples to polygons, and labels of polygons to samples.

    Parameters
    ----------
    samples : Samples
    polygon_of : (N,) int
        Polygon that each sample lies on.
    graph : FaceGraph
        Graph of these polygons, or of the points of a cloud.
    nearest : (P, n) int
        The samples nearest to each polygon.
    shares : (P, N) sparse float
        Weight of each sample in the vote of each polygon; rows sum to 1.

    Attributes
    ----------
    shares : (P, N) sparse float
    polygon_of : (N,) int
        Polygon that each sample lies on.
    graph : FaceGraph
        The graph, with links between shells that touch.
    n_unsampled, n_shells : int
        Number of shells without a sample, and of all shells.
    """

    def __init__(
        self,
        samples: Samples,
        polygon_of: NDArray[np.int64],
        graph: FaceGraph,
        nearest: NDArray[np.int64],
        shares: sparse.csr_array,
    ) -> None:
        self.polygon_of, self.shares = polygon_of, shares
        shells = graph.shells()
        numbers, first = np.unique(shells, return_index=True)
        unsampled = np.setdiff1d(numbers, shells[polygon_of])
        self.n_unsampled, self.n_shells = len(unsampled), len(numbers)
        # A shell without a sample is linked to the polygon of the nearest sample.
        small = first[unsampled]
        hung = np.stack([small, polygon_of[nearest[small, 0]]], axis=1)
        touching = self._touching(samples, shells, _spacing(samples, graph))
        links = np.concatenate([touching, hung])
        self.graph = replace(graph, links=links)

    def _touching(
        self, samples: Samples, shells: NDArray[np.int64], spacing: float
    ) -> NDArray[np.int64]:
        """Return links (L, 2) between shells: pairs of polygons with near samples."""
        pairs = cKDTree(samples.positions).query_pairs(
            _TOUCH * spacing, output_type="ndarray"
        )
        links = self.polygon_of[pairs]
        return links[shells[links[:, 0]] != shells[links[:, 1]]]

    def to_polygons(
        self, labels: NDArray[np.int64], n_labels: int
    ) -> NDArray[np.int64]:
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

    def to_samples(self, labels: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the label of the polygon that each sample lies on.

        Parameters
        ----------
        labels : (P,) int

        Returns
        -------
        (N,) int
        """
        return labels[self.polygon_of]
