"""Computations that several tests look at are done once."""

from functools import cache

import pytest
from computed import decompose, see
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
