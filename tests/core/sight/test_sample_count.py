import numpy as np
import pytest
import shapes
from computed import prepare
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight import visibility
from weak_convex_decomposition.core.steps.progress import run


class TakenError(Exception):
    """Holds how many samples were asked for."""


@pytest.fixture
def n_samples(monkeypatch):
    """Return a function: how many samples are taken of a prepared shape."""

    def take(mesh, rows, sampling, n_samples, rng):
        raise TakenError(n_samples)

    monkeypatch.setattr(visibility, "take_samples", take)

    def asked(prepared, samples):
        with pytest.raises(TakenError) as taken:
            run(visibility.see_in_steps(prepared, Parameters(samples=samples)))
        return taken.value.args[0]

    return asked


@pytest.mark.parametrize(
    ("make", "asked", "taken"),
    [
        (shapes.l_prism, 1200, 400),
        (shapes.l_prism, 1500, 500),
        (shapes.l_prism, 400, 400),
        (shapes.l_prism, 50, 50),
        (lambda: shapes.voxels(np.ones((6, 6, 6))), 1200, 864),  # 432 triangles
        (lambda: shapes.sphere(3), 1200, 1200),
    ],
)
def test_small_meshes_take_fewer_samples(n_samples, make, asked, taken):
    assert n_samples(prepare(make()), asked) == taken


def test_clouds_and_flat_meshes_take_all(n_samples):
    points = PointCloud(shapes.sphere(2).vertices)
    assert n_samples(prepare(points), 600) == 600
    assert n_samples(prepare(shapes.sheet(2)), 600) == 600


def test_a_part_of_a_larger_mesh_takes_all(n_samples):
    whole = prepare(shapes.sphere(3))
    part = whole.part(np.arange(len(whole.nodes)) < 9)
    assert n_samples(part, 600) == 600


def test_measuring_takes_all(n_samples):
    prepared, parameters = prepare(shapes.l_prism()), Parameters(samples=900)
    with pytest.raises(TakenError) as taken:
        run(visibility.find_lines_of_sight(prepared, parameters))
    assert taken.value.args[0] == 900
