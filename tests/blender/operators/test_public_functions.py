"""The public functions with Blender's objects, beside the operators."""

import json
import re

import bpy
import numpy as np
import pytest
import weak_convex_decomposition as wcd
from conftest import ROOT
from weak_convex_decomposition.operators.bridge.parts.read import part_labels


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
    recorded = json.loads(suzanne["wcd"])
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.wcd.measure_selection(samples=100)
    recorded |= json.loads(suzanne["wcd"])
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
