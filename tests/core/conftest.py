"""Computations that several tests look at are done once."""

from functools import cache

import numpy as np
import pytest
from brute_caster import BruteCaster
from scipy.optimize import linear_sum_assignment
from weak_convex_decomposition.core.decomposition import decompose
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.visibility import see
from weak_convex_decomposition.core.steps.progress import run

N_SAMPLES = 150


@pytest.fixture(scope="session")
def seen():
    """Return a function from a maker of a mesh to its visibility."""

    @cache
    def visibility(make, **values):
        values = {"samples": N_SAMPLES, **values}
        return run(see(make(), Parameters(**values), BruteCaster))

    return visibility


@pytest.fixture(scope="session")
def decomposed():
    """Return a function from a maker of a mesh to its decomposition."""

    @cache
    def decomposition(make, **values):
        values = {"samples": N_SAMPLES, "max_parts": 6, **values}
        return run(decompose(make(), Parameters(**values), BruteCaster))

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
