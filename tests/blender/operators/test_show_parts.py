"""Faces of parts selected and hidden, and their boundaries, in both modes."""

import bpy
import numpy as np
import pytest
from hand_made import decompose_by_hand, in_mode
from snapshot import snapshot
from weak_convex_decomposition.operators.viewport.viewports import points_of_parts

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


@pytest.fixture
def labels(suzanne):
    """Four bands along x, the second highlighted."""
    labels = decompose_by_hand(suzanne, 4)
    suzanne.wcd_active_part = 1
    return labels


def flags(obj, elements, name="select"):
    """Return a flag of the mesh's elements, as Object Mode has it."""
    in_mode(obj, "OBJECT")
    return np.array([getattr(each, name) for each in getattr(obj.data, elements)])


def boundary(obj, labels, of=None):
    """Return which edges have two labels at them, one of them `of`."""
    sides = [set() for _ in obj.data.edges]
    for polygon, label in zip(obj.data.polygons, labels, strict=True):
        for loop in polygon.loop_indices:
            sides[obj.data.loops[loop].edge_index].add(int(label))
    return np.array([len(s) > 1 and (of is None or of in s) for s in sides])


@MODES
def test_the_faces_of_the_chosen_parts_are_selected(suzanne, labels, mode):
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    in_mode(suzanne, mode)
    assert bpy.ops.wcd.select_parts() == {"FINISHED"}
    assert suzanne.mode == mode
    assert (flags(suzanne, "polygons") == (labels == 1)).all()
    in_mode(suzanne, mode)
    suzanne.wcd_parts[3].chosen = True
    bpy.ops.wcd.select_parts(extend=True)
    in_mode(suzanne, "EDIT")
    assert (flags(suzanne, "polygons") == np.isin(labels, [1, 3])).all()


@MODES
def test_boundaries_are_selected_and_marked(suzanne, labels, mode):
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    suzanne.data.edges[0].use_seam = True
    in_mode(suzanne, mode)
    bpy.ops.wcd.select_boundary(scope="CHOSEN")
    assert (flags(suzanne, "edges") == boundary(suzanne, labels, of=1)).all()
    in_mode(suzanne, mode)
    bpy.ops.wcd.mark_seams(scope="ALL")
    assert suzanne.mode == mode
    expected = boundary(suzanne, labels)
    expected[0] = True  # the user's own stays
    assert (flags(suzanne, "edges", "use_seam") == expected).all()


def test_other_parts_are_hidden_and_shown_again(suzanne, labels):
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts()
    assert (flags(suzanne, "polygons", "hide") == (labels != 1)).all()
    in_mode(suzanne, "EDIT")
    suzanne.wcd_active_part = 2
    bpy.ops.wcd.isolate_parts()
    assert (flags(suzanne, "polygons", "hide") == (labels != 2)).all()
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts(hide=False)
    assert not flags(suzanne, "polygons", "hide").any()


def test_faces_that_the_user_hid_stay_hidden(suzanne, labels):
    own = np.flatnonzero(labels == 1)[:5]
    for row in own:
        suzanne.data.polygons[row].hide = True
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts()
    hidden = labels != 1
    hidden[own] = True
    assert (flags(suzanne, "polygons", "hide") == hidden).all()
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.isolate_parts(hide=False)
    for elements in ("polygons", "edges", "vertices"):
        assert not flags(suzanne, elements, "hide").any()


@pytest.mark.parametrize("name", ["select_parts", "select_boundary", "mark_seams"])
def test_showing_is_one_undo_step(suzanne, labels, name):
    before = snapshot(suzanne)
    bpy.ops.ed.undo_push(message="before")
    getattr(bpy.ops.wcd, name)("EXEC_DEFAULT", True)
    assert snapshot(bpy.context.active_object) != before
    bpy.ops.ed.undo()
    assert snapshot(bpy.context.active_object) == before


def test_a_part_is_framed_where_it_is_in_any_mode(suzanne, labels):
    expected = points_of_parts(suzanne, labels == 1)
    in_mode(suzanne, "EDIT")
    assert np.ptp(expected, axis=0).min() > 0.1
    assert (points_of_parts(suzanne, labels == 1) == expected).all()


def test_framing_needs_a_viewport(suzanne, labels):
    with pytest.raises(RuntimeError, match="no 3D viewport"):
        bpy.ops.wcd.frame_parts()
