"""Seams of parts cut anew, as smooth as psi allows, and alike on both sides."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..clusters.moves import MoveGains
from ..steps.progress import Steps, within
from .graph_cut import cut_seams, distances_to_parts
from .partition import Partitioner, count, digest

# Seams that would cost too much are cut again with these shares of lambda.
_SOFTER = (1.0, 0.5, 0.25, 0.125, 0.0625)


def seamed(
    partitioner: Partitioner, parts: NDArray[np.int64]
) -> Steps[NDArray[np.int64]]:
    """Return the same number of parts with their seams cut anew (eq. 4), (P,) int."""
    key = partitioner.parameters.smoothness, digest(parts)
    return partitioner.of_seams.recall_steps(key, lambda: _cut(partitioner, parts))


def _cut(
    partitioner: Partitioner, parts: NDArray[np.int64]
) -> Steps[NDArray[np.int64]]:
    """Cut the seams of parts anew; parts that short seams would swallow keep theirs.

    Smooth seams cost psi: no more of it than its moves have won over k-means.
    """
    n_parts, smoothness = count(parts), partitioner.parameters.smoothness
    if n_parts == 1 or smoothness == 0:
        return parts
    enough = -np.inf
    if partitioner.by_psi:
        plain = partitioner.plain(n_parts)
        enough = min(partitioner.psi(plain), partitioner.psi(parts))
    labels = partitioner.transfer.to_samples(parts)
    costs = partitioner.transfer.shares @ _dislikes(partitioner, labels, n_parts)
    for share in _SOFTER:
        steps = cut_seams(partitioner.surface, parts, costs, share * smoothness)
        cut = yield from within(steps, 0.0, 0.9)
        areas = np.bincount(cut, partitioner.surface.areas, n_parts)
        swallowed = areas <= partitioner.smallest_area
        cut = partitioner.tidied(np.where(swallowed[parts], parts, cut), n_parts)
        if count(cut) == n_parts and partitioner.psi(cut) >= enough:
            return (yield from within(_evened(partitioner, cut, enough), 0.9, 1.0))
    return parts


def _evened(
    partitioner: Partitioner, parts: NDArray[np.int64], enough: float
) -> Steps[NDArray[np.int64]]:
    """Return parts with seams alike on both sides, where psi stays enough."""
    if not partitioner.by_psi:
        return parts
    even = yield from partitioner.symmetric(parts, {count(parts)})
    best = max(even, key=lambda each: each.psi, default=None)
    least = max(enough, partitioner.psi(parts) - 2 * partitioner.negligible)
    return parts if best is None or best.psi < least else best.parts


def _dislikes(
    partitioner: Partitioner, labels: NDArray[np.int64], n_labels: int
) -> NDArray[np.float64]:
    """Return the data term of eq. 4, how little samples like labels, (N, K)."""
    if not partitioner.by_psi:
        return distances_to_parts(partitioner.embedding(n_labels), labels, n_labels)
    pulls = MoveGains(partitioner.visibility.pairs, labels, n_labels).of(
        slice(None), partitioner.parameters.alpha
    )
    return pulls.max(axis=1, keepdims=True) - pulls
