"""The public functions with Blender's objects, beside the operators."""

import re

import bpy
import numpy as np
import pytest
import weak_convex_decomposition as wcd
from conftest import ROOT
from edited import record_of
from weak_convex_decomposition.operators.bridge.parts.read import part_labels
from weak_convex_decomposition.operators.bridge.read.place import place_now


def test_an_object_gets_the_parts_that_the_operator_gives_it(suzanne):
    found = wcd.decompose(suzanne, samples=300)
    assert "wcd" not in suzanne
    bpy.ops.wcd.decompose(samples=300)
    pairs = set(zip(found.labels.tolist(), part_labels(suzanne).tolist(), strict=True))
    assert len(pairs) == found.n_parts == len(suzanne.wcd_parts)


def test_the_manual_tells_of_all_that_is_recorded(suzanne):
    bpy.ops.wcd.decompose(samples=100)
    bpy.ops.wcd.measure(samples=100)
    bpy.ops.wcd.build_hulls(max_hulls=1)
    recorded = record_of(suzanne)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.wcd.measure_selection(samples=100)
    recorded |= record_of(suzanne)
    manual = (ROOT / "docs" / "scripts.md").read_text(encoding="utf-8")
    table = manual.partition("| key | holds |\n|---|---|\n")[2].partition("\n\n")[0]
    first_cells = [row.split("|")[1] for row in table.splitlines()]
    told = {key for cell in first_cells for key in re.findall(r"`(\w+)`", cell)}
    assert told == recorded.keys() | {"rough"}


def test_hulls_and_ranks_of_an_object(suzanne):
    assert 0 < wcd.measure(suzanne, samples=300).rank < 1
    assert wcd.build_hulls(suzanne, max_hulls=4).n_hulls == 4


def test_a_curve_is_filled(suzanne):
    bpy.ops.curve.primitive_bezier_circle_add()
    assert wcd.measure(bpy.context.object, samples=100).rank > 0.9


@pytest.mark.parametrize(
    ("data", "kind"),
    [(lambda obj: obj.data, "Mesh"), (lambda obj: bpy.context, "Context")],
)
def test_other_data_of_blender_is_refused(suzanne, data, kind):
    with pytest.raises(TypeError, match=f"cannot be a {kind} of Blender; pass the obj"):
        wcd.decompose(data(suzanne))


def test_objects_without_a_surface_are_refused():
    bpy.ops.object.light_add()
    with pytest.raises(
        wcd.DecompositionError, match="Point is not a mesh; pass a mesh"
    ):
        wcd.measure(bpy.context.object)


def test_faces_beside_an_object_are_refused(suzanne):
    with pytest.raises(TypeError, match="is a shape already; leave out `faces`"):
        wcd.decompose(suzanne, [[0, 1, 2]])


def test_removed_objects_are_refused(suzanne):
    bpy.data.objects.remove(suzanne)
    with pytest.raises(wcd.DecompositionError, match=r"has been removed .*\.$"):
        wcd.decompose(suzanne)


def test_the_function_that_returns_parts_says_who_cuts_faces(suzanne):
    with pytest.raises(wcd.DecompositionError, match="or the command line"):
        wcd.decompose(suzanne, seams="CUT")


def test_a_stretch_leads_back_to_the_space_of_the_object():
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.object
    cube.scale = (1, 1, 8)
    bpy.context.view_layer.update()
    stretch = wcd.stretch(cube)
    assert stretch == pytest.approx(np.diag([0.5, 0.5, 4]))
    (shape,) = wcd.build_hulls(cube).shapes
    corners = shape.hull.vertices @ np.linalg.inv(stretch)
    assert np.unique(corners.round(6)).tolist() == [-1, 1]
    areas = wcd.decompose(cube).areas
    assert areas == pytest.approx([2 * 1 + 4 * 8])  # of a box of 1 by 1 by 8
    assert (wcd.stretch(corners) == np.eye(3)).all()


def scaled(obj, to):
    """Give an object a scale, and let Blender not know by now."""
    obj.scale = to
    return obj


