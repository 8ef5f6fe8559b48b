"""Computations that several tests look at are done once."""

from functools import cache

import numpy as np
import pytest
from computed import decompose, see
from scipy.optimize import linear_sum_assignment
from weak_convex_decomposition.core.parameters.parts import Parameters

N_SAMPLES = 150


@pytest.fixture(scope="session")
def seen():
    """Return a function from a maker of a mesh to the memo of its visibility."""

    @cache
    def visibility(make, **values):
        values = {"samples": N_SAMPLES, **values}
        return see(make(), Parameters(**values))

    return visibility


@pytest.fixture(scope="session")
def decomposed():
    """Return a function from a maker of a mesh to its decomposition."""

    @cache
    def decomposition(make, **values):
        values = {"samples": N_SAMPLES, "max_parts": 6, **values}
        return decompose(make(), Parameters(**values))

    return decomposition


@pytest.fixture(scope="session")
def agreement():
    """Return a function from two partitions to the share of the area they agree on."""

    def share(labels, others, areas):
        overlaps = np.zeros((labels.max() + 1, others.max() + 1))
        np.add.at(overlaps, (labels, others), areas)
        rows, columns = linear_sum_assignment(-overlaps)
        return overlaps[rows, columns].sum() / areas.sum()

    return share
