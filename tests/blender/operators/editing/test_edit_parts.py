"""Parts changed by hand: what each button changes, and what stays."""

import bpy
import numpy as np
import pytest
from edited import FAST, check_in_step, labels_of, parts_of, record_of
from hand_made import (
    decomposition_of,
    in_mode,
)
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.mesh.selection import select_faces
from weak_convex_decomposition.operators.bridge.parts.present_parts import present_parts
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.operators.bridge.work import locking

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


@MODES
def test_merged_parts_are_one_and_the_others_stay(monkey, mode):
    before, labels, record = parts_of(monkey), labels_of(monkey), record_of(monkey)
    in_mode(monkey, mode)
    assert bpy.ops.wcd.merge_parts() == {"FINISHED"}
    assert monkey.mode == mode
    assert parts_of(monkey) == [before[0], before[1], before[3]]
    assert (labels_of(monkey) == np.array([0, 1, 1, 2])[labels]).all()
    ranks = [part["convexity_rank"] for part in record["parts"]]
    merged = [part["convexity_rank"] for part in record_of(monkey)["parts"]]
    assert merged[1] != ranks[1]
    assert record_of(monkey)["parameters"] == record["parameters"]
    check_in_step(monkey)


@MODES
def test_a_split_leaves_the_other_parts_alone(monkey, mode):
    before, labels = parts_of(monkey), labels_of(monkey)
    monkey.wcd_parts[2].chosen = False
    in_mode(monkey, mode)
    assert bpy.ops.wcd.split_parts(parts=3) == {"FINISHED"}
    assert monkey.mode == mode
    now = labels_of(monkey)
    assert (now[labels != 1] == labels[labels != 1]).all()
    assert set(now[labels == 1]) == {1, 4, 5}
    assert parts_of(monkey)[:4] == before
    assert [name for name, _, _ in parts_of(monkey)[4:]] == ["Part 05", "Part 06"]
    check_in_step(monkey)


def test_numbers_and_colors_that_became_free_are_used_again(monkey):
    colors = [material.diffuse_color[:] for material in monkey.data.materials]
    bpy.ops.wcd.merge_parts()  # the third goes
    bpy.ops.wcd.split_parts(parts=2)
    assert [number for _, number, _ in parts_of(monkey)] == [0, 1, 2, 3]
    assert [material.diffuse_color[:] for material in monkey.data.materials] == colors
    check_in_step(monkey)


def test_selected_faces_go_to_the_highlighted_part(monkey):
    labels = labels_of(monkey)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    chosen = labels >= 2
    chosen[::3] = False
    select_faces(monkey, chosen, extend=False)
    in_mode(monkey, "EDIT")
    assert bpy.ops.wcd.assign_faces() == {"FINISHED"}
    assert monkey.mode == "EDIT"
    assert (labels_of(monkey) == np.where(chosen, 1, labels)).all()
    check_in_step(monkey)


