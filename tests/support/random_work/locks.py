"""What must hold for locked parts: a run leaves their faces alone."""

from contextlib import contextmanager

import numpy as np
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of


@contextmanager
def locks_hold(obj):
    """Check that what is done meanwhile leaves the faces of locked parts alone."""
    before = _locked(obj)
    yield
    after = _locked(obj)
    assert after.keys() >= before.keys()
    for number, figures in before.items():
        assert np.allclose(after[number], figures, atol=1e-4), number


def _locked(obj):
    """Return faces, area and center of the locked parts that have faces, by number.

    Where the record is not in step with the faces, as after a join, numbers change.
    """
    figures = figures_of(obj)
    if figures is None or not figures.in_step:
        return {}
    locked = {row.number for row in obj.wcd_parts if row.locked}
    return {
        each.number: row
        for each, row in zip(figures.identities, figures.measured_on, strict=True)
        if each.number in locked
    }
