"""Plain k-means of the samples' embedding, to hold the psi of our parts against."""

from dataclasses import replace
from unittest import mock

import checkout  # noqa: F401  # makes the package importable
import numpy as np
from weak_convex_decomposition.core.clusters import kmeans as clustering
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.part_memo import PartMemo
from weak_convex_decomposition.core.parts.partition import Partitioner

# Runs of k-means, of which the best counts.
STARTS = 20


def clusters(memo: PartMemo, n_clusters: int, parameters: Parameters) -> np.ndarray:
    """Return the cluster of each polygon, connected or not."""
    coordinates = memo.embedding(n_clusters, parameters)[:, :n_clusters]
    with mock.patch.object(clustering, "_STARTS", STARTS):
        labels = clustering.cluster(coordinates, n_clusters, parameters.seed)
    return memo.transfer.to_polygons(labels, n_clusters)


def connected_clusters(
    memo: PartMemo, n_parts: int, parameters: Parameters
) -> np.ndarray:
    """Return as many connected parts of clusters as ours are, and no specks."""
    afresh = PartMemo(memo.visibility)
    plain = Partitioner(afresh, replace(parameters, refinement="EMBEDDING"))
    with mock.patch.object(clustering, "_STARTS", STARTS):
        return plain.partition(n_parts)
