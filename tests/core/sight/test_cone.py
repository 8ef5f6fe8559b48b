from dataclasses import replace

import numpy as np
import pytest
import shapes
from computed import decompose, lines_of_sight, prepare
from weak_convex_decomposition import Parameters
from weak_convex_decomposition.core.geometry.directions import (
    cone_directions,
    fan_directions,
)
from weak_convex_decomposition.core.geometry.sampling import sample_surface
from weak_convex_decomposition.core.sight.all_pairs import (
    see_all_pairs,
    see_uniform_pairs,
)
from weak_convex_decomposition.core.sight.cone import see_cones, shared_rays
from weak_convex_decomposition.core.sight.ray_march import RayMarcher
from weak_convex_decomposition.core.sight.viewpoints import viewpoints
from weak_convex_decomposition.core.steps.progress import run


def look_at(mesh, n_samples):
    shape = prepare(mesh)
    samples = sample_surface(shape.targets, n_samples, np.random.default_rng(0))
    return shape, run(viewpoints(shape.marcher, samples))


def matrices(found):
    """Return the positive and the negative LoS matrix of what cones found."""
    return found.visible, found.known - found.visible


@pytest.fixture(scope="module")
def l_views():
    return look_at(shapes.l_prism(), 300)


@pytest.fixture(scope="module")
def l_los(l_views):
    _, views = l_views
    return run(see_all_pairs(views)).visible > 0


@pytest.fixture(scope="module")
def l_cones(l_views):
    positive, negative = matrices(run(see_cones(*l_views, 30, np.radians(120))))
    return positive.toarray(), negative.toarray()


@pytest.mark.parametrize("degrees", [1, 60, 120, 180])
@pytest.mark.parametrize("n_rays", [1, 30, 200])
def test_directions_fill_the_cone_evenly(degrees, n_rays):
    normals = np.random.default_rng(1).normal(size=(5, 3))
    normals = np.concatenate([normals, np.eye(3), -np.eye(3)])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    half = np.radians(degrees) / 2
    directions = cone_directions(normals, n_rays, 2 * half)
    assert directions.shape == (len(normals), n_rays, 3)
    assert np.linalg.norm(directions, axis=2) == pytest.approx(1.0)
    cosines = -(directions * normals[:, None]).sum(axis=2)
    assert cosines.min() > np.cos(half) - 1e-9
    if n_rays < 30:
        return
    # Equal solid angles are equal steps of the cosine, and go around evenly.
    caps = np.histogram(cosines[0], 5, (np.cos(half), 1.0))[0]
    assert caps == pytest.approx(np.full(5, n_rays / 5), abs=1.01)
    sideways = directions + cosines[:, :, None] * normals[:, None]
    assert np.abs(sideways.mean(axis=1)).max() < 0.05 * np.sin(half)


def test_the_matrices_are_symmetric_disjoint_and_of_zeros_and_ones(l_cones):
    positive, negative = l_cones
    for matrix in l_cones:
        assert (matrix == matrix.T).all()
        assert set(np.unique(matrix)) == {0.0, 1.0}
    assert (positive.diagonal() == 1).all()
    assert (negative.diagonal() == 0).all()
    assert not (positive * negative).any()


def test_entries_agree_with_all_pairs(l_cones, l_los):
    positive, negative = (matrix > 0 for matrix in l_cones)
    assert positive.sum() > 10 * 300
    assert negative.sum() > 300
    assert l_los[positive].mean() > 0.97
    assert (~l_los[negative]).mean() > 0.9


def test_most_pairs_are_unknown_to_cones(l_cones):
    assert (l_cones[0] + l_cones[1]).mean() < 0.5


def test_a_wider_cone_sees_more_pairs(l_views, l_cones):
    narrow, _ = matrices(run(see_cones(*l_views, 30, np.radians(20))))
    assert narrow.sum() < l_cones[0].sum()


def test_a_convex_shape_hides_nothing():
    views = look_at(shapes.box(), 100)
    positive, negative = matrices(run(see_cones(*views, 10, np.pi / 2)))
    assert negative.nnz == 0
    assert positive.sum() > 300


