"""Joined objects, by materials and by overlays: whose faces and names there are."""

import bpy
import pytest
from edited import check_in_step, record_of
from hand_made import activate, decompose_by_hand
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.parts.read import part_identities


def show(choice):
    assert bpy.ops.wcd.show_colors(colors=choice) == {"FINISHED"}


def cube_beside(suzanne, colors):
    """Give the monkey two parts, one called Head; return a cube beside it."""
    decompose_by_hand(suzanne, 2)
    show(colors)
    suzanne.wcd_parts[0].name = "Head"
    bpy.ops.mesh.primitive_cube_add(location=(4, 0, 0))
    return bpy.context.active_object


@pytest.mark.parametrize("own", ["OVERLAY", "MATERIALS"])
@pytest.mark.parametrize("joined", ["OVERLAY", "MATERIALS"])
def test_joined_parts_keep_their_names(suzanne, own, joined):
    cube = cube_beside(suzanne, own)
    decompose_by_hand(cube, 3)
    show(joined)
    for row, name in zip(cube.wcd_parts, ("Lid", "Box", "Foot"), strict=True):
        row.name = name
    activate(suzanne)
    cube.select_set(True)
    bpy.ops.object.join()
    names = {"Head", "Part 02", "Lid", "Box", "Foot"}
    assert {each.name for each in part_identities(suzanne)} == names
    bpy.ops.wcd.refresh_parts()
    faces = {each["name"]: each["faces"] for each in record_of(suzanne)["parts"]}
    assert faces == {"Head": 250, "Part 02": 250, "Lid": 2, "Box": 2, "Foot": 2}
    check_in_step(suzanne)


@pytest.mark.parametrize("colors", ["OVERLAY", "MATERIALS"])
@pytest.mark.parametrize("active", [0, 1])
def test_a_joined_object_without_parts_is_a_part_of_its_own(suzanne, colors, active):
    cube = cube_beside(suzanne, colors)
    # Blender 4.2 gives its faces the material of part 1 if they have none.
    cube.data.materials.append(bpy.data.materials.new("Mine"))
    obj = (suzanne, cube)[active]
    activate(obj)
    for each in (suzanne, cube):
        each.select_set(True)
    bpy.ops.object.join()
    figures = figures_of(obj)
    names = [each.name for each in figures.identities]
    assert names == ["Head", "Part 02", "Part 01"]
    assert figures.measured_on[:, 0].tolist() == [250, 250, 6]
    assert "after a join" in figures.problem
    bpy.ops.wcd.refresh_parts()
    check_in_step(obj)
    assert [each["name"] for each in record_of(obj)["parts"]] == names


def test_own_materials_on_faces_of_a_part_are_no_join(suzanne):
    decompose_by_hand(suzanne, 2)
    suzanne.data.materials.append(bpy.data.materials.new("Mine"))
    for polygon in suzanne.data.polygons[:100]:
        polygon.material_index = 2
    figures = figures_of(suzanne)
    assert figures.problem is None
    assert len(figures.identities) == 2


def test_a_part_that_only_a_joined_copy_had_is_shown_as_material(suzanne):
    decompose_by_hand(suzanne, 2)
    show("OVERLAY")
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    activate(suzanne)
    decompose_by_hand(suzanne, 3)
    activate(copy)
    suzanne.select_set(True)
    bpy.ops.object.join()
    show("MATERIALS")
    assert len(part_identities(copy)) == 3
    assert len({copy.data.materials[p.material_index] for p in copy.data.polygons}) == 3
    check_in_step(copy)
    bpy.ops.wcd.clear()
    assert not copy.vertex_groups


@pytest.mark.parametrize("colors", ["OVERLAY", "MATERIALS"])
def test_clear_leaves_a_group_that_was_called_like_a_joined_part(suzanne, colors):
    suzanne.vertex_groups.new(name="Lid").add([0, 1], 0.5, "REPLACE")
    cube = cube_beside(suzanne, colors)
    decompose_by_hand(cube, 2)
    show(colors)
    cube.wcd_parts[0].name = "Lid"
    activate(suzanne)
    cube.select_set(True)
    bpy.ops.object.join()
    bpy.ops.wcd.clear()
    assert [group.name for group in suzanne.vertex_groups] == ["Lid"]
    assert suzanne.vertex_groups["Lid"].weight(0) == 0.5
