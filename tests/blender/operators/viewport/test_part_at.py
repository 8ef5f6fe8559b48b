"""Which part a ray in the world meets first."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from hand_made import activate, decompose_by_hand, in_mode
from mathutils import Matrix, Vector
from stand_ins.presses import FRONT, seen, space_of_window
from weak_convex_decomposition.operators.viewport.part_at import make_tree, part_along
from weak_convex_decomposition.operators.viewport.viewports import ray_at, viewport_at


@pytest.fixture
def labels(suzanne):
    """Four bands along x."""
    return decompose_by_hand(suzanne, 4)


def expected(obj, labels, x, z=0.0):
    """Return the label of the face that a ray meets, by Blender's own ray cast."""
    hit, _, _, face = obj.ray_cast(Vector((x, -9.0, z)), FRONT)
    assert hit
    return labels[face]


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_the_part_in_front_is_found(window, suzanne, labels, mode):
    places = [-1.2, -0.1, 0.1, 1.2]
    wanted = [int(expected(suzanne, labels, x, 0.25)) for x in places]
    assert len(set(wanted)) == 4
    in_mode(suzanne, mode)
    assert [seen(x, 0.25) for x in places] == [(suzanne, number) for number in wanted]
    assert seen(5.0) is None


def test_modifiers_count(window, suzanne, labels):
    array = suzanne.modifiers.new("Array", "ARRAY")
    array.use_relative_offset, array.use_constant_offset = False, True
    array.constant_offset_displace = (4.0, 0.0, 0.0)
    suzanne.modifiers.new("Subdivision", "SUBSURF").levels = 2
    assert seen(4.1) == seen(0.1) == (suzanne, 2)


def test_what_hides_a_part_hides_it(window, suzanne, labels):
    assert seen(0.1) == (suzanne, 2)
    bpy.ops.mesh.primitive_cube_add(location=(0, -3, 0))
    cube = bpy.context.active_object
    assert seen(0.1) is None
    cube.display_type = "WIRE"
    assert seen(0.1) == (suzanne, 2)
    cube.display_type = "TEXTURED"
    cube.hide_set(True)
    assert seen(0.1) == (suzanne, 2)


@pytest.mark.parametrize("look", ["SOLID", "TRANSPARENT", "WIRE"])
def test_hulls_hide_no_part_that_they_are_around(window, suzanne, labels, look):
    bpy.ops.wcd.build_hulls(pieces="PARTS", look=look)
    assert len(suzanne.children) == 4
    hull = suzanne.children[0]
    bpy.context.view_layer.update()
    for _ in range(20):  # and however many there are
        copy = hull.copy()
        bpy.context.collection.objects.link(copy)
    assert seen(-1.2, 0.25) == (suzanne, 0)
    assert seen(0.1) == (suzanne, 2)


@pytest.mark.parametrize("distance", [9.0, 1000.0])  # as without perspective
def test_parts_that_touch_their_hulls_are_found(window, suzanne, labels, distance):
    suzanne.location = (0.5, 0, 0)  # and not where rays are exact
    suzanne.scale = (1, 1.5, 2)

    def found():
        space = space_of_window()
        bpy.context.view_layer.update()
        return [
            part_along(bpy.context, space, Vector((x, -distance, z)), FRONT)
            for x in np.linspace(-0.8, 1.8, 40)
            for z in np.linspace(-2, 2, 30)
        ]

    before = found()
    assert {None, (suzanne, 0), (suzanne, 3)} < set(before)
    bpy.ops.wcd.build_hulls(pieces="PARTS")
    assert found() == before


def test_another_object_than_the_active_one_is_found(window, suzanne, labels):
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    cube = bpy.context.active_object
    assert seen(4.0) is None
    decompose_by_hand(cube, 2)
    assert seen(4.0)[0] == cube
    assert seen(0.1)[0] == suzanne
    activate(cube)
    in_mode(cube, "EDIT")
    assert seen(4.0)[0] == cube
    assert seen(0.1) is None  # it is not edited


def test_hidden_faces_are_seen_through_in_edit_mode_only(window, suzanne, labels):
    suzanne.wcd_active_part = 0
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts()
    assert seen(0.1) is None
    assert seen(-1.2, 0.25) == (suzanne, 0)
    in_mode(suzanne, "OBJECT")
    assert seen(0.1) == (suzanne, 2)


