"""Groups of samples that are close and face the same way."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..geometry.frames import with_normals
from ..geometry.sampling import Samples

# Distance that normals one unit apart add, in diagonals.
_WEIGHT_OF_NORMALS = 0.12
# Rounds of Lloyd's algorithm. More change little.
_ROUNDS = 8


def group_samples(
    samples: Samples, diagonal: float, n_groups: int, n_nearest: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Group samples by position and normal.

    The samples are halved along their longest side, again and again. Then they move to
    the nearest center of a group a few times, as in k-means (Lloyd 1982). No random
    number is needed.

    Parameters
    ----------
    samples : Samples
        N points.
    diagonal : float
        Diagonal of the bounding box of their shape.
    n_groups : int
        Number of groups. Some fewer come out if groups become empty.
    n_nearest : int
        Number of nearest groups that are asked for.

    Returns
    -------
    groups : (N,) int
        Group of each sample, from 0 to G − 1. No group is empty.
    nearest : (G, n) int
        Each group itself, and the groups nearest to it.
    """
    positions = samples.positions / diagonal
    # Rounded, or NumPy's version would decide between sides of equal length.
    places = with_normals(positions, samples.normals, _WEIGHT_OF_NORMALS).round(6)
    groups = _halved(places, min(n_groups, len(places)))
    for _ in range(_ROUNDS):
        groups = cKDTree(_centers(places, groups)).query(places)[1]
        groups = np.unique(groups, return_inverse=True)[1].reshape(-1)
    centers = _centers(places, groups)
    wanted = np.arange(1, 2 + min(n_nearest, len(centers) - 1))
    return groups.astype(np.int64), cKDTree(centers).query(centers, wanted)[1]


def _halved(places: NDArray[np.float64], n_groups: int) -> NDArray[np.int64]:
    """Return groups of nearly equal size: boxes in the space of `places`."""
    groups = np.zeros(len(places), dtype=np.int64)
    waiting, n_done = [(np.arange(len(places)), n_groups)], 0
    while waiting:
        rows, n_wanted = waiting.pop()
        if n_wanted == 1:
            groups[rows] = n_done
            n_done += 1
            continue
        axis = np.ptp(places[rows], axis=0).argmax()
        rows = rows[np.argsort(places[rows, axis], kind="stable")]
        n_half = n_wanted // 2
        middle = len(rows) * n_half // n_wanted
        waiting += [(rows[:middle], n_half), (rows[middle:], n_wanted - n_half)]
    return groups


def _centers(
    places: NDArray[np.float64], groups: NDArray[np.int64]
) -> NDArray[np.float64]:
    """Return the mean place of each of G groups, (G, D)."""
    sums = np.stack([np.bincount(groups, column) for column in places.T], axis=1)
    return sums / np.bincount(groups)[:, None]