def test_a_fan_is_even_and_stays_in_its_plane():
    plane = np.array([0.0, 0.6, 0.8])
    normals = np.array([[1.0, 0.0, 0.0], [0.0, 0.8, -0.6]])
    rays = fan_directions(normals, 6, np.radians(120), plane)
    assert abs(rays @ plane).max() < 1e-12
    assert np.linalg.norm(rays, axis=2) == pytest.approx(1)
    angles = np.degrees(np.arccos(-np.einsum("nrd,nd->nr", rays, normals)))
    assert angles == pytest.approx(np.tile([50, 30, 10, 10, 30, 50], (2, 1)))
    between = np.einsum("nrd,nrd->nr", rays[:, 1:], rays[:, :-1])
    assert between == pytest.approx(np.cos(np.radians(20)))


def test_separate_solids_behind_each_other_are_known_to_be_hidden():
    far = shapes.box((3, 0, 0), (4, 1, 1))
    shape, views = look_at(shapes.joined(shapes.box(), far), 100)
    left = views.samples.positions[:, 0] < 0
    found = run(see_cones(shape, views, 30, np.radians(60)))
    positive, negative = matrices(found)
    assert positive.toarray()[np.ix_(left, ~left)].sum() == 0
    assert negative.toarray()[np.ix_(left, ~left)].sum() > 0


def test_rays_out_of_an_open_shape_add_no_entry():
    # A valley: no ray that goes down from it meets it again.
    sheet = shapes.sheet(6)
    x, y, _ = sheet.vertices.T
    valley = np.stack([x, y, (x - x.mean()) ** 2], axis=1)
    views = look_at(replace(sheet, vertices=valley), 50)
    positive, negative = matrices(run(see_cones(*views, 10, np.pi / 2)))
    assert (positive.toarray() == np.eye(50)).all()
    assert negative.nnz == 0


def test_uniform_pairs_agree_with_all_pairs(l_views, l_los):
    _, views = l_views
    rng = np.random.default_rng(0)
    known = run(see_uniform_pairs(views, rng, 60_000))
    looked_up, visible = known.known.toarray(), known.visible.toarray()
    assert (looked_up == looked_up.T).all()
    assert (visible == looked_up * l_los).all()
    assert known.rank_of_all()[0] == pytest.approx(l_los.mean(), abs=0.01)


@pytest.mark.parametrize(
    ("n_rays", "n_samples", "n_pairs", "n_left"),
    [(0, 300, 60_000, 0), (1, 300, 0, 1), (8, 300, 1200, 4), (8, 50_000, 60_000, 6)],
)
def test_pairs_take_half_of_the_rays_at_most(n_rays, n_samples, n_pairs, n_left):
    parameters = Parameters(rays=n_rays)
    assert shared_rays(parameters, n_samples) == (n_pairs, n_left)
    alone = replace(parameters, psi_pairs="RAYS")
    assert shared_rays(alone, n_samples) == (0, n_rays)
    if n_rays:
        assert n_pairs + n_left * n_samples <= n_rays * n_samples


@pytest.mark.parametrize("n_rays", [1, 2, 30])
def test_no_more_lines_start_than_asked_for(monkeypatch, n_rays):
    started, along = [], RayMarcher.surfaces_along

    def counted(marcher, origins, *rest):
        started.append(len(origins))
        return along(marcher, origins, *rest)

    monkeypatch.setattr(RayMarcher, "surfaces_along", counted)
    sight = lines_of_sight(
        shapes.l_prism(), Parameters(samples=100, sight="CONE", rays=n_rays)
    )
    apart = sight.rank_pairs is not sight.affinity_pairs
    assert apart == (n_rays > 1)
    n_pairs = sight.rank_pairs.n_cast if apart else 0
    assert 0.7 * n_rays * 100 < sum(started) + n_pairs <= n_rays * 100


def test_pairs_that_rays_tell_of_count_as_cast():
    parameters = Parameters(samples=100, sight="CONE", psi_pairs="RAYS")
    found = decompose(shapes.l_prism(), parameters)
    assert 0 < found.pairs_cast <= 100 * 99 // 2
