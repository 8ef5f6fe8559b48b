"""What is kept for another cut, and what tells whether it is still right."""

from dataclasses import fields, replace

import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from weak_convex_decomposition.core.decomposition import decompose, decompose_seen
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.parameters.parameter import info_of
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.find import find_parts
from weak_convex_decomposition.core.sight.visibility_key import visibility_key
from weak_convex_decomposition.core.steps.progress import run

BEFORE = Parameters(samples=120, max_parts=5)
# A value of each parameter that changes what comes out.
CHANGES = {
    "parts": 9,
    "rays": 31,
    "alpha": 1.0,
    "sight": "CONE",
    "sampling": "FACES",
    "samples": 121,
    "cone_angle": 1.0,
    "psi_pairs": "RAYS",
    "containers": "HOLLOW",
    "normalization": "STOCHASTIC",
    "min_parts": 4,
    "max_parts": 8,
    "refinement": "EMBEDDING",
    "smoothness": 0.0,
    "smallest_part": 0.1,
    "levels": 2,
    "seed": 1,
}
RECUT = [f.name for f in fields(Parameters) if info_of(f).recut]


def result(found):
    return found.labels.tolist(), found.psi, found.psi_by_k, found.ranks.tolist()


@pytest.mark.parametrize("name", RECUT)
def test_a_new_cut_is_that_of_a_new_run(seen, decomposed, name):
    after = replace(BEFORE, **{name: CHANGES[name]})
    visibility = seen(shapes.comb, samples=120, max_parts=5)
    run(find_parts(visibility, BEFORE))
    again = run(decompose_seen(shapes.comb(), visibility, after, BruteCaster))
    fresh = run(decompose(shapes.comb(), after, BruteCaster))
    assert result(again) == result(fresh)
    back = run(find_parts(visibility, BEFORE))
    assert result(back) == result(decomposed(shapes.comb, samples=120, max_parts=5))


@pytest.mark.parametrize("name", CHANGES)
def test_the_key_changes_with_what_is_seen(name):
    after = replace(BEFORE, **{name: CHANGES[name]})
    same = visibility_key(shapes.comb(), after) == visibility_key(shapes.comb(), BEFORE)
    assert same == (name in RECUT)


def test_every_parameter_is_tried():
    assert list(CHANGES) == [field.name for field in fields(Parameters)]


@pytest.mark.parametrize("name", ["vertices", "triangles", "polygons"])
def test_the_key_changes_with_the_mesh(name):
    mesh = shapes.comb()
    array = getattr(mesh, name).copy()
    array[[0, -1]] = array[[-1, 0]]
    changed = replace(mesh, **{name: array})
    assert visibility_key(mesh, BEFORE) == visibility_key(shapes.comb(), BEFORE)
    assert visibility_key(changed, BEFORE) != visibility_key(mesh, BEFORE)


def test_the_key_changes_with_the_normals_of_points():
    points = shapes.comb().vertices
    keys = {
        visibility_key(PointCloud(points, normals), BEFORE)
        for normals in (None, np.ones_like(points), -np.ones_like(points))
    }
    assert len(keys) == 3
