"""Works through the rows of large arrays, a step's worth at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .progress import Progress, Steps

# Rows that are computed with in one step: few enough for the processor's cache.
_BLOCK = 2**16


def blocks(n_rows: int, size: int = _BLOCK) -> Iterator[slice]:
    """Yield slices that together cover some rows, each a step's worth of work.

    Parameters
    ----------
    n_rows : int
    size : int, optional
        Rows in each slice; 0 counts as 1.
    """
    size = max(size, 1)
    for start in range(0, n_rows, size):
        yield slice(start, min(start + size, n_rows))


def used_rows(numbers: NDArray[np.integer], n_rows: int) -> Steps[NDArray[np.bool_]]:
    """Return which of the rows 0…N − 1 an array names.

    Parameters
    ----------
    numbers : (M,) or (M, K) int
    n_rows : int

    Returns
    -------
    Steps of (N,) bool
    """
    used = np.zeros(n_rows, dtype=bool)
    for rows in blocks(len(numbers)):
        yield Progress("Surface", rows.start / len(numbers))
        used[numbers[rows].ravel()] = True
    return used


def ranges(
    counts: NDArray[np.int64],
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return ranges of numbers from 0 on, one behind the other.

    Parameters
    ----------
    counts : (N,) int
        Length of each range.

    Returns
    -------
    owners : (M,) int
        Range of each number, in 0…N − 1.
    ranks : (M,) int
        The numbers.

    Examples
    --------
    >>> import numpy as np
    >>> from weak_convex_decomposition.core.steps.rows import ranges
    >>> owners, ranks = ranges(np.array([2, 0, 3]))
    >>> owners.tolist(), ranks.tolist()
    ([0, 0, 2, 2, 2], [0, 1, 0, 1, 2])
    """
    owners = np.repeat(np.arange(len(counts)), counts)
    return owners, np.arange(len(owners)) - (np.cumsum(counts) - counts)[owners]