def test_a_part_all_of_whose_faces_are_given_away_is_gone(monkey):
    in_mode(monkey, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.wcd.assign_faces()
    assert [name for name, _, _ in parts_of(monkey)] == ["Part 02"]
    check_in_step(monkey)


@pytest.mark.parametrize("direction", ["TO_NEGATIVE", "TO_POSITIVE"])
def test_mirrored_parts_are_symmetric_and_named_for_their_sides(monkey, direction):
    assert bpy.ops.wcd.mirror_parts(direction=direction) == {"FINISHED"}
    names = [name for name, _, _ in parts_of(monkey)]
    sided = {name[:-2] for name in names if name.endswith((".L", ".R"))}
    assert sided
    assert all({f"{name}.L", f"{name}.R"} <= set(names) for name in sided)
    centers = np.array([polygon.center for polygon in monkey.data.polygons])
    other = np.linalg.norm(
        centers[:, None] * [-1, 1, 1] - centers[None], axis=2
    ).argmin(axis=1)
    labels = np.array(names)[labels_of(monkey)]
    flipped = np.array([bpy.utils.flip_name(name) for name in labels])
    off = np.abs(centers[:, 0]) > 1e-4
    assert (labels[other] == flipped)[off].all()
    left = [name.endswith(".L") for name in labels]
    assert centers[left][:, 0].min() > 0
    check_in_step(monkey)
    again = parts_of(monkey)
    bpy.ops.wcd.mirror_parts(direction=direction)
    assert parts_of(monkey) == again


def ragged_grid(n=24):
    """Return a box of n × n quads above with a ragged seam along x = 0."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.active_object
    in_mode(obj, "EDIT")
    bpy.ops.mesh.subdivide(number_cuts=n)
    in_mode(obj, "OBJECT")
    rng = np.random.default_rng(0)
    x = np.array([polygon.center.x for polygon in obj.data.polygons])
    labels = (x + rng.uniform(-0.1, 0.1, len(x)) > 0).astype(int)
    labels += 2 * (x < -0.7)
    return obj, labels


def seam_length(obj, labels, chosen):
    """Return the number of edges between two parts."""
    sides = {}
    for polygon, label in zip(obj.data.polygons, labels, strict=True):
        for key in polygon.edge_keys:
            sides.setdefault(key, set()).add(int(label))
    return sum(found == chosen for found in sides.values())


def test_smoothed_seams_are_shorter_and_others_stay():
    obj, labels = ragged_grid()
    write_parts(obj, decomposition_of(labels), Parameters(**FAST))
    obj.wcd_active_part = 1
    assert bpy.ops.wcd.smooth_seams(scope="CHOSEN") == {"FINISHED"}
    smoothed = labels_of(obj)
    assert seam_length(obj, smoothed, {0, 1}) < 0.6 * seam_length(obj, labels, {0, 1})
    assert ((smoothed == 2) == (labels == 2)).all()
    assert (smoothed != labels).mean() < 0.1
    check_in_step(obj)


def test_smoothing_by_nothing_changes_nothing(monkey):
    labels = labels_of(monkey)
    bpy.ops.wcd.smooth_seams(scope="ALL", smoothness=0.0)
    assert (labels_of(monkey) == labels).all()


def test_smoothing_by_what_is_no_number_is_refused(monkey):
    labels = labels_of(monkey)
    with pytest.raises(RuntimeError, match="Smoothness must be a number, not nan"):
        bpy.ops.wcd.smooth_seams(scope="ALL", smoothness=float("nan"))
    assert (labels_of(monkey) == labels).all()


def test_colors_in_an_attribute_follow_edits(monkey):
    bpy.ops.wcd.decompose(**FAST)
    bpy.ops.wcd.color_attribute()
    n_parts = len(monkey.wcd_parts)
    bpy.ops.wcd.split_parts(parts=2)
    assert len(monkey.wcd_parts) > n_parts
    colors = monkey.data.attributes["wcd_color"].data
    for polygon, part in zip(monkey.data.polygons, labels_of(monkey), strict=True):
        expected = pytest.approx(tuple(monkey.wcd_parts[part].color[:3]), abs=1e-6)
        for corner in polygon.loop_indices:
            assert tuple(colors[corner].color[:3]) == expected


def test_the_most_and_fewest_parts_of_a_run_include_locked_ones(monkey):
    monkey.wcd_parts[0].locked = monkey.wcd_parts[3].locked = True
    parts, wanted = present_parts(monkey), Parameters(min_parts=5, max_parts=8)
    rest = locking._parameters_of_rest(wanted, parts, parts.locked)
    assert (rest.min_parts, rest.max_parts) == (3, 6)


def test_too_many_parts_are_told_beside_locked_ones_too(monkey):
    monkey.wcd_parts[0].locked = True
    bpy.ops.wcd.decompose(parts=90, samples=300)
    (note,) = record_of(monkey)["notes"]
    assert note.startswith(f"Only {len(monkey.wcd_parts)} of the 90 parts could")
    bpy.ops.wcd.decompose(parts=8, samples=300)
    assert record_of(monkey)["notes"] == []


def test_a_split_into_too_many_parts_is_told(monkey):
    chosen = [row.name for row in monkey.wcd_parts if row.chosen]
    bpy.ops.wcd.split_parts(parts=50)
    notes = record_of(monkey)["notes"]
    assert [note.partition(": Only ")[0] for note in notes] == chosen
    assert all(" of the 50 parts could be made" in note for note in notes)
