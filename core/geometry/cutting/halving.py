"""Cuts triangles in two at the middle of their longest edges."""

from __future__ import annotations

import numpy as np

from ...steps.arrays import FloatArray


def edge_lengths(corners: FloatArray) -> FloatArray:
    """Return the lengths of the edges of triangles: from corner i to i + 1, (T, 3).

    Parameters
    ----------
    corners : (T, 3, 3) float
    """
    edges = corners[:, [1, 2, 0]] - corners
    return np.sqrt(np.einsum("ted,ted->te", edges, edges))


def halved(corners: FloatArray, lengths: FloatArray) -> FloatArray:
    """Return triangles cut in two at the middle of their longest edges, (2 T, 3, 3).

    Parameters
    ----------
    corners : (T, 3, 3) float
    lengths : (T, 3) float
        Of their edges, as `edge_lengths` returns them.

    Returns
    -------
    (2 T, 3, 3) float
        One half of each triangle, then the other halves.
    """
    n = len(corners)
    first = lengths.argmax(axis=1)
    # Each triangle from the start of its longest edge on.
    turn = (first[:, None] + np.arange(3)) % 3
    turned = corners[np.arange(n)[:, None], turn]
    middle = (turned[:, 0] + turned[:, 1]) / 2
    halves = np.concatenate([turned, turned])
    halves[:n, 1] = halves[n:, 0] = middle
    return halves
