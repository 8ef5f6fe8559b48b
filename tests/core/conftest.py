"""Computations that several tests look at are done once."""

from functools import cache

import pytest
from brute_caster import BruteCaster
from weak_convex_decomposition.core.decomposition import decompose
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.progress import run
from weak_convex_decomposition.core.visibility import see

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
        values = {"samples": N_SAMPLES, "max_parts": 7, **values}
        return run(decompose(make(), Parameters(**values), BruteCaster))

    return decomposition
