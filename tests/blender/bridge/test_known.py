"""What Blender is slow to tell of a mesh is kept, and follows the mesh."""

import numpy as np
import pytest
from hand_made import decomposition_of
from weak_convex_decomposition import Parameters, run
from weak_convex_decomposition.operators.bridge.mesh import known
from weak_convex_decomposition.operators.bridge.mesh.attributes import read_floats
from weak_convex_decomposition.operators.bridge.mesh.by_label import ByLabel
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.parts.write import write_parts


def stretch(mesh, factor):
    places = read_floats(mesh.vertices, "co", 3) * (factor, 1, 1)
    mesh.vertices.foreach_set("co", places.astype(np.float32).ravel())
    mesh.update()


@pytest.fixture
def mesh(suzanne):
    known.triangles_of(suzanne.data)
    return suzanne.data


def test_what_is_kept_follows_the_mesh(mesh):
    before = known.face_areas(mesh)
    assert known.face_areas(mesh) is before
    stretch(mesh, 2)
    assert np.array_equal(known.face_areas(mesh), read_floats(mesh.polygons, "area"))
    assert not np.array_equal(known.face_areas(mesh), before)


def test_of_another_mesh_nothing_is_kept(mesh):
    latest = known.latest_of(mesh)
    other = mesh.copy()
    stretch(other, 2)
    assert known.latest_of(other) is None
    assert known.face_centers(other) is not known.face_centers(other)
    assert known.latest_of(mesh) is latest


@pytest.mark.parametrize("n_labels", [1, 3])
def test_steps_read_the_same(suzanne, mesh, monkeypatch, n_labels):
    labels = np.arange(len(mesh.polygons)) % n_labels
    at_once = ByLabel.of(suzanne, labels, n_labels)
    monkeypatch.setattr(
        "weak_convex_decomposition.operators.bridge.mesh.by_label._ROOM", 1
    )
    in_steps = run(ByLabel.in_steps(lambda: suzanne, labels, n_labels))
    assert in_steps.is_of(suzanne)
    assert in_steps.vertices == at_once.vertices
    assert np.array_equal(in_steps.sums, at_once.sums)
    assert not at_once.is_of(suzanne)


def test_figures_are_of_the_mesh_that_is_written_to(suzanne, mesh):
    labels = np.arange(len(mesh.polygons)) % 2
    ready = run(ByLabel.in_steps(lambda: suzanne, labels, 2))
    stretch(mesh, 2)
    write_parts(suzanne, decomposition_of(labels), Parameters(), ready=ready)
    assert figures_of(suzanne).problem is None
