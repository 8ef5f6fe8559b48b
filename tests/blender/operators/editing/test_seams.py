"""Seams marked where parts meet, and taken back."""

import bpy
import pytest
from hand_made import decompose_by_hand, in_mode
from snapshot import snapshot

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


@pytest.fixture
def parted(suzanne):
    decompose_by_hand(suzanne, 4)
    return suzanne


def seams(obj):
    """Return the numbers of the edges that are seams."""
    mode = obj.mode
    in_mode(obj, "OBJECT")
    found = {edge.index for edge in obj.data.edges if edge.use_seam}
    in_mode(obj, mode)
    return found


@MODES
def test_seams_of_all_parts_are_marked_and_taken_back_but_for_the_users(parted, mode):
    bpy.ops.wcd.mark_seams()
    between = seams(parted)
    bpy.ops.wcd.unmark_seams()
    assert seams(parted) == set()
    own = {min(between), *range(5)}
    for index in own:
        parted.data.edges[index].use_seam = True
    in_mode(parted, mode)
    assert not bpy.ops.wcd.unmark_seams.poll()
    bpy.ops.wcd.mark_seams()
    assert seams(parted) == between | own
    bpy.ops.wcd.unmark_seams()
    assert seams(parted) == own
    assert parted.mode == mode


@MODES
def test_other_parts_have_their_seams_in_place_of_the_former_ones(parted, mode):
    in_mode(parted, mode)
    bpy.ops.wcd.mark_seams()
    before = seams(parted)
    for row in (1, 2):
        parted.wcd_parts[row].chosen = True
    bpy.ops.wcd.merge_parts()
    bpy.ops.wcd.mark_seams()
    assert seams(parted) < before
    bpy.ops.wcd.unmark_seams()
    assert seams(parted) == set()


@MODES
def test_clear_takes_the_seams_back_and_leaves_nothing(suzanne, mode):
    before = snapshot(suzanne)
    decompose_by_hand(suzanne, 4)
    in_mode(suzanne, mode)
    bpy.ops.wcd.mark_seams()
    bpy.ops.wcd.clear()
    assert seams(suzanne) == set()
    in_mode(suzanne, "OBJECT")
    names = {each.name for each in suzanne.data.attributes}
    assert not [name for name in names if "wcd" in name]
    if mode == "OBJECT":
        assert snapshot(suzanne) == before


def test_subdivided_edges_are_taken_back_too(parted):
    bpy.ops.wcd.mark_seams()
    in_mode(parted, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide()
    assert bpy.ops.wcd.unmark_seams() == {"FINISHED"}
    assert seams(parted) == set()


def test_an_attribute_of_the_users_is_not_written_to(parted):
    parted.data.attributes.new("wcd_seam", "FLOAT", "POINT")
    before = snapshot(parted)
    with pytest.raises(RuntimeError, match="wcd_seam that this add-on did not write"):
        bpy.ops.wcd.mark_seams()
    assert snapshot(parted) == before
