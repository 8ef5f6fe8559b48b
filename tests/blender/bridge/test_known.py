"""What Blender is slow to tell of a mesh is kept, and follows the mesh."""

import bpy
import numpy as np
import pytest
from hand_made import decomposition_of
from weak_convex_decomposition import Parameters, run
from weak_convex_decomposition.operators.bridge.mesh import known
from weak_convex_decomposition.operators.bridge.mesh.attributes import (
    read_floats,
    read_ints,
)
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


def wild_mesh(seed, offset=0.0, scale=1.0, share_of_wild=0.005):
    """Make quads, triangles and pentagons; of the quads, some are bent or folded."""
    rng = np.random.default_rng(seed)
    n_faces = 4000
    around = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    quads = around + rng.uniform(-0.2, 0.2, (n_faces, 4, 3))
    wild = rng.random(n_faces) < share_of_wild
    quads[wild] = rng.integers(-1, 2, (wild.sum(), 4, 3))  # many without an area
    places = scale * (quads.reshape(-1, 3) + 3 * rng.random((1, 3))) + offset
    faces = np.arange(len(places)).reshape(-1, 4).tolist()
    faces[5], faces[7:9] = faces[5][:3], [faces[7] + faces[8][:1]]
    mesh = bpy.data.meshes.new("wild")
    mesh.from_pydata(places.tolist(), [], faces)
    return mesh


def told_by_blender(mesh):
    mesh.calc_loop_triangles()
    return read_ints(mesh.loop_triangles, "vertices", 3)


@pytest.mark.parametrize("with_normals", [False, True])
@pytest.mark.parametrize("place", [(0, 1), (1e4, 1), (0, 1e-6), (0, 1e12), (0, 1e-25)])
@pytest.mark.parametrize("share_of_wild", [0.005, 1.0])
def test_faces_are_cut_as_blender_cuts_them(place, share_of_wild, with_normals):
    for seed in range(3):
        mesh = wild_mesh(seed, *place, share_of_wild)
        if with_normals:
            assert len(mesh.polygon_normals)  # Blender uses them if they are known
        _, triangles, faces = known.triangles_of(mesh)
        assert np.array_equal(triangles, told_by_blender(mesh))
        assert np.array_equal(
            np.bincount(faces) + 2, read_ints(mesh.polygons, "loop_total")
        )


def test_blender_is_asked_for_few_triangles(suzanne, monkeypatch):
    def never(*_):
        raise AssertionError

    monkeypatch.setattr(
        "weak_convex_decomposition.operators.bridge.mesh.triangles._all_asked", never
    )
    known.forget()
    known.triangles_of(suzanne.data)
    with pytest.raises(AssertionError):
        known.triangles_of(wild_mesh(0, share_of_wild=1.0))
