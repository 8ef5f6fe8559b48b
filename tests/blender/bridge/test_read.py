import bpy
import numpy as np
import pytest
from hand_made import activate, mesh_object
from mathutils import Vector
from weak_convex_decomposition.core.errors import DecompositionError
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.mesh import known
from weak_convex_decomposition.operators.bridge.read.arrays import shape_of
from weak_convex_decomposition.operators.bridge.read.reading_notes import (
    reading_notes,
)
from weak_convex_decomposition.operators.bridge.read.shape import (
    read_shape,
    scene_unit,
    shape_in_steps,
)
from weak_convex_decomposition.operators.bridge.read.shown_mesh import shows_keys

HEXAGON = [(np.cos(a), np.sin(a), 0.0) for a in np.linspace(0, 2 * np.pi, 7)[:-1]]


def normals(mesh):
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def test_polygons_of_any_size_become_triangles_that_know_them():
    obj = mesh_object(
        "mixed",
        [*HEXAGON, (2.0, 0.0, 0.0), (2.0, 1.0, 0.0), (3.0, 0.0, 0.0)],
        [range(6), (0, 6, 7, 1), (6, 8, 7)],
    )
    mesh = read_shape(obj)
    assert mesh.polygons.tolist() == [0, 0, 0, 0, 1, 1, 2]
    assert mesh.n_polygons == 3
    assert mesh.vertices.shape == (9, 3)
    areas = np.bincount(mesh.polygons, np.linalg.norm(normals(mesh), axis=1) / 2)
    assert areas[0] == pytest.approx(3 * np.sqrt(3) / 2, rel=1e-6)


def test_modifiers_are_named_but_not_read(suzanne):
    before = read_shape(suzanne)
    suzanne.modifiers.new("Smooth It", "SUBSURF").levels = 2
    hidden = suzanne.modifiers.new("Hidden", "MIRROR")
    hidden.show_viewport = False
    bpy.context.view_layer.update()
    assert len(read_shape(suzanne).triangles) == len(before.triangles)
    (note,) = reading_notes(suzanne)
    assert "Smooth It" in note
    assert "Hidden" not in note


def test_an_unmodified_object_needs_no_notes(suzanne):
    assert reading_notes(suzanne) == ()


def test_shared_meshes_and_shape_keys_are_noted(suzanne):
    bpy.context.collection.objects.link(bpy.data.objects.new("twin", suzanne.data))
    bpy.data.objects.new("in no collection", suzanne.data)
    bpy.data.collections.new("in no scene").objects.link(suzanne.copy())
    suzanne.shape_key_add(name="Basis")
    suzanne.shape_key_add(name="smile").value = 1.0
    shape, shared = reading_notes(suzanne)
    assert "Basis" in shape
    assert "2 objects share this mesh" in shared
    assert reading_notes(suzanne, for_parts=False) == (shape,)


def keyed(obj):
    """Give an object a Basis and a second shape, which has no value."""
    obj.shape_key_add(name="Basis")
    other = obj.shape_key_add(name="smile")
    other.value = 0.0  # from Blender 5.0 on it is new with 1
    return other


def test_a_basis_alone_moves_nothing(suzanne):
    suzanne.shape_key_add(name="Basis").value = 1.0
    assert not shows_keys(suzanne)
    other = keyed(suzanne)
    suzanne.active_shape_key_index = 0
    suzanne.show_only_shape_key = True
    other.value = 1.0
    assert not shows_keys(suzanne)  # the Basis is pinned


@pytest.mark.parametrize("how", ["value", "pin", "time"])
def test_shapes_are_shown_by_value_by_pin_or_in_time(suzanne, how):
    other = keyed(suzanne)
    assert not shows_keys(suzanne)
    if how == "value":
        other.value = 0.5
    elif how == "pin":
        suzanne.active_shape_key_index = 1
        suzanne.show_only_shape_key = True
    else:
        suzanne.data.shape_keys.use_relative = False
    assert shows_keys(suzanne)
    if how != "time":  # where Blender does not ask for this
        other.mute = True
        assert not shows_keys(suzanne)


def test_non_uniform_scale_stretches_the_copy_alone(suzanne):
    unscaled = read_shape(suzanne)
    suzanne.scale = (1.0, 2.0, 3.0)
    suzanne.rotation_euler = (0.3, 0.2, 0.1)
    bpy.context.view_layer.update()
    scaled = read_shape(suzanne)
    factors = np.array([1, 2, 3]) / 6 ** (1 / 3)  # they keep the volume
    assert np.allclose(scaled.vertices, unscaled.vertices * factors, rtol=1e-5)
    suzanne.scale = (1.0, 1.0, 1.0)
    bpy.context.view_layer.update()
    assert (read_shape(suzanne).vertices == unscaled.vertices).all()


