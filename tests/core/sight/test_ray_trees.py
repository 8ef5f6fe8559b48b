import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.sight import ray_caster
from weak_convex_decomposition.core.sight.ray_caster import caster_in_steps
from weak_convex_decomposition.core.steps.progress import run


@pytest.mark.parametrize("most", [1, 7, 100, 319])
def test_several_trees_hit_what_one_hits(most, monkeypatch):
    monkeypatch.setattr(ray_caster, "_IN_A_TREE", most)
    monkeypatch.setattr(ray_caster, "_MOST_TREES", 320)
    mesh = shapes.sphere(2)
    random = np.random.default_rng(0)
    starts, ways = random.uniform(-1.5, 1.5, (2, 300, 3))
    rays = starts, ways / np.linalg.norm(ways, axis=1)[:, None], random.random(300) * 3
    triangles, distances = run(caster_in_steps(mesh, BruteCaster)).first_hit(*rays)
    expected, expected_distances = BruteCaster(mesh).first_hit(*rays)
    assert triangles.tolist() == expected.tolist()
    assert distances == pytest.approx(expected_distances, rel=1e-9)
    assert 50 < (expected >= 0).sum() < 250


def noting(sizes):
    """Return what makes casters, and notes how many triangles each has."""

    def make_caster(mesh):
        sizes.append(len(mesh.triangles))
        return BruteCaster(mesh)

    return make_caster


def test_each_tree_is_a_step(monkeypatch):
    monkeypatch.setattr(ray_caster, "_IN_A_TREE", 100)
    made = []
    counts = [len(made) for _ in caster_in_steps(shapes.sphere(2), noting(made))]
    # Triangles are chosen in one step, and their tree is made in the next.
    assert counts == [0, 0, 0, 1, 1, 2, 2, 3, 3]
    assert made == [80] * 4


def test_there_are_no_more_trees_than_rays_can_ask(monkeypatch):
    monkeypatch.setattr(ray_caster, "_IN_A_TREE", 1)
    made = []
    run(caster_in_steps(shapes.sphere(2), noting(made)))
    assert made == [10] * 32
