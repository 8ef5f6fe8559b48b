"""Objects, exploded views, face sets and colors made of parts."""

import bpy
import numpy as np
import pytest
from hand_made import (
    activate,
    areas,
    bands,
    centers,
    decompose_by_hand,
    face_values,
    give_user_data,
    in_mode,
)
from snapshot import snapshot

NAMES = ("separate", "explode", "face_sets", "color_attribute")


def call(name, **options):
    return getattr(bpy.ops.wcd, name)(**options)


def test_every_part_becomes_an_object(suzanne):
    labels = decompose_by_hand(suzanne, 3)
    before = snapshot(suzanne)["mesh"]
    assert call("separate") == {"FINISHED"}
    pieces = list(bpy.data.collections["Suzanne parts"].objects)
    assert [piece.name for piece in pieces] == [
        f"Suzanne Part {number:02d}" for number in (1, 2, 3)
    ]
    assert [len(piece.data.polygons) for piece in pieces] == np.bincount(
        labels
    ).tolist()
    total = sum(areas(piece.data).sum() for piece in pieces)
    assert total == pytest.approx(areas(suzanne.data).sum(), rel=1e-5)
    assert snapshot(suzanne)["mesh"] == before
    assert suzanne.hide_get()
    assert suzanne.hide_render
    assert not pieces[0].hide_render
    assert set(bpy.context.selected_objects) == set(pieces)
    assert bpy.context.active_object == pieces[0]
    for part, piece in enumerate(pieces):
        assert "wcd" not in piece
        assert piece.color[:3] == pytest.approx(suzanne.wcd_parts[part].color[:3])
        assert piece.color[3] == 1
        assert [slot.name for slot in piece.material_slots] == [f"Part {part + 1:02d}"]


def test_what_the_user_had_comes_along(suzanne):
    give_user_data(suzanne)
    suzanne.modifiers.new("Mirror", "MIRROR")
    suzanne.data.shape_keys.key_blocks["smile"].value = 0.5
    slots = [slot.name for slot in suzanne.material_slots]
    indices = [polygon.material_index for polygon in suzanne.data.polygons]
    labels = decompose_by_hand(suzanne, 2)
    call("separate")
    for part, piece in enumerate(bpy.data.collections["Suzanne parts"].objects):
        mesh = piece.data
        assert [modifier.name for modifier in piece.modifiers] == ["Mirror"]
        assert [slot.name for slot in piece.material_slots] == slots
        assert [group.name for group in piece.vertex_groups] == ["Part 01", "spine"]
        assert [polygon.material_index for polygon in mesh.polygons] == [
            index for index, of in zip(indices, labels, strict=True) if of == part
        ]
        assert {v.value for v in mesh.attributes["dust"].data} == {0.5}
        keys = mesh.shape_keys.key_blocks
        assert [key.name for key in keys] == ["Basis", "smile"]
        assert len(keys["smile"].data) == len(mesh.vertices)
        assert piece["note"] == "mine"
        assert not [name for name in mesh.attributes.keys() if "wcd" in name]  # noqa: SIM118
    groups = suzanne.vertex_groups["spine"].index
    assert groups == 1


def test_the_original_can_be_removed_and_the_largest_part_gets_its_children(suzanne):
    labels = decompose_by_hand(suzanne, 2)
    for vertex in suzanne.data.vertices:  # make the second part the larger one
        vertex.co.x *= 1 if vertex.co.x < 0 else 3
    sizes = np.bincount(labels, weights=areas(suzanne.data))
    assert sizes.argmax() == 1
    bpy.ops.object.empty_add(location=(1, 2, 3))
    child = bpy.context.active_object
    child.parent = suzanne
    activate(suzanne)
    call("separate", original="REMOVE")
    assert "Suzanne" not in bpy.data.objects
    assert child.parent.name == "Suzanne Part 02"
    assert {mesh.name for mesh in bpy.data.meshes} == {
        "Suzanne Part 01",
        "Suzanne Part 02",
    }


def test_a_part_whose_material_was_removed_gets_a_new_one(suzanne):
    decompose_by_hand(suzanne, 3)
    suzanne.data.materials.pop(index=1)
    bpy.data.materials.remove(bpy.data.materials["Part 02"])
    call("separate")
    pieces = bpy.data.collections["Suzanne parts"].objects
    assert [slot.name for piece in pieces for slot in piece.material_slots] == [
        "Part 01",
        "Part 02",
        "Part 03",
    ]


def test_loose_vertices_stay_with_one_part(suzanne):
    decompose_by_hand(suzanne, 2)
    suzanne.data.vertices.add(3)
    call("separate")
    pieces = bpy.data.collections["Suzanne parts"].objects
    loose = [
        len(
            set(range(len(p.data.vertices)))
            - {v for f in p.data.polygons for v in f.vertices}
        )
        for p in pieces
    ]
    assert loose == [3, 0]