@pytest.mark.parametrize("scale", [5.0, -5.0, 0.001])
def test_uniform_scale_and_rotation_change_nothing(suzanne, scale):
    before = read_shape(suzanne)
    suzanne.scale = (scale, scale, scale)
    suzanne.rotation_euler = (1.0, 2.0, 3.0)
    suzanne.location = (10.0, 20.0, 30.0)
    bpy.context.view_layer.update()
    after = read_shape(suzanne)
    assert (after.vertices == before.vertices).all()
    assert (after.triangles == before.triangles).all()


def test_mirroring_keeps_normals_outward():
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    cube.scale = (1.0, -2.0, 1.0)
    bpy.context.view_layer.update()
    mesh = read_shape(cube)
    centers = mesh.vertices[mesh.triangles].mean(axis=1)
    assert ((normals(mesh) * centers).sum(axis=1) > 0).all()


@pytest.mark.parametrize("scale", [(1.0, 0.0, 1.0), (1e-30, 1e-30, 1e-30)])
def test_a_scale_of_zero_is_refused(suzanne, scale):
    suzanne.scale = scale
    bpy.context.view_layer.update()
    with pytest.raises(DecompositionError, match="axis, or too near to it"):
        read_shape(suzanne)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("location", np.nan),
        ("rotation_euler", np.nan),
        ("scale", np.nan),
        ("location", np.inf),  # Blender writes another number than infinity
        ("scale", 1e30),  # its square is infinite
    ],
)
def test_a_place_that_is_no_number_is_refused(suzanne, name, value):
    getattr(suzanne, name)[0] = value
    bpy.context.view_layer.update()
    with pytest.raises(DecompositionError, match="location, rotation or scale, or"):
        read_shape(suzanne)


@pytest.mark.parametrize("x", [np.nan, np.inf])
def test_a_vertex_without_a_place_is_refused(suzanne, x):
    suzanne.data.vertices[3].co.x = x  # Blender writes another number than infinity
    with pytest.raises(DecompositionError, match="are not finite numbers"):
        read_shape(suzanne)


def test_a_scale_that_is_nearly_uniform_is_nearly_one_that_is(suzanne):
    suzanne.scale = 0.01, 0.01, 0.01
    bpy.context.view_layer.update()
    before, unit = read_shape(suzanne), scene_unit(suzanne)
    suzanne.scale = 0.01, 0.01, 0.0101
    bpy.context.view_layer.update()
    assert read_shape(suzanne).vertices == pytest.approx(before.vertices, abs=0.01)
    assert scene_unit(suzanne) == pytest.approx(unit, rel=0.01)


def test_edit_mode_changes_are_read():
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    assert len(read_shape(cube).triangles) == 12
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    mesh = read_shape(cube)
    assert mesh.n_polygons == 24
    assert len(mesh.triangles) == 48
    assert cube.mode == "EDIT"


@pytest.mark.parametrize("change", ["move", "subdivide", "delete"])
def test_the_mesh_may_change_once_it_is_read(suzanne, change):
    before = read_shape(suzanne)
    known.forget()
    steps = shape_in_steps(suzanne)
    if change == "move":
        for vertex in suzanne.data.vertices:
            vertex.co.z *= 2
        suzanne.data.update()
    elif change == "subdivide":
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.subdivide()
        bpy.ops.object.mode_set(mode="OBJECT")
    else:
        bpy.data.meshes.remove(suzanne.data)
    after = run(steps)
    for name in ("vertices", "triangles", "polygons"):
        assert np.array_equal(getattr(after, name), getattr(before, name))


def test_bad_meshes_are_refused_before_any_step():
    bpy.ops.mesh.primitive_circle_add()  # edges only
    with pytest.raises(DecompositionError, match="no faces"):
        shape_in_steps(bpy.context.active_object)


def test_reading_leaves_the_mesh_as_it_is(suzanne):
    from snapshot import snapshot

    before = snapshot(suzanne)
    read_shape(suzanne)
    assert snapshot(suzanne) == before


def test_bad_meshes_are_refused_with_a_sentence():
    empty = mesh_object("empty", [(0, 0, 0), (1, 0, 0)], [])
    with pytest.raises(DecompositionError, match="no faces"):
        read_shape(empty)
    for bad in (np.nan, np.inf):
        broken = mesh_object("b", [(0, 0, bad), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
        activate(broken)
        with pytest.raises(DecompositionError, match="not finite"):
            read_shape(broken)


@pytest.mark.parametrize("bent", [False, True])
def test_arrays_are_cut_into_the_triangles_of_the_object(suzanne, bent):
    """Some of her quads are bent so much that it matters between which corners."""
    mesh, rng = suzanne.data, np.random.default_rng(0)
    for vertex in mesh.vertices if bent else ():
        vertex.co += Vector(rng.normal(0, 0.2, 3))
    places = [tuple(vertex.co) for vertex in mesh.vertices]
    faces = [tuple(polygon.vertices) for polygon in mesh.polygons]
    given, read = shape_of(places, faces), read_shape(suzanne)
    assert given.triangles.tolist() == read.triangles.tolist()
    assert given.polygons.tolist() == read.polygons.tolist()
