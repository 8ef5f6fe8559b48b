"""Labels of rows: what the rows of each label add up to."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from ..steps.arrays import IntArray


def sums_by_label(
    matrix: NDArray[np.floating[Any]] | sparse.csr_array,
    labels: IntArray,
    n_labels: int,
) -> NDArray[Any]:
    """Return the sum of the rows of each of K labels. Every row is read only once.

    Parameters
    ----------
    matrix : (N, C) float or sparse
    labels : (N,) int in 0…K − 1
    n_labels : int

    Returns
    -------
    sums : (K, C) float
    """
    rows = np.arange(len(labels) + 1)
    ones = np.ones(len(labels), dtype=np.float32)
    members = sparse.csr_array((ones, labels, rows), shape=(len(labels), n_labels))
    sums = members.T @ matrix
    return sums.toarray() if sparse.issparse(sums) else sums
