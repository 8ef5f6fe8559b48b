"""Which pieces are joined if there are too many."""

from itertools import islice

import numpy as np
import shapes
from computed import build_hulls, solid_of
from weak_convex_decomposition.core.cache import ShapeCache, no_rays
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.hulls.cutting.cell import cut, whole
from weak_convex_decomposition.core.hulls.fitting import Fit
from weak_convex_decomposition.core.hulls.joining import part_again, without_films
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


def test_joints_that_cost_the_same_but_for_rounding_come_to_an_end():
    """Faces of a cube that are a part each: flat hulls, whose joints cost nothing."""
    mesh = shapes.box(divisions=2)
    labels, cache = np.arange(mesh.n_polygons), ShapeCache(no_rays)
    parameters = HullParameters(pieces="PARTS", max_hulls=6)
    steps = build_hulls_in_steps(mesh, parameters, cache, labels)
    assert sum(1 for _ in islice(steps, 5000)) < 5000


class Known:
    """What is asked of a piece whose error is known."""

    def __init__(self, error):
        self.known_error, self.is_close = error, error <= 0.05


def test_joints_come_apart_again_where_there_is_room_and_something_to_gain():
    a, b, c, d, e = (Known(error) for error in (0.01, 0.02, 0.06, 0.01, 0.09))
    worse, worst, vain, close = (Known(error) for error in (0.07, 0.2, 0.08, 0.04))
    known = {(a, b): worse, (worse, c): worst, (d, e): vain, (a, d): close}
    pieces = [worst, vain, close]
    assert part_again(pieces, 3, known) == pieces
    assert part_again(pieces, 4, known) == [vain, close, worse, c]
    assert part_again(pieces, 9, known) == [vain, close, c, a, b]


def test_films_are_left_out_if_others_cover_them():
    solid = solid_of(shapes.box((-1, -1, -1), (1, 1, 1)))
    cell = whole(solid, Fit(HullParameters(), 1.0, 0.05))
    below, film = cut(cell, np.array([0, 0, 1, -1 + 1e-7]))
    part, rest = cut(below, np.array([1, 0, 0, -0.2]))
    assert without_films([part, film, rest]) == [part, rest]
    for pieces in ([film], [part, film], [part, rest]):
        assert without_films(pieces) == pieces
