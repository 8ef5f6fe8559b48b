"""Parts of a new run continue those before: names, colors, locks, groups, materials."""

import bpy
import numpy as np
import pytest
from edited import (
    FAST,
    check_in_step,
    faces_by_name,
    labels_of,
    needless_change,
    parts_of,
    record_of,
)
from hand_made import activate, in_mode, mesh_object
from mathutils import Matrix
from shapes import chair, comb, mug
from weak_convex_decomposition.operators.bridge.parts.palette import partner_color
from weak_convex_decomposition.operators.bridge.parts.read import part_identities
from weak_convex_decomposition.ui.sidebar import hull_rows_of

MODES = pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])


def colors_by_name(obj):
    """Return the colors of the parts that have faces."""
    names = {name for name, _, _ in parts_of(obj)}
    return {row.name: tuple(row.color) for row in obj.wcd_parts if row.name in names}


def settle(obj):
    """Name, color, lock and tick the parts of an object."""
    for n, row in enumerate(obj.wcd_parts):
        row.name = f"Named {n}"
        row.color = (0.1 * n, 0.5, 0.9)
    obj.wcd_parts[0].chosen = True


@MODES
@pytest.mark.parametrize("counts", [(3, 4), (5, 4), (4, 4)])
def test_the_chart_keeps_names_and_colors_on_most_of_the_area(suzanne, mode, counts):
    bpy.context.scene.wcd.samples = 200
    bpy.ops.wcd.decompose(samples=200, parts=counts[0])
    settle(suzanne)
    before, colors = faces_by_name(suzanne), colors_by_name(suzanne)
    in_mode(suzanne, mode)
    bpy.ops.wcd.choose_part_count(parts=counts[1])
    in_mode(suzanne, "OBJECT")
    after = faces_by_name(suzanne)
    assert needless_change(suzanne, before, after) < 1e-5
    now = colors_by_name(suzanne)
    kept = now.keys() & colors.keys()
    assert len(kept) == min(counts)
    assert all(now[name] == pytest.approx(colors[name]) for name in kept)
    assert len(set(now.values())) == len(now)
    assert [row.chosen for row in suzanne.wcd_parts if row.name == "Named 0"] == [True]
    check_in_step(suzanne)


@pytest.mark.parametrize("make", [None, chair, comb, mug])
def test_no_more_area_changes_name_or_color_than_must_from_3_to_12_parts(suzanne, make):
    obj = suzanne
    if make is not None:
        shape = make()
        obj = mesh_object("Shape", shape.vertices, shape.triangles.tolist())
        activate(obj)
    former = None
    for n_parts in range(3, 13):
        bpy.ops.wcd.decompose(samples=200, parts=n_parts)
        colors = {name: str(color) for name, color in colors_by_name(obj).items()}
        assert len(set(colors.values())) == len(colors) == n_parts
        names = faces_by_name(obj)
        now = names, np.array([colors[name] for name in names])
        for one, other in zip(former, now, strict=True) if former else ():
            assert needless_change(obj, one, other) <= 0.02
        former = now
    check_in_step(obj)


def test_live_keeps_identity(suzanne):
    settings = bpy.context.scene.wcd
    settings.samples, settings.parts = 200, 3
    bpy.ops.wcd.decompose(samples=200, parts=3)
    settle(suzanne)
    names = set(faces_by_name(suzanne))
    settings.live = True
    settings.parts = 5
    assert names < set(faces_by_name(suzanne))
    settings.parts = 3
    assert set(faces_by_name(suzanne)) == names
    check_in_step(suzanne)


def test_a_duplicate_keeps_identity_and_gets_materials_of_its_own(monkey):
    settle(monkey)
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    assert copy != monkey
    bpy.ops.wcd.decompose(**FAST, parts=4, keep_edits=False)
    assert {name for name, _, _ in parts_of(copy)} == {
        name for name, _, _ in parts_of(monkey)
    }
    assert not set(copy.data.materials) & set(monkey.data.materials)
    check_in_step(copy)
    check_in_step(monkey)


def test_a_recolored_part_of_a_duplicate_leaves_the_original_alone(monkey):
    before = [tuple(row.color) for row in monkey.wcd_parts]
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    copy.wcd_parts[1].color = (0.25, 0.5, 0.75)
    copy.wcd_parts[2].name = "Jaw"
    assert [tuple(row.color) for row in monkey.wcd_parts] == before
    assert tuple(copy.wcd_parts[1].color) == (0.25, 0.5, 0.75)
    check_in_step(copy)
    check_in_step(monkey)


def test_new_parts_get_names_and_colors_that_are_not_in_use(monkey):
    monkey.wcd_parts[1].name = "Part 05"
    bpy.ops.wcd.decompose(**{**FAST, "max_parts": 9}, parts=9)
    names = [name for name, _, _ in parts_of(monkey)]
    assert len(set(names)) == len(names) == 9
    assert {"Part 01", "Part 05", "Part 03", "Part 04"} <= set(names)
    assert len({tuple(part["color"]) for part in record_of(monkey)["parts"]}) == 9
    check_in_step(monkey)


def test_materials_have_the_names_of_parts_that_take_the_place_of_others(suzanne):
    for alpha in (2.0, 0.1, 2.0, 5.0):
        bpy.ops.wcd.decompose(**FAST, parts=3, alpha=alpha)
        materials = [material.name for material in suzanne.data.materials]
        assert materials == [row.name for row in suzanne.wcd_parts]


