"""Plain k-means of the samples' embedding, to hold the psi of our parts against."""

import checkout  # noqa: F401  # makes the package importable
import numpy as np
from sklearn.cluster import KMeans
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.refinement import connected_parts, merge_to
from weak_convex_decomposition.core.visibility import Visibility

# Runs of k-means, of which the best counts.
STARTS = 20
# How many more clusters are tried when k of them make fewer than k parts.
MORE_CLUSTERS = (0, 1, 2, 4, 8)


def clusters(
    visibility: Visibility, n_clusters: int, parameters: Parameters
) -> np.ndarray:
    """Return the cluster of each polygon, connected or not."""
    coordinates = visibility.embedding[:, : parameters.eigenvectors or n_clusters]
    model = KMeans(n_clusters, n_init=STARTS, random_state=parameters.seed)
    labels = model.fit_predict(coordinates).astype(np.int64)
    return visibility.transfer.to_polygons(labels, n_clusters)


def connected_clusters(
    visibility: Visibility, n_parts: int, parameters: Parameters
) -> np.ndarray:
    """Return as many connected parts of clusters as ours are, and no specks."""
    surface = visibility.transfer.surface
    smallest_area = parameters.smallest_part * surface.areas.sum()
    for more in MORE_CLUSTERS:
        labels = clusters(visibility, n_parts + more, parameters)
        parts = connected_parts(surface, labels, smallest_area)
        n_pieces = int(parts.max()) + 1
        if n_pieces >= n_parts:
            break
    samples = visibility.transfer.to_samples(parts)
    merged = merge_to(
        n_parts,
        visibility.pairs.tally(samples, n_pieces),
        surface.borders(parts, n_pieces).toarray() > 0,
        parameters.alpha,
    )
    return merged[parts]
