import bpy
import numpy as np
import pytest
from brute_caster import BruteCaster
from weak_convex_decomposition.core.sight import ray_caster
from weak_convex_decomposition.core.sight.ray_caster import caster_in_steps
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster
from weak_convex_decomposition.operators.bridge.rays.choice import choose_ray_caster
from weak_convex_decomposition.operators.bridge.read.shape import read_shape

PRECISION = 1e-5  # casters work in single precision, the shapes have size 2


@pytest.fixture(params=["bvh", "several trees", "embree"])
def make_caster(request, monkeypatch):
    if request.param == "several trees":
        monkeypatch.setattr(ray_caster, "_IN_A_TREE", 5)
        monkeypatch.setattr(ray_caster, "_MOST_TREES", 1000)
        return lambda mesh: run(caster_in_steps(mesh, BvhRayCaster))
    if request.param != "embree":
        return BvhRayCaster
    pytest.importorskip("embreex")
    from weak_convex_decomposition.operators.bridge.rays.embree import EmbreeRayCaster

    return EmbreeRayCaster


def random_rays(mesh, n_rays, seed):
    """Return rays between random points of the bounding box, grown by a third."""
    random = np.random.default_rng(seed)
    low, high = mesh.vertices.min(axis=0), mesh.vertices.max(axis=0)
    ends = (low + high) / 2 + (high - low) * random.uniform(
        -2 / 3, 2 / 3, (2, n_rays, 3)
    )
    along = ends[1] - ends[0]
    length = np.linalg.norm(along, axis=1)
    return ends[0], along / length[:, None], length


@pytest.mark.parametrize("shape", ["monkey", "torus", "cube", "cone"])
def test_agrees_with_the_oracle_ray_by_ray(shape, make_caster):
    getattr(bpy.ops.mesh, f"primitive_{shape}_add")()
    mesh = read_shape(bpy.context.active_object)
    origins, directions, reach = random_rays(mesh, 3000, seed=1)
    triangles, distances = make_caster(mesh).first_hit(origins, directions, reach)
    expected, expected_distances = BruteCaster(mesh).first_hit(
        origins, directions, reach
    )
    # A ray through an edge may name either triangle, or slip past a silhouette.
    differ = triangles != expected
    assert differ.mean() < 0.002
    same_place = np.isclose(distances, expected_distances, atol=PRECISION)
    assert (~same_place).mean() < 0.001
    assert (expected >= 0).mean() > 0.2
    assert (expected < 0).mean() > 0.05


def test_reach_limits_hits(suzanne, make_caster):
    mesh = read_shape(suzanne)
    origins, directions, _ = random_rays(mesh, 500, seed=2)
    caster = make_caster(mesh)
    far = caster.first_hit(origins, directions, np.full(500, 100.0))[1]
    near_triangles, near = caster.first_hit(origins, directions, far * 0.99)
    hit = np.isfinite(far)
    assert hit.sum() > 100
    assert (near_triangles[hit] == -1).all()
    assert np.isinf(near[hit]).all()


def test_no_rays_give_no_hits(suzanne, make_caster):
    none = np.empty((0, 3))
    triangles, distances = make_caster(read_shape(suzanne)).first_hit(
        none, none, np.empty(0)
    )
    assert triangles.shape == distances.shape == (0,)
    assert triangles.dtype == np.int64


def test_answers_are_integers_and_floats(suzanne, make_caster):
    mesh = read_shape(suzanne)
    triangles, distances = make_caster(mesh).first_hit(*random_rays(mesh, 10, seed=3))
    assert triangles.dtype == np.int64
    assert distances.dtype == np.float64
    assert (np.isinf(distances) == (triangles == -1)).all()


def test_blender_casts_its_own_rays():
    assert choose_ray_caster() is BvhRayCaster


def test_nothing_is_added_to_the_file(suzanne):
    mesh = read_shape(suzanne)
    before = bpy.data.meshes.new("before").session_uid  # numbers are given in turn
    BvhRayCaster(mesh)
    assert bpy.data.meshes.new("after").session_uid == before + 1
