"""Other shapes for hulls that are not where their object's own space has them."""

import bmesh
import bpy
import numpy as np
import pytest
from edited import record_of
from hand_made import activate, in_scene
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.bridge.hulls.placed import primitive_of

BUILT = {"max_hulls": 1, "max_error": 1.0, "error_unit": "SCENE"}
PLACE = (3, -2, 1)


@pytest.fixture
def placed(suzanne):
    """Return an object with one hull, which has a place, a turn and a scale."""
    suzanne.location, suzanne.rotation_euler = PLACE, (0.3, 0.5, 1)
    suzanne.scale = (2, 1, 1)
    bpy.context.view_layer.update()
    bpy.ops.wcd.build_hulls(**BUILT)
    return suzanne


def refit(obj, shape):
    """Give the hull of an object another shape; return its corners and its error."""
    (hull,) = hulls_of(obj)
    assert bpy.ops.wcd.refit_hull(hull=hull.name, shape=shape) == {"FINISHED"}
    bpy.context.view_layer.update()
    (noted,) = record_of(obj)["hulls"]["hulls"]
    return corners_of(hull), noted["error"]


def corners_of(hull):
    bpy.context.view_layer.update()
    return in_scene(hull)


def distances(corners):
    """Return how far corners are from the mirror plane's point; boxes come mirrored."""
    lengths = np.linalg.norm(corners - PLACE, axis=1)
    return [lengths.min(), lengths.max()]


def sides(corners):
    return np.ptp(corners, axis=0)


@pytest.mark.parametrize("shape", ["SPHERE", "BOX", "HULL"])
@pytest.mark.parametrize("applied", ["scale", "location", "everything"])
@pytest.mark.parametrize("with_hulls", [False, True])
def test_shapes_are_right_after_a_transform_was_applied(
    placed, shape, applied, with_hulls
):
    corners, error = refit(placed, shape)
    if not with_hulls:
        bpy.ops.wcd.build_hulls(**BUILT)
    activate(placed)
    hulls_of(placed)[0].select_set(with_hulls)
    every = {"location": True, "rotation": True, "scale": True}
    chosen = {name: name == applied for name in every}
    bpy.ops.object.transform_apply(**(every if applied == "everything" else chosen))
    found, found_error = refit(placed, shape)
    assert distances(found) == pytest.approx(distances(corners), rel=0.02)
    assert found_error == pytest.approx(error, rel=0.02)


def test_a_hull_that_the_user_moved_keeps_its_place_and_states_its_error(placed):
    _, near = refit(placed, "BOX")
    (hull,) = hulls_of(placed)
    hull.location.x += 3.0
    lamp = bpy.data.objects.new("Lamp", None)
    bpy.context.collection.objects.link(lamp)
    lamp.parent, lamp.location = hull, (0, 1, 0)
    before = corners_of(hull)
    place = np.array(lamp.matrix_world)
    for _ in range(2):
        found, error = refit(placed, "BOX")
        assert sides(found) == pytest.approx(sides(before), rel=1e-3)
        assert found.mean(axis=0) == pytest.approx(before.mean(axis=0), abs=1e-3)
        assert error > near + 1.0
    assert np.array(lamp.matrix_world) == pytest.approx(place, abs=1e-5)


def bounds_in_time(hull):
    """Return the bounding box of a hull in the scene at three frames."""
    boxes = []
    for frame in (1, 6, 11):
        bpy.context.scene.frame_set(frame)
        corners = corners_of(hull)
        boxes.append((corners.min(axis=0), corners.max(axis=0)))
    return np.array(boxes)


@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1.5, 1)])
def test_a_hull_that_is_animated_moves_as_before(placed, scale):
    (hull,) = hulls_of(placed)
    hull.rotation_euler, hull.scale = (0, 0.5, 1), scale
    for frame in (1, 11):
        hull.location.x = frame
        hull.keyframe_insert("location", frame=frame)
    before = bounds_in_time(hull)
    for shape, frame in (("SPHERE", 6), ("HULL", 1)):
        bpy.context.scene.frame_set(frame)
        refit(placed, shape)
    assert bounds_in_time(hull) == pytest.approx(before, abs=1e-3)


def test_a_sphere_of_a_mirrored_hull_is_noted_where_it_is_and_faces_outward(placed):
    (hull,) = hulls_of(placed)
    hull.location, hull.rotation_euler, hull.scale = (1, 2, 0), (0, 0.5, 1), (-2, 1, 1)
    corners, _ = refit(placed, "SPHERE")
    found = primitive_of(hull, np.array(hull.matrix_world))
    assert found.kind == "SPHERE"
    away = np.linalg.norm(corners - found.center, axis=1)
    assert away == pytest.approx(found.sizes[0], rel=1e-3)
    mesh = bmesh.new()
    mesh.from_mesh(hull.data)
    assert mesh.calc_volume(signed=True) > 0
    mesh.free()


def test_a_hull_without_size_gets_no_other_shape(placed):
    (hull,) = hulls_of(placed)
    hull.scale.x = 0
    with pytest.raises(RuntimeError, match="hull 01 has a scale of zero; change that"):
        refit(placed, "BOX")


@pytest.mark.parametrize("how", ["emptied", "not a number"])
def test_a_hull_that_the_user_spoiled_gets_no_other_shape(placed, how):
    (hull,) = hulls_of(placed)
    if how == "emptied":
        hull.data.clear_geometry()
    else:
        hull.data.vertices[0].co.x = np.nan
    with pytest.raises(RuntimeError, match="hull 01 has no vertices, or coordinates"):
        refit(placed, "BOX")


def test_the_volume_ratio_is_right_after_the_scale_was_applied(suzanne):
    suzanne.scale = (3, 3, 3)
    bpy.context.view_layer.update()
    bpy.ops.wcd.build_hulls(max_hulls=3, max_error=0.2)
    names = [hull.name for hull in hulls_of(suzanne)]
    for hull in hulls_of(suzanne):
        hull.select_set(True)
    bpy.ops.object.transform_apply(location=False, rotation=False)
    before = record_of(suzanne)["hulls"]["volume_ratio"]
    for shape in ("BOX", "HULL"):
        for name in names[:2]:
            bpy.ops.wcd.refit_hull(hull=name, shape=shape)
        assert (record_of(suzanne)["hulls"]["volume_ratio"] > before) == (
            shape == "BOX"
        )
    after = record_of(suzanne)["hulls"]["volume_ratio"]
    assert after == pytest.approx(before, rel=1e-3)