def test_mirror_images_are_pairs_by_name_and_color(suzanne):
    bpy.ops.wcd.decompose(samples=600, parts=5)
    names = {name for name, _, _ in parts_of(suzanne)}
    left = {name for name in names if name.endswith(".L")}
    assert left
    assert {bpy.utils.flip_name(name) for name in left} <= names
    x = np.array([polygon.center.x for polygon in suzanne.data.polygons])
    by_face, colors = faces_by_name(suzanne), colors_by_name(suzanne)
    for name in left:
        image = bpy.utils.flip_name(name)
        assert x[by_face == name].min() > 0 > x[by_face == image].max()
        assert colors[image] == pytest.approx(partner_color(colors[name]))
    plain = [n for n in names if not n.endswith((".L", ".R"))]
    assert all(
        x[by_face == name].min() < 0 < x[by_face == name].max() for name in plain
    )


def test_a_shape_symmetric_across_y_only_has_plain_names(suzanne):
    suzanne.data.transform(Matrix.Rotation(np.pi / 2, 4, "Z"))
    bpy.ops.wcd.decompose(samples=600, parts=5)
    assert not any("." in name for name, _, _ in parts_of(suzanne))


@MODES
def test_merged_and_split_parts_stay_in_the_next_run(monkey, mode):
    in_mode(monkey, mode)
    bpy.ops.wcd.merge_parts()
    merged = faces_by_name(monkey) == "Part 02"
    bpy.ops.wcd.decompose(**FAST, parts=3)
    assert (merged == (faces_by_name(monkey) == "Part 02")).all()
    bpy.ops.wcd.decompose(**FAST, parts=3, keep_edits=False)
    assert (merged != (faces_by_name(monkey) == "Part 02")).any()
    check_in_step(monkey)


def test_a_split_stays_in_the_next_run(monkey):
    monkey.wcd_parts[2].chosen = False
    bpy.ops.wcd.split_parts(parts=2)
    before = faces_by_name(monkey)
    bpy.ops.wcd.decompose(**FAST, parts=4)
    for name in ("Part 02", "Part 05"):
        assert ((before == name) == (faces_by_name(monkey) == name)).all()
    check_in_step(monkey)


def test_assigned_faces_stay_in_their_part_and_the_rest_is_cut_anew(suzanne):
    bpy.context.scene.wcd.samples = 200
    bpy.ops.wcd.decompose(samples=200, parts=3)
    names = [row.name for row in suzanne.wcd_parts]
    labels = labels_of(suzanne)
    given = np.flatnonzero(labels == 0)[:20]
    for polygon in suzanne.data.polygons:
        polygon.select = polygon.index in given
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    suzanne.wcd_active_part = 1
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.assign_faces()
    in_mode(suzanne, "OBJECT")
    for parts in (4, 3):
        bpy.ops.wcd.choose_part_count(parts=parts)
        assert (faces_by_name(suzanne)[given] == names[1]).all()
        check_in_step(suzanne)
    bpy.context.scene.wcd.keep_edits = False
    bpy.ops.wcd.choose_part_count(parts=4)
    bpy.ops.wcd.choose_part_count(parts=3)
    assert (labels_of(suzanne) == labels).all()


def test_an_error_says_that_edits_leave_nothing_to_decompose(monkey):
    for row in monkey.wcd_parts:
        row.chosen = True
    bpy.ops.wcd.split_parts(parts=2)
    with pytest.raises(RuntimeError, match=r"locked or edited by hand.*Keep Edits"):
        bpy.ops.wcd.decompose(**FAST)
    assert bpy.ops.wcd.decompose(**FAST, keep_edits=False) == {"FINISHED"}


def test_a_linked_duplicate_made_by_a_script_can_be_refreshed(monkey):
    twin = bpy.data.objects.new("twin", monkey.data)
    bpy.context.collection.objects.link(twin)
    assert part_identities(twin) == part_identities(monkey)
    activate(twin)
    bpy.ops.wcd.refresh_parts()
    check_in_step(twin)


def test_hulls_follow_colors_and_those_that_the_user_deleted_are_not_listed(monkey):
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    hulls = sorted(monkey.children, key=lambda hull: hull.name)
    first = next(h for h in hulls if monkey.data.materials[0] in h.data.materials[:])
    monkey.wcd_parts[0].color = (0.5, 0.25, 0.125)
    assert first.data.materials[:] == monkey.data.materials[:1]
    assert tuple(first.color[:3]) == (0.5, 0.25, 0.125)
    assert len(hull_rows_of(monkey)) == len(hulls) == 4
    bpy.data.objects.remove(hulls[0])
    assert len(hull_rows_of(monkey)) == 3
    bpy.ops.wcd.clear()
    assert not [o for o in bpy.data.objects if "wcd_hull" in o]


def test_materials_of_parts_whose_names_end_in_digits_are_ours_on_copies(suzanne):
    bpy.ops.wcd.decompose(**FAST, parts=3)
    suzanne.wcd_parts[1].name = "Leg.1"
    twin = suzanne.copy()
    twin.data = suzanne.data.copy()
    bpy.context.collection.objects.link(twin)
    activate(twin)
    bpy.ops.wcd.decompose(**FAST, parts=4)
    assert "Leg.002" in twin.data.materials  # what Blender makes of a second Leg.1
    check_in_step(twin)
    bpy.ops.wcd.clear()
    assert not twin.data.materials
    check_in_step(suzanne)
