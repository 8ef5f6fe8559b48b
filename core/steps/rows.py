"""Works through the rows of large arrays, a step's worth at a time."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .progress import Progress, Steps

# Rows that are computed with in one step: few enough for the processor's cache.
_BLOCK = 2**16


def blocks(n_rows: int) -> Iterator[slice]:
    """Yield slices that together cover some rows, each a step's worth of work.

    Parameters
    ----------
    n_rows : int
    """
    for start in range(0, n_rows, _BLOCK):
        yield slice(start, min(start + _BLOCK, n_rows))


def used_rows(numbers: NDArray[np.int64], n_rows: int) -> Steps[NDArray[np.bool_]]:
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
