import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.parameters.parts import Parameters
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


class JunkCaster(BruteCaster):
    """Answers something else than the protocol says."""

    junk = None

    def first_hit(self, *rays):
        triangles, distances = super().first_hit(*rays)
        return type(self).junk(triangles, distances)


@pytest.mark.parametrize("most", [100, 319, 1000])
@pytest.mark.parametrize(
    "junk",
    [
        lambda triangles, distances: None,
        lambda triangles, distances: (triangles, distances, triangles),
        lambda triangles, distances: (triangles[:-1], distances[:-1]),
        lambda triangles, distances: (triangles[:, None], distances[:, None]),
        lambda triangles, distances: (triangles + 400, distances),
        lambda triangles, distances: (triangles + 0.0, distances),
        lambda triangles, distances: (triangles, 0 * distances / 0),
        lambda triangles, distances: (triangles, np.full(len(triangles), np.inf)),
        lambda triangles, distances: (triangles, -distances),
        lambda triangles, distances: (triangles, ["far"] * len(triangles)),
    ],
)
@pytest.mark.filterwarnings("ignore:invalid value")
def test_what_is_no_hit_is_told(monkeypatch, most, junk):
    monkeypatch.setattr(ray_caster, "_IN_A_TREE", most)
    monkeypatch.setattr(JunkCaster, "junk", junk)
    shape = shapes.dumbbell()
    with pytest.raises(DecompositionError, match=r"correct its method `first_hit`\.$"):
        run(decompose_in_steps(shape, Parameters(samples=50), ShapeCache(JunkCaster)))


def test_hits_may_be_lists(monkeypatch):
    monkeypatch.setattr(
        JunkCaster, "junk", lambda *hits: [each.tolist() for each in hits]
    )
    for most in (100, 1000):
        monkeypatch.setattr(ray_caster, "_IN_A_TREE", most)
        plain, listed = (
            run(decompose_in_steps(shapes.dumbbell(), Parameters(samples=50), cache))
            for cache in map(ShapeCache, (BruteCaster, JunkCaster))
        )
        assert plain.labels.tolist() == listed.labels.tolist()