def test_a_scale_counts_before_blender_updates_the_scene(suzanne):
    before = wcd.build_hulls(suzanne, max_hulls=1).half_side
    stretch = wcd.stretch(scaled(suzanne, (1, 1, 8)))
    assert stretch == pytest.approx(np.diag([0.5, 0.5, 4]))
    hulls = wcd.build_hulls(suzanne, max_hulls=1)
    assert suzanne.matrix_world.to_scale().z == 1  # nothing was updated
    bpy.context.view_layer.update()
    assert (wcd.stretch(suzanne) == stretch).all()
    assert wcd.build_hulls(suzanne, max_hulls=1).half_side == hulls.half_side > before


@pytest.mark.parametrize("linked", [True, False])
def test_a_scale_counts_in_another_scene_and_in_none(suzanne, linked):
    other = bpy.data.objects.new("Other", suzanne.data)
    if linked:
        bpy.data.scenes.new("Other").collection.objects.link(other)
    assert wcd.stretch(scaled(other, (1, 1, 8)))[2, 2] == pytest.approx(4)
    with pytest.raises(wcd.DecompositionError, match="scale is zero along an axis"):
        wcd.decompose(scaled(other, (0, 1, 1)))
    with pytest.raises(wcd.DecompositionError, match="is not a number"):
        wcd.decompose(scaled(other, (float("nan"), 1, 1)))


def test_an_infinite_place_is_refused_before_and_after_an_update(suzanne):
    suzanne.parent = scaled(bpy.data.objects.new("Parent", None), [1e30] * 3)
    scaled(suzanne, [1e30] * 3)
    for _ in range(2):
        with pytest.raises(wcd.DecompositionError, match="is not a number"):
            wcd.stretch(suzanne)
        bpy.context.view_layer.update()


def test_a_parent_shears_before_blender_updates_the_scene(suzanne):
    parent = bpy.data.objects.new("Parent", None)
    bpy.context.collection.objects.link(parent)
    suzanne.parent = scaled(parent, (1, 2, 8))
    suzanne.delta_scale = (1, 3, 1)
    suzanne.matrix_parent_inverse.col[3].x = 5
    suzanne.rotation_euler = (0.5, 0.25, 1)
    now = wcd.stretch(suzanne)
    assert np.count_nonzero(now) == 9
    bpy.context.view_layer.update()
    assert now == pytest.approx(wcd.stretch(suzanne), rel=1e-5)


def test_what_constraints_do_counts_as_of_the_last_update(suzanne):
    limit = suzanne.constraints.new("LIMIT_SCALE")
    limit.use_max_z, limit.max_z = True, 1
    scaled(suzanne, (1, 1, 8))
    bpy.context.view_layer.update()
    assert (wcd.stretch(suzanne) == np.eye(3)).all()
    limit.mute = True
    assert wcd.stretch(suzanne)[2, 2] == pytest.approx(4)


@pytest.mark.parametrize("kind", ["BONE", "VERTEX", "VERTEX_3", "CURVE"])
def test_bones_vertices_and_paths_place_as_of_the_last_update(suzanne, kind):
    {
        "BONE": bpy.ops.object.armature_add,
        "CURVE": bpy.ops.curve.primitive_nurbs_path_add,
    }.get(kind, bpy.ops.mesh.primitive_cube_add)()
    parent = scaled(bpy.context.object, (1, 1, 8))
    suzanne.parent = parent
    if kind != "CURVE":
        suzanne.parent_type = kind
    if kind == "BONE":
        suzanne.parent_bone = parent.data.bones[0].name
    suzanne.parent_vertices = (0, 1, 2)
    suzanne.rotation_euler = (0.5, 0.25, 1)
    bpy.context.view_layer.update()
    known = suzanne.matrix_world.copy()
    assert place_now(suzanne) == known
    suzanne.parent = None
    assert place_now(suzanne) != known


def test_reading_calls_no_handler_and_works_in_one(suzanne):
    calls = []

    def read(*_):
        calls.append(wcd.stretch(suzanne)[2, 2])

    bpy.app.handlers.depsgraph_update_post.append(read)
    wcd.stretch(scaled(suzanne, (1, 1, 8)))
    assert calls == []
    bpy.context.view_layer.update()
    bpy.app.handlers.depsgraph_update_post.remove(read)
    assert calls == pytest.approx([4])
