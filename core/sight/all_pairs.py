"""Lines of sight of all pairs of samples, or of random ones (sections 3 and 5)."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ..steps.arrays import BoolArray
from ..steps.progress import Steps, within
from .lines import RayBudget, cast_lines, faces_inside, see_pairs
from .pair_visibility import PairVisibility, pair_counts
from .viewpoints import Viewpoints

# Pairs of the LoS matrix that are tested at a time.
_PAIRS_PER_STEP = 65536


def see_all_pairs(views: Viewpoints) -> Steps[PairVisibility]:
    """Compute the LoS matrix of all pairs of samples (eq. 3).

    Parameters
    ----------
    views : Viewpoints
        Those of N samples.

    Returns
    -------
    Steps of PairVisibility
        A dense matrix (N, N). Every sample sees itself.
    """
    n_samples, budget = len(views.samples), RayBudget()
    los = np.eye(n_samples, dtype=bool)
    start = 0
    while start < n_samples - 1:
        # Take a few rows of the upper triangle at a time, to bound the memory.
        stop = start + max(1, _PAIRS_PER_STEP // (n_samples - start))
        stop = min(stop, n_samples - 1)
        rows, columns = np.arange(start, stop), np.arange(start, n_samples)
        facing = faces_inside(views, rows[:, None], columns[None])
        first, second = start + np.stack(np.nonzero(np.triu(facing, 1)))
        done, share = (
            1 - ((n_samples - row) / n_samples) ** 2 for row in (start, stop)
        )
        steps = cast_lines(views, first, second, budget)
        visible = yield from within(steps, done, share)
        los[first[visible], second[visible]] = True
        start = stop
    return PairVisibility((los | los.T).astype(np.float32), None, budget.n_lines)


def see_uniform_pairs(
    views: Viewpoints,
    rng: np.random.Generator,
    n_pairs: int,
    budget: RayBudget | None = None,
) -> Steps[PairVisibility]:
    """Find out whether random pairs of samples see each other.

    Parameters
    ----------
    views : Viewpoints
        Those of N samples.
    rng : numpy.random.Generator
        Draws the pairs uniformly, with replacement.
    n_pairs : int
        Number of pairs.
    budget : RayBudget, optional
        Where it ends, the rest of the pairs stay unknown. Unlimited by default.

    Returns
    -------
    Steps of PairVisibility
        Sparse matrices (N, N) with the number of draws of each pair.
    """
    n_samples, budget = len(views.samples), budget or RayBudget()
    first, second = rng.integers(n_samples, size=(2, n_pairs))
    visible = yield from see_pairs(views, first, second, budget)
    first, second = first[: len(visible)], second[: len(visible)]

    def counted(chosen: BoolArray) -> sparse.csr_array:
        return pair_counts(first[chosen], second[chosen], n_samples)

    known = counted(np.ones_like(visible))
    return PairVisibility(counted(visible), known, budget.n_lines)
