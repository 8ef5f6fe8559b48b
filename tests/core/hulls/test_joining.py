"""Which pieces are joined if there are too many."""

import numpy as np
import shapes
from computed import build_hulls
from weak_convex_decomposition.core.hulls.piece import Piece
from weak_convex_decomposition.core.parameters.hulls import HullParameters


def test_joins_go_by_errors_that_estimates_miss(monkeypatch):
    monkeypatch.setattr(Piece, "error", 0.01)  # far too low for all
    dice = [shapes.box((x, 0, 0), (x + 0.1, 0.1, 0.1)) for x in (0, 2)]
    tiles = [shapes.box((x, 9, 0), (x + 2, 11, 0.4)) for x in (0, 2.6)]
    mesh = shapes.joined(*dice, *tiles)
    labels = np.repeat(np.arange(4), dice[0].n_polygons)
    found = build_hulls(mesh, HullParameters(pieces="PARTS", max_hulls=3), labels)
    # The hull of the dice would add less volume, but be far from both in the middle.
    assert found.n_hulls == 3
    assert found.errors.max() < 0.1
