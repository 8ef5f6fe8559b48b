"""Which cuts of a solid are made, and which are undone."""

from dataclasses import replace

import changes
import numpy as np
import pytest
import shapes
from computed import build_hulls, solid_of
from weak_convex_decomposition.core.hulls.cutting import close_pieces
from weak_convex_decomposition.core.hulls.cutting.cell import whole
from weak_convex_decomposition.core.hulls.fitting import fit_for
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run


@pytest.mark.parametrize(
    ("kind", "n_shapes", "error"),
    [("BOX", 1, 0.0), ("SPHERE", 8, np.sqrt(3) / 2 - 0.5), ("CYLINDER", 4, 0.2072)],
)
def test_a_cube_is_cut_where_that_lowers_the_error(kind, n_shapes, error):
    # Spheres around halves stray farther than one around all, those of eighths less.
    values = {"shape": kind, "max_hulls": 12, "max_error": 0.02}
    found = build_hulls(shapes.box(), HullParameters(**values))
    assert found.n_hulls == n_shapes
    assert found.errors.max() == pytest.approx(error, rel=0.05, abs=1e-6)
    assert bool(found.notes) == (kind != "BOX")


@pytest.mark.parametrize("rotation", [np.eye(3), changes.any_rotation(1)])
@pytest.mark.parametrize(
    ("outline", "n_hulls", "largest"),
    [
        ([(-1, -1), (1, -1), (1, 1), (-1, 1)], 1, 0.001),
        ([(-1, -1), (1, -1), (1, 0), (0, 0), (0, 1), (-1, 1)], 2, 0.01),
        (
            [(-5, 0), (-5, -5), (5, -5), (5, 0), (1, 0), (1, 9), (-1, 9), (-1, 0)],
            2,
            0.05,
        ),
    ],
    ids=["square", "L", "T"],
)
def test_flat_shapes_are_cut_by_their_outlines_alone(
    outline, n_hulls, largest, rotation
):
    # Their hulls have a thickness, and more of them would not make up for it.
    flat = shapes.mesh_of([(*p, 0) for p in outline], [tuple(range(len(outline)))])
    mesh = changes.moved(flat, rotation=rotation)
    found = build_hulls(mesh, HullParameters(max_error=largest))
    assert found.n_hulls == n_hulls
    assert largest == 0.05 or "hulls around flat faces" in found.notes[-1]


def test_pieces_are_cut_again_while_joining_leaves_room(monkeypatch):
    rounds, cut_until_close = [], close_pieces._cut_until_close

    def hasty(cells, most):
        rounds.append(cells)
        return cut_until_close(cells, most if len(rounds) > 1 else 2)

    monkeypatch.setattr(close_pieces, "_cut_until_close", hasty)
    found = build_hulls(shapes.comb(), HullParameters(max_hulls=8))
    assert len(rounds) > 1
    assert 2 < found.n_hulls <= 8
    assert found.errors.max() <= 0.05


def test_pieces_are_not_cut_again_without_end(monkeypatch):
    rounds = []

    def as_far_as_before(cells, *_, **__):
        yield from ()
        rounds.append(cells)
        return [replace(one) for one in cells]

    monkeypatch.setattr(close_pieces, "_cut_until_close", as_far_as_before)
    monkeypatch.setattr(close_pieces, "join_pieces", as_far_as_before)
    found = build_hulls(shapes.comb(), HullParameters())
    assert len(rounds) == 2 * close_pieces._MOST_ROUNDS
    assert found.n_hulls == 1
    assert "no cuts" in found.notes[-1]


@pytest.mark.parametrize("n_samples", [0, 1, 3])
def test_a_piece_with_few_samples_of_the_surface_is_cut(n_samples):
    """Such are small pieces, and films that planes leave beside flat faces."""
    mesh = shapes.comb()
    piece = whole(solid_of(mesh), fit_for(mesh, HullParameters(), 1.0)[0])
    few = np.full_like(piece.triangles, -1)
    at_a_corner = piece.boundary.sum(axis=1).argsort()[:n_samples]
    few[at_a_corner] = piece.triangles[at_a_corner]
    below, above = run(close_pieces.best_cut(replace(piece, triangles=few)))
    assert 0 < below.volume < piece.volume
    assert below.volume + above.volume == pytest.approx(piece.volume)


@pytest.mark.parametrize("max_vertices", [4, 6])
def test_more_hulls_make_up_for_few_vertices(max_vertices):
    errors = []
    for most in (1, 2, 8):
        parameters = HullParameters(max_vertices=max_vertices, max_hulls=most)
        found = build_hulls(shapes.box(), parameters)
        errors.append(found.errors.max())
        (note,) = found.notes
        assert note.endswith(
            f"because Most Vertices = {max_vertices} leaves out corners of hulls; raise"
            " Most Vertices."
        )
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] < 0.7 * errors[0]


def test_a_solid_cut_for_lack_of_vertices_is_told_of_no_flat_faces():
    found = build_hulls(shapes.l_shape(), HullParameters(max_vertices=4, max_hulls=8))
    assert "because Most Vertices = 4 leaves out corners" in found.notes[-1]


@pytest.mark.parametrize("margin", [-0.03, 0.03])
def test_nothing_is_cut_for_a_margin_that_is_too_much_at_corners_alone(margin):
    cube = shapes.box((-1, -1, -1), (1, 1, 1))
    found = build_hulls(cube, HullParameters(margin=margin, max_error=0.05))
    assert found.n_hulls == 1
    assert "alone uses up Largest Error" in found.notes[0]
    assert build_hulls(cube, HullParameters(margin=-0.028)).notes == ()
