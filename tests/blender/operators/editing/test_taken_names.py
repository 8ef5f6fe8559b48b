"""What the user gives the names of parts to stays, and what is ours goes."""

import bpy
import pytest
from edited import FAST
from hand_made import activate, decompose_by_hand, in_mode
from weak_convex_decomposition.operators.bridge.parts.materials import is_ours
from weak_convex_decomposition.operators.bridge.stored.identity import has_name


def materials_of(obj):
    return [material and material.name for material in obj.data.materials]


def groups_of(obj):
    return [group.name for group in obj.vertex_groups]


def rename(material):
    material.name = "Hide"


def delete(material):
    bpy.data.materials.remove(material)


@pytest.mark.parametrize("recut", [False, True])
@pytest.mark.parametrize("change", [rename, delete])
def test_a_part_can_take_the_name_that_a_users_material_had(suzanne, change, recut):
    skin = bpy.data.materials.new("Skin")
    suzanne.data.materials.append(skin)
    decompose_by_hand(suzanne, 3, **FAST)
    change(skin)
    users = materials_of(suzanne)[0]
    suzanne.wcd_parts[0].name = "Skin"
    assert materials_of(suzanne) == [users, "Skin", "Part 02", "Part 03"]
    if recut:
        decompose_by_hand(suzanne, 2, **FAST)
        names = [row.name for row in suzanne.wcd_parts]
        assert materials_of(suzanne) == [users, *names]
    bpy.ops.wcd.clear()
    assert materials_of(suzanne) == [users]
    assert not [each for each in bpy.data.materials if each.name != users]


def test_materials_of_what_it_was_separated_from_stay(suzanne):
    decompose_by_hand(suzanne, 2, **FAST)
    piece = suzanne.copy()
    piece.data = bpy.data.meshes["Suzanne"].copy()
    bpy.context.collection.objects.link(piece)
    activate(piece)
    bpy.ops.wcd.clear()
    first = suzanne.data.materials[0]
    piece.data.materials.append(first)
    decompose_by_hand(piece, 3, **FAST)
    piece.wcd_parts[0].name = "Ear"
    bpy.ops.wcd.clear()
    assert piece.data.materials[:] == [first]


def test_a_material_of_ours_can_be_in_more_slots_than_one(suzanne):
    decompose_by_hand(suzanne, 4, **FAST)
    for material in suzanne.data.materials[:]:
        suzanne.data.materials.append(material)
    bpy.ops.wcd.decompose(parts=2, **{**FAST, "max_parts": 2})
    assert materials_of(suzanne) == [row.name for row in suzanne.wcd_parts]
    bpy.ops.wcd.clear()
    assert not suzanne.data.materials
    assert not [each for each in bpy.data.materials if is_ours(each)]


@pytest.mark.parametrize(
    "name", ["A" * 63, "é" * 31 + "x", "耳" * 21, "x" * 58 + ".a1b"]
)
def test_long_names_are_known_on_several_objects(name):
    objects = []
    for _ in range(3):
        bpy.ops.mesh.primitive_monkey_add()
        objects.append(bpy.context.active_object)
        decompose_by_hand(objects[-1], 3, **FAST)
        objects[-1].wcd_parts[0].name = name
    for obj in objects:
        assert len(obj.data.materials) == 3
        assert all(map(is_ours, obj.data.materials))
    for obj in objects:
        activate(obj)
        decompose_by_hand(obj, 2, **FAST)
        assert len(obj.data.materials) == 2
    for obj in objects:
        activate(obj)
        bpy.ops.wcd.clear()
        assert not obj.data.materials
    assert not bpy.data.materials


@pytest.mark.parametrize(
    ("given", "name", "same"),
    [
        ("Ear.001", "Ear", True),
        ("Ear", "Ear.001", True),
        ("E", "Ear", False),
        ("A" * 59, "A" * 63, True),
        ("A" * 59 + ".001", "A" * 63, True),
        ("A" * 58 + ".1000", "A" * 63, True),
        ("A" * 50, "A" * 63, False),
        ("A" * 58, "A" * 59, False),
        ("耳" * 19 + ".002", "耳" * 21, True),
    ],
)
def test_a_cut_name_is_known(given, name, same):
    assert has_name(given, name) == same


def replace_group(obj, vertices):
    """Remove the group of the second part, and make one of its name."""
    obj.vertex_groups.remove(obj.vertex_groups["Part 02"])
    obj.vertex_groups.new(name="Part 02")
    in_mode(obj, "OBJECT")
    obj.vertex_groups["Part 02"].add(vertices, 0.25, "REPLACE")


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("vertices", [[], [0, 1], range(507)], ids=len)
def test_a_group_of_the_users_with_the_name_of_a_part_stays(monkey, vertices, mode):
    replace_group(monkey, vertices)
    in_mode(monkey, mode)
    bpy.ops.wcd.clear()
    assert groups_of(monkey) == ["Part 02"]
    in_mode(monkey, "OBJECT")
    members = [vertex.index for vertex in monkey.data.vertices if vertex.groups]
    assert members == list(vertices)


def test_another_run_leaves_such_a_group_too(monkey):
    replace_group(monkey, [0, 1])
    decompose_by_hand(monkey, 2, **FAST)
    assert groups_of(monkey)[0] == "Part 02"
    monkey.wcd_parts[1].name = "Ear"
    assert groups_of(monkey)[0] == "Part 02"
    assert [row.name for row in monkey.wcd_parts] == groups_of(monkey)[1:]


def test_the_name_of_a_part_can_change_without_such_a_group(monkey):
    replace_group(monkey, [0, 1])
    monkey.wcd_parts[1].name = "Ear"
    assert groups_of(monkey) == ["Part 01", "Part 03", "Part 04", "Part 02"]
    bpy.ops.wcd.clear()
    assert groups_of(monkey) == ["Part 02"]


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_groups_that_the_user_painted_or_whose_mesh_changed_go(monkey, mode):
    for vertex in list(monkey.data.vertices)[::2]:
        for group in vertex.groups:
            group.weight = 0.5
    in_mode(monkey, mode)
    if mode == "EDIT":
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
        bpy.ops.mesh.primitive_cube_add()
    bpy.ops.wcd.clear()
    assert not groups_of(monkey)
