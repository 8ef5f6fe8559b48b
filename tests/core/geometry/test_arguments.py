"""What the computations in steps refuse, each in one sentence."""

import clouds
import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.measurement import measure_in_steps
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run

MESH, CLOUD = shapes.l_prism(), clouds.cloud_of(shapes.l_prism(), 50)
SETTINGS = {
    decompose_in_steps: Parameters(samples=50),
    measure_in_steps: Parameters(samples=50),
    build_hulls_in_steps: HullParameters(),
}
PARTS = HullParameters(pieces="PARTS")


def called(function, shape=MESH, parameters=None, cache=None, *others, **named):
    """Run a computation, with arguments that fit unless they are given."""
    parameters = SETTINGS[function] if parameters is None else parameters
    cache = ShapeCache(BruteCaster) if cache is None else cache
    return run(function(shape, parameters, cache, *others, **named))


@pytest.mark.parametrize("function", SETTINGS)
@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ((MESH.vertices,), r"`shape` must be a TriangleMesh or PointCloud, not an arr"),
        ((MESH, {}), r"`parameters` must be a (Hull)?Parameters, not .* type dict"),
        ((MESH, None, BruteCaster), "`cache` must be a ShapeCache, not .* type type"),
    ],
)
def test_arguments_of_wrong_types_are_refused(function, arguments, sentence):
    with pytest.raises(TypeError, match=sentence):
        called(function, *arguments)


@pytest.mark.parametrize("function", [decompose_in_steps, measure_in_steps])
@pytest.mark.parametrize("shape", [MESH, CLOUD])
def test_members_that_do_not_fit_are_refused(function, shape):
    size = MESH.n_polygons if shape is MESH else len(CLOUD)
    for members, error in (
        ([True] * size, TypeError),
        (np.ones(size, dtype=np.int64), TypeError),
        (np.ones(size + 1, dtype=np.bool_), DecompositionError),
        (np.ones((size, 1), dtype=np.bool_), DecompositionError),
        (np.zeros(size, dtype=np.bool_), DecompositionError),
    ):
        with pytest.raises(error, match=r"`members` must be .*\.$"):
            called(function, shape, None, None, members)
    called(function, shape, None, None, np.ones(size, dtype=np.bool_))


@pytest.mark.parametrize(
    ("named", "error", "sentence"),
    [
        ({"labels": [0, 1]}, DecompositionError, "`labels` must be 8 numbers"),
        ({"labels": [-1] * 8}, DecompositionError, "`labels` must be 8 numbers from 0"),
        ({"labels": [0.5] * 8}, TypeError, "`labels` must be whole numbers"),
        ({"parameters": PARTS}, DecompositionError, "needs the part .* pass `labels`"),
        ({"seed": -1}, DecompositionError, "Seed is -1; choose a value from 0"),
        ({"seed": "one"}, DecompositionError, "Seed must be a whole number"),
        ({"kinds": "BOX"}, TypeError, "`kinds` must be a dict, not .* type str"),
        ({"shape": CLOUD}, DecompositionError, "A cloud has no faces"),
    ],
)
def test_what_hulls_cannot_be_built_of_is_refused(named, error, sentence):
    with pytest.raises(error, match=sentence):
        called(build_hulls_in_steps, **named)


def test_labels_may_be_a_list_and_kinds_name_any_parts():
    kinds = {1: "SPHERE", 0: "BOX", 5: "BOX"}
    found = called(
        build_hulls_in_steps, MESH, PARTS, labels=[0, 1] * 4, kinds=kinds, seed=1
    )
    assert {shape.kind for shape in found.shapes} == {"BOX", "SPHERE"}