def test_isolated_parts_alone_are_found(window, suzanne, labels):
    suzanne.wcd_active_part = 0
    bpy.ops.wcd.isolate_parts()
    assert seen(0.1) is None
    assert seen(-1.2, 0.25) == (suzanne, 0)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_a_clipping_region_leaves_parts_out(window, suzanne, labels, mode):
    bpy.ops.mesh.primitive_cube_add(location=(0.1, -3, 0.25), size=1)
    activate(suzanne)
    in_mode(suzanne, mode)
    view = space_of_window().region_3d
    view.use_clip_planes = True

    def seen_between(low, high, x=0.1, shift=0.0):
        planes = (0, 1, 0, -low), (0, -1, 0, high), (1, 0, 0, shift)
        view.clip_planes = [*planes, *[(0, 0, 0, 0)] * 3]
        return seen(x, 0.25)

    assert seen_between(-2, 5) == (suzanne, 2)  # the cube is before the region
    assert seen_between(-9, 5) == ((suzanne, 2) if mode == "EDIT" else None)
    assert seen_between(0.2, 5)[0] == suzanne  # from within
    assert seen_between(-2, -1.5) is None
    assert seen_between(3, 5) is None
    assert seen_between(-2, 5, shift=-1.0) is None
    space_of_window().shading.type = "MATERIAL"  # which leaves nothing out
    assert seen_between(3, 5, x=-1.2) == (suzanne, 0)


def test_the_mesh_is_read_again_when_it_changes(window, suzanne, labels):
    assert seen(0.1) == (suzanne, 2)
    decompose_by_hand(suzanne, 1)
    assert seen(0.1) == (suzanne, 0)
    for vertex in suzanne.data.vertices:
        vertex.co += Vector((50.0, 0.0, 0.0))
    suzanne.data.update()
    assert seen(0.1) is None
    assert seen(50.1) == (suzanne, 0)
    assert np.ptp(labels) == 3


def test_no_tree_of_what_is_hidden_or_gone_raises_an_error(window, suzanne, labels):
    make_tree()
    in_mode(suzanne, "EDIT")
    make_tree()
    in_mode(suzanne, "OBJECT")
    suzanne.hide_viewport = True
    make_tree()  # Blender has no mesh of it, and would raise
    bpy.ops.object.empty_add()
    make_tree()
    bpy.data.objects.remove(bpy.context.active_object)
    make_tree()


def test_no_viewport_is_there_whose_view_has_no_inverse():
    view = SimpleNamespace(
        perspective_matrix=Matrix(),
        view_matrix=Matrix(),
        view_perspective="PERSP",
        is_perspective=True,
    )
    region = SimpleNamespace(type="WINDOW", x=10, y=20, width=100, height=80, data=view)
    area = SimpleNamespace(type="VIEW_3D", regions=[region])
    window = SimpleNamespace(screen=SimpleNamespace(areas=[area]))
    context = SimpleNamespace(window=window)
    there = viewport_at(context, 15, 30)
    assert there == (region, 5, 10)
    ray_at(*there)
    view.perspective_matrix = Matrix.Diagonal((1, 1, 1, 0))  # as it is rounded
    with pytest.raises(ValueError, match="inverse"):
        ray_at(*there)
    assert viewport_at(context, 15, 30) is None


@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
def test_rays_of_a_view_through_a_camera_begin_before_what_it_shows(kind):
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.clip_start, camera.clip_end = kind, 0.5, 100.0
    obj = bpy.data.objects.new("Camera", camera)
    obj.location, obj.rotation_euler = (3, -12, 0), (np.pi / 2, 0, 0)
    bpy.context.scene.collection.objects.link(obj)
    graph = bpy.context.evaluated_depsgraph_get()
    lens = obj.calc_matrix_camera(graph, x=100, y=100)
    view_matrix = obj.matrix_world.inverted()
    view = SimpleNamespace(
        perspective_matrix=lens @ view_matrix,
        view_matrix=view_matrix,
        view_perspective="CAMERA",
        is_perspective=kind == "PERSP",
    )
    origin, towards = ray_at(SimpleNamespace(width=100, height=100, data=view), 50, 50)
    near = -11.5 if kind == "ORTHO" else -12.0
    assert np.allclose(origin, (3, near, 0), atol=1e-3)
    assert np.allclose(towards, (0, 1, 0), atol=1e-5)
