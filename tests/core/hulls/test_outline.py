"""Faces to show, shapes of single parts, and another shape for one piece."""

import numpy as np
import pytest
import shapes
from brute_caster import BruteCaster
from computed import build_hulls
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.hulls.build import build_hulls_in_steps
from weak_convex_decomposition.core.hulls.outline import faces_of
from weak_convex_decomposition.core.hulls.refit import refit_in_steps
from weak_convex_decomposition.core.parameters.hulls import HullParameters
from weak_convex_decomposition.core.steps.progress import run


def halves(mesh):
    """Return labels that cut a mesh in two along x."""
    centers = mesh.vertices[mesh.triangles].mean(axis=1)[:, 0]
    labels = np.zeros(mesh.n_polygons, dtype=np.int64)
    labels[mesh.polygons] = centers > np.median(centers)
    return labels


@pytest.mark.parametrize("kind", ["HULL", "BOX", "CYLINDER"])
def test_faces_close_around_the_volume(kind):
    mesh = shapes.dumbbell()
    parameters = HullParameters(pieces="PARTS", shape=kind)
    for shape in build_hulls(mesh, parameters, halves(mesh)).shapes:
        vertices, faces = faces_of(shape)
        assert faces.shape == ((6, 4) if kind == "BOX" else (len(faces), 3))
        fans = [(f[0], f[i], f[i + 1]) for f in faces for i in range(1, len(f) - 1)]
        a, b, c = np.moveaxis(vertices[np.array(fans)], 1, 0)
        volume = np.einsum("fd,fd->f", a, np.cross(b, c)).sum() / 6
        assert volume == pytest.approx(shape.volume, rel=0.02)


def test_a_part_may_have_a_shape_of_its_own():
    mesh, parameters = shapes.dumbbell(), HullParameters(pieces="PARTS")
    cache = ShapeCache(BruteCaster)
    labels = halves(mesh) + 3
    steps = build_hulls_in_steps(
        mesh, parameters, cache, labels, kinds={4: "SPHERE", 3: "BOX"}
    )
    found = run(steps)
    kinds = {int(n): s.kind for n, s in zip(found.parts, found.shapes, strict=True)}
    assert kinds == {3: "BOX", 4: "SPHERE"}
    spheres = build_hulls(mesh, HullParameters(pieces="PARTS", shape="SPHERE"), labels)
    sphere = found.parts.tolist().index(4)
    other = spheres.parts.tolist().index(4)
    assert found.errors[sphere] == spheres.errors[other]


@pytest.mark.parametrize("unit", ["RELATIVE", "SCENE"])
def test_another_shape_is_the_one_that_would_have_been_built(unit):
    mesh, cache = shapes.dumbbell(), ShapeCache(BruteCaster)
    parameters = HullParameters(pieces="PARTS", shape="SPHERE", error_unit=unit)
    expected = build_hulls(mesh, parameters, halves(mesh))
    for row, shape in enumerate(expected.shapes):
        points = shape.hull.vertices
        found = run(refit_in_steps(mesh, points, parameters, cache))
        assert found.shapes[0].volume == pytest.approx(shape.volume, rel=1e-6)
        assert found.errors[0] == pytest.approx(expected.errors[row], rel=0.1)


@pytest.mark.parametrize("kind", ["HULL", "BOX", "SPHERE"])
def test_another_shape_of_a_convex_solid_has_the_error_of_a_built_one(kind):
    mesh, parameters = shapes.box(), HullParameters(shape=kind, max_hulls=1)
    expected = build_hulls(mesh, parameters)
    steps = refit_in_steps(mesh, mesh.vertices, parameters, ShapeCache(BruteCaster))
    assert run(steps).errors == pytest.approx(expected.errors, rel=0.05, abs=1e-9)
    assert (expected.errors.max() < 1e-9) == (kind != "SPHERE")