def test_face_sets_are_the_parts_and_earlier_ones_come_back(suzanne):
    labels = decompose_by_hand(suzanne, 3)
    call("face_sets")
    assert (face_values(suzanne.data, ".sculpt_face_set") == labels + 1).all()
    decompose_by_hand(suzanne, 5)
    assert face_values(suzanne.data, ".sculpt_face_set").max() == 5
    bpy.ops.wcd.clear()
    assert ".sculpt_face_set" not in suzanne.data.attributes
    own = suzanne.data.attributes.new(".sculpt_face_set", "INT", "FACE")
    own.data.foreach_set("value", np.arange(500, dtype=np.int32) + 1)
    before = snapshot(suzanne)
    for merged in (False, True):
        decompose_by_hand(suzanne, 3)
        call("face_sets")
        if merged:  # leaves numbers 0 and 2
            for row in suzanne.wcd_parts[:2]:
                row.chosen = True
            bpy.ops.wcd.merge_parts()
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before


def test_face_sets_drawn_since_are_the_users(suzanne):
    decompose_by_hand(suzanne, 3)
    call("face_sets")
    suzanne.data.attributes[".sculpt_face_set"].data[7].value = 99
    bpy.ops.wcd.clear()
    values = face_values(suzanne.data, ".sculpt_face_set")
    assert values[7] == 99
    assert set(values) == {1, 2, 3, 99}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_corners_get_the_colors_of_their_parts(suzanne, mode):
    in_mode(suzanne, "EDIT")  # Edit Mode itself adds and drops layers
    in_mode(suzanne, "OBJECT")
    before = snapshot(suzanne)
    labels = bands(suzanne, 3)
    in_mode(suzanne, mode)
    decompose_by_hand(suzanne, 3)
    call("color_attribute")
    call("face_sets")
    in_mode(suzanne, "OBJECT")
    attribute = suzanne.data.color_attributes["wcd_color"]
    assert (attribute.domain, attribute.data_type) == ("CORNER", "FLOAT_COLOR")
    for polygon, part in zip(suzanne.data.polygons, labels, strict=True):
        for corner in polygon.loop_indices:
            assert tuple(attribute.data[corner].color) == pytest.approx(
                (*suzanne.wcd_parts[part].color[:3], 1)
            )
    in_mode(suzanne, mode)
    bpy.ops.wcd.clear()
    in_mode(suzanne, "OBJECT")
    assert snapshot(suzanne) == before


def test_clear_takes_everything_back(suzanne):
    give_user_data(suzanne)
    before = snapshot(suzanne)
    decompose_by_hand(suzanne, 3)
    for name in ("explode", "face_sets", "color_attribute"):
        call(name)
    bpy.ops.wcd.clear()
    assert snapshot(suzanne) == before
    assert not bpy.data.node_groups


@pytest.mark.parametrize("name", NAMES)
def test_each_is_one_undo_step(suzanne, name):
    decompose_by_hand(suzanne, 3)
    bpy.ops.ed.undo_push(message="before")
    before = snapshot(suzanne)
    getattr(bpy.ops.wcd, name)("EXEC_DEFAULT", True)
    assert bpy.data.collections or snapshot(bpy.data.objects["Suzanne"]) != before
    bpy.ops.ed.undo()
    assert snapshot(bpy.data.objects["Suzanne"]) == before
    assert not bpy.data.collections
    assert not bpy.data.node_groups


def test_all_survive_saving_and_loading(suzanne, tmp_path):
    decompose_by_hand(suzanne, 3)
    for name in ("explode", "face_sets", "color_attribute"):
        call(name)
    before, there = snapshot(suzanne), centers(suzanne)
    path = str(tmp_path / "parts.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.context.active_object
    assert snapshot(obj) == before
    assert centers(obj) == pytest.approx(there)
    assert call("separate") == {"FINISHED"}


@pytest.mark.parametrize("name", NAMES)
def test_objects_without_parts_are_refused(suzanne, name):
    with pytest.raises(RuntimeError, match="Suzanne has no parts; press Decompose"):
        call(name)
    bpy.context.view_layer.objects.active = None
    suzanne.select_set(False)
    with pytest.raises(RuntimeError, match="select a mesh"):
        call(name)


@pytest.mark.parametrize("name", ["separate", "explode"])
def test_object_mode_is_asked_for(suzanne, name):
    decompose_by_hand(suzanne, 3)
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch to Object Mode"):
        call(name)


def test_several_objects_are_separated(suzanne):
    decompose_by_hand(suzanne, 2)
    bpy.ops.mesh.primitive_monkey_add(location=(5, 0, 0))
    other = bpy.context.active_object
    decompose_by_hand(other, 3)
    suzanne.select_set(True)
    call("separate")
    assert len(bpy.data.collections["Suzanne parts"].objects) == 2
    assert len(bpy.data.collections["Suzanne.001 parts"].objects) == 3
    assert len(bpy.context.selected_objects) == 5
