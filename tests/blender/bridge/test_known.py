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
from weak_convex_decomposition.operators.bridge.mesh.by_label import (
    ByLabel,
    read_ahead,
)
from weak_convex_decomposition.operators.bridge.mesh.triangles import ask
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
    run(read_ahead(lambda: suzanne, labels, n_labels))
    (ahead,) = known.latest_of(mesh).ahead.values()
    assert ahead.vertices == at_once.vertices
    assert np.array_equal(ahead.sums, at_once.sums)
    assert ByLabel.of(suzanne, labels, n_labels) is ahead
    assert ByLabel.of(suzanne, labels, n_labels) is not ahead  # it is kept no more


def test_what_was_read_ahead_is_of_these_labels(suzanne, mesh):
    labels = np.arange(len(mesh.polygons)) % 2
    run(read_ahead(lambda: suzanne, labels, 2))
    others = ByLabel.of(suzanne, 1 - labels, 2)
    assert others.vertices == ByLabel.of(suzanne, labels, 2).vertices[::-1]


def test_figures_are_of_the_mesh_that_is_written_to(suzanne, mesh):
    labels = np.arange(len(mesh.polygons)) % 2
    run(read_ahead(lambda: suzanne, labels, 2))
    stretch(mesh, 2)
    write_parts(suzanne, decomposition_of(labels), Parameters())
    assert figures_of(suzanne).problem is None


@pytest.mark.parametrize("size", [1e10, 1e20, 1e38])
def test_parts_of_what_is_too_large_for_areas(size):
    """Single precision does not hold them."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    corners = read_floats(obj.data.vertices, "co", 3) * np.float32(size)
    obj.data.vertices.foreach_set("co", corners.ravel())
    obj.data.update()
    assert np.isfinite(known.face_areas(obj.data)).all()
    assert np.isfinite(known.face_centers(obj.data)).all()
    write_parts(obj, decomposition_of(np.arange(6) % 2), Parameters())
    assert figures_of(obj).problem is None


def quads_mesh(seed, offset=0.0, scale=1.0, wild=False):
    """Make quads, dented ones among them, a triangle and a pentagon; or any quads."""
    rng = np.random.default_rng(seed)
    n_faces = 4000
    around = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    quads = around + rng.uniform(-0.2, 0.2, (n_faces, 4, 3))
    dented = np.arange(0, n_faces, 3)  # each corner of some quads lies inside
    quads[dented, dented % 4] = 0.7 * quads[dented, (dented + 2) % 4] + 0.1
    if wild:
        quads = rng.integers(-1, 2, (n_faces, 4, 3))  # many without an area
    places = scale * (quads.reshape(-1, 3) + 3 * rng.random((1, 3))) + offset
    faces = np.arange(len(places)).reshape(-1, 4).tolist()
    faces[5], faces[7:9] = faces[5][:3], [faces[7] + faces[8][:1]]
    mesh = bpy.data.meshes.new("quads")
    mesh.from_pydata(places.tolist(), [], faces)
    return mesh


def told_by_blender(mesh):
    mesh.calc_loop_triangles()
    return read_ints(mesh.loop_triangles, "vertices", 3)


@pytest.mark.parametrize("place", [(0, 1), (1e3, 1), (0, 1e-6), (0, 1e8)])
def test_faces_are_cut_as_blender_cuts_them(place):
    for seed in range(3):
        mesh = quads_mesh(seed, *place)
        _, triangles, faces = known.triangles_of(mesh)
        assert np.array_equal(triangles, told_by_blender(mesh))
        assert np.array_equal(
            np.bincount(faces) + 2, read_ints(mesh.polygons, "loop_total")
        )


@pytest.mark.parametrize("scale", [1, 2.0**-80, 2.0**40, 2.0**100])
def test_cuts_of_quads_depend_on_corners_alone(scale):
    mesh = quads_mesh(0, scale=scale, wild=True)
    _, before, faces = known.triangles_of(mesh)
    known.forget()
    assert len(mesh.polygon_normals)  # with these, Blender cuts some otherwise
    assert np.array_equal(known.triangles_of(mesh)[1], before)
    known.forget()
    _, unscaled, _ = known.triangles_of(quads_mesh(0, wild=True))
    assert np.array_equal(unscaled[faces != 7], before[faces != 7])


def test_blender_is_asked_for_large_faces_alone():
    mesh = quads_mesh(0)
    mesh.calc_loop_triangles()
    faces = read_ints(mesh.loop_triangle_polygons, "value")
    asked = ask(mesh, faces)
    assert faces[asked.rows].tolist() == [7, 7, 7]
    told = read_ints(mesh.loop_triangles, "loops", 3)
    assert np.array_equal(asked.corners, told[asked.rows])


def test_many_large_faces_are_asked_for_together():
    bpy.ops.mesh.primitive_cylinder_add(vertices=7)
    mesh = bpy.context.object.data
    assert np.array_equal(known.triangles_of(mesh)[1], told_by_blender(mesh))
