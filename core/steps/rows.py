"""Rows of large arrays: worked through a step's worth at a time, found by number."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .arrays import BoolArray, IntArray
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


def used_rows(numbers: NDArray[np.integer], n_rows: int) -> Steps[BoolArray]:
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


def ranges(counts: IntArray) -> tuple[IntArray, IntArray]:
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


class RowsByNumber:
    """Finds the rows that have each number, by sorting all of them once.

    Parameters
    ----------
    numbers : (N,) int
        The number of each row; rows below 0 have none.
    n_numbers : int
    """

    def __init__(self, numbers: IntArray, n_numbers: int) -> None:
        self._order = np.argsort(numbers, kind="stable")
        self._begins = np.searchsorted(numbers[self._order], np.arange(n_numbers + 1))

    def of(self, number: int) -> IntArray:
        """Return the rows with a number, ascending.

        Parameters
        ----------
        number : int
            In 0…`n_numbers` − 1.
        """
        return self._order[self._begins[number] : self._begins[number + 1]]
