"""What separate objects keep: normals that the user gave, and where children are."""

import bpy
import numpy as np
import pytest
from hand_made import activate, decompose_by_hand
from mathutils import Matrix


def round_cube():
    """Return a cube of 384 faces whose normals are those of a ball."""
    bpy.ops.mesh.primitive_cube_add()
    cube = bpy.context.active_object
    modifier = cube.modifiers.new("Simple", "SUBSURF")
    modifier.subdivision_type, modifier.levels = "SIMPLE", 3
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    mesh = cube.data
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.normals_split_custom_set_from_vertices(
        [vertex.co.normalized() for vertex in mesh.vertices]
    )
    return cube


def test_separate_objects_keep_the_normals_that_the_user_gave():
    cube = round_cube()
    decompose_by_hand(cube, 4)
    bpy.ops.wcd.separate()
    pieces = bpy.data.collections["Cube parts"].objects
    assert len(pieces) == 4
    for piece in pieces:
        mesh = piece.data
        assert mesh.has_custom_normals
        given = [corner.vector for corner in mesh.corner_normals]
        wanted = [mesh.vertices[loop.vertex_index].co for loop in mesh.loops]
        cosines = [a.dot(b.normalized()) for a, b in zip(given, wanted, strict=True)]
        assert min(cosines) > np.cos(np.radians(0.5))
        assert not [a.name for a in mesh.attributes if "wcd" in a.name]


def test_separate_objects_get_no_normals_that_nobody_gave(suzanne):
    decompose_by_hand(suzanne, 2)
    bpy.ops.wcd.separate()
    for piece in bpy.data.collections["Suzanne parts"].objects:
        assert not piece.data.has_custom_normals


@pytest.mark.parametrize("letter", ["x", "頭"])
def test_separate_objects_of_long_names_tell_their_parts(suzanne, letter):
    suzanne.name = 300 * letter  # Blender keeps what it has room for
    decompose_by_hand(suzanne, 2)
    suzanne.wcd_parts[0].name = 21 * "耳"
    endings = [row.name for row in suzanne.wcd_parts]
    bpy.ops.wcd.separate()
    collection = next(c for c in bpy.data.collections if c.name.endswith(" parts"))
    names = [piece.name for piece in collection.objects]
    assert sorted(name.lstrip(letter).strip() for name in names) == sorted(endings)


@pytest.mark.parametrize("kind", ["OBJECT", "VERTEX", "VERTEX_3"])
def test_children_stay_in_place_where_the_original_goes(suzanne, kind):
    suzanne.location, suzanne.scale = (1, 2, 3), (1, 2, 1)
    decompose_by_hand(suzanne, 3)
    bpy.ops.object.empty_add(location=(0.5, 0, 0), rotation=(0, 0.4, 0))
    child = bpy.context.active_object
    child.parent, child.parent_type = suzanne, kind
    child.parent_vertices = (500, 20, 300)
    child.matrix_parent_inverse = Matrix.Translation((0, 0, 4))
    activate(suzanne)
    before, location = child.matrix_world.copy(), child.location.copy()
    bpy.ops.wcd.separate(original="REMOVE")
    bpy.context.view_layer.update()
    assert child.parent.name.startswith("Suzanne Part")
    assert np.array(child.matrix_world) == pytest.approx(np.array(before), abs=1e-5)
    assert child.location == location
