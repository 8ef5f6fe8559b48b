"""Curves, texts, surfaces and metaballs: decomposed on meshes beside them."""

import bpy
import numpy as np
import pytest
from edited import record_of
from hand_curves import check_fingers, hand_curve
from hand_made import activate, face_values, in_mode
from mathutils import Matrix
from weak_convex_decomposition.operators.bridge.read.converting import converted

FAST = {"samples": 200, "parts": 2}
# At the start: no traceback comes before it.
NO_OUTLINE = r"\AError: \S+ has no faces, and no closed outline in one plane"


def blocks():
    """Return the data that there is."""
    names = ("objects", "meshes", "curves", "metaballs", "materials")
    return {name: sorted(getattr(bpy.data, name).keys()) for name in names}


def circles(*radii):
    """Return a curve of circles, one in the other."""
    for radius in radii:
        bpy.ops.curve.primitive_bezier_circle_add(radius=radius)
    for obj in bpy.context.view_layer.objects:
        obj.select_set(True)
    if len(radii) > 1:
        bpy.ops.object.join()
    return bpy.context.active_object


def test_the_outline_of_a_hand_has_a_palm_and_five_fingers():
    hand = hand_curve()
    hand.location = (1, 2, 3)
    bpy.ops.wcd.decompose()
    carrier = bpy.context.active_object
    assert (carrier.name, carrier.parent, hand.type) == ("Hand parts", hand, "CURVE")
    assert list(hand.keys()) == []
    bpy.context.view_layer.update()
    assert carrier.matrix_world == hand.matrix_world
    check_fingers(carrier, face_values(carrier.data, "wcd_part"))
    assert "Hand is hidden" in record_of(carrier)["notes"][0]


def test_what_is_made_for_a_long_name_tells_what_it_is():
    hand = hand_curve()
    hand.name = 300 * "手"  # Blender keeps what it has room for
    bpy.ops.wcd.decompose(samples=200, parts=2)
    carrier = bpy.context.active_object
    assert carrier.name == carrier.data.name
    assert carrier.name.endswith("手 parts")
    assert f'"{carrier.name}"' in record_of(carrier)["notes"][0]
    bpy.ops.wcd.show_picture()
    assert any(i.name.endswith("手 Lines of Sight") for i in bpy.data.images)


@pytest.mark.parametrize("in_renders", [True, False])
def test_the_curve_is_hidden_until_clear(in_renders):
    hand = hand_curve()
    hand.hide_render = not in_renders
    before = blocks()
    for _ in range(2):
        activate(hand)
        bpy.ops.wcd.decompose(**FAST)
        assert (hand.hide_get(), hand.hide_render) == (True, True)
        hand.hide_set(False)
    carrier = bpy.context.active_object
    in_mode(carrier, "EDIT")
    assert not bpy.ops.wcd.clear.poll()
    in_mode(carrier, "OBJECT")
    hand.hide_set(True)
    bpy.ops.wcd.clear()
    assert blocks() == before
    assert (hand.hide_get(), hand.hide_render) == (False, not in_renders)
    assert (bpy.context.active_object, hand.select_get()) == (hand, True)


def test_a_mesh_that_carries_other_objects_stays():
    hand = hand_curve()
    bpy.ops.wcd.decompose(**FAST)
    carrier = bpy.context.active_object
    child = bpy.data.objects.new("ring", None)
    child.parent = carrier
    bpy.ops.wcd.clear()
    assert child.parent == carrier
    assert not hand.hide_get()


def test_running_again_replaces_the_mesh():
    hand = hand_curve()
    bpy.ops.wcd.decompose(**FAST)
    after = blocks()
    activate(hand)
    bpy.ops.wcd.decompose(**FAST)
    assert blocks() == after
    assert len(record_of(bpy.context.active_object)["parts"]) == 2


@pytest.mark.parametrize("runs", [1, 2])
def test_one_undo_takes_back_what_a_run_made(runs):
    """Blocks that undo leaves without a user are kept until the file is saved."""
    hand_curve()
    for _ in range(runs):
        activate(bpy.data.objects["Hand"])
        before = _in_scene()
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.wcd.decompose("EXEC_DEFAULT", True, samples=200, parts=runs + 1)
        after = _in_scene()
    assert after != before
    bpy.ops.ed.undo()
    assert _in_scene() == before
    bpy.ops.ed.redo()
    assert _in_scene() == after


def _in_scene():
    """Return the objects, whether they are selected, and their records."""
    return sorted(
        (obj.name, obj.select_get(), obj.get("wcd"), len(obj.data.materials))
        for obj in bpy.context.scene.objects
    )


def test_outlines_are_filled_however_they_are_turned():
    area = sum(face.area for face in converted(hand_curve()).polygons)
    hand = hand_curve()
    turn = Matrix.Rotation(1, 4, "X") @ Matrix.Rotation(0.5, 4, "Y")
    hand.data.transform(turn @ Matrix.Translation((3, 2, 1)))
    mesh = converted(hand)
    assert sum(face.area for face in mesh.polygons) == pytest.approx(area, rel=1e-4)
    places = np.array([vertex.co for vertex in mesh.vertices])
    corners = np.array([point.co[:3] for point in hand.data.splines[0].points])
    gaps = np.linalg.norm(places[:, None] - corners, axis=2).min(axis=0)
    assert gaps.max() < 1e-4


def test_outlines_in_outlines_are_holes():
    mesh = converted(circles(2, 1))
    area = sum(face.area for face in mesh.polygons)
    assert area == pytest.approx(3 * np.pi, rel=0.02)
    lengths = [(a.co - b.co).length for a, b in ends(mesh)]
    assert max(lengths) < 0.15


def ends(mesh):
    """Return the two vertices of each edge."""
    return [[mesh.vertices[row] for row in edge.vertices] for edge in mesh.edges]


@pytest.mark.parametrize(
    "add",
    [
        lambda: bpy.ops.object.text_add(),
        lambda: bpy.ops.object.metaball_add(),
        lambda: bpy.ops.surface.primitive_nurbs_surface_sphere_add(),
        lambda: bpy.ops.curve.primitive_bezier_circle_add(),
    ],
)
def test_whatever_has_faces_as_a_mesh_is_decomposed(add):
    add()
    obj = bpy.context.active_object
    before = blocks()
    assert bpy.ops.wcd.decompose(**FAST) == {"FINISHED"}
    carrier = bpy.context.active_object
    assert set(face_values(carrier.data, "wcd_part")) == {0, 1}
    assert set(blocks()["objects"]) - set(before["objects"]) == {f"{obj.name} parts"}
    activate(obj)
    with pytest.raises(RuntimeError, match="Decompose makes one beside it"):
        bpy.ops.wcd.measure()


def test_a_curve_without_a_flat_outline_has_its_sentence():
    bpy.ops.curve.primitive_bezier_curve_add()
    for flat in (True, False):
        if not flat:
            hand_curve().data.splines[0].points[3].co.z = 1
        before = blocks()
        with pytest.raises(RuntimeError, match=NO_OUTLINE):
            bpy.ops.wcd.decompose(**FAST)
        assert blocks() == before


def test_a_curve_without_points_has_its_sentence_and_stops_no_other(suzanne):
    hand = hand_curve()
    hand.data.splines.clear()
    with pytest.raises(RuntimeError, match=NO_OUTLINE):
        bpy.ops.wcd.decompose(**FAST)
    suzanne.select_set(True)
    bpy.ops.wcd.decompose(**FAST)
    assert len(suzanne.wcd_parts) == 2
    assert not hand.children


def test_metaballs_of_a_family_and_texts_without_letters_have_sentences():
    for _ in range(2):
        bpy.ops.object.metaball_add()
    with pytest.raises(RuntimeError, match=r"Mball\.001 has no faces; metaballs"):
        bpy.ops.wcd.decompose(**FAST)
    bpy.ops.object.text_add()
    bpy.context.active_object.data.body = " "
    with pytest.raises(RuntimeError, match="Text has no faces; type letters"):
        bpy.ops.wcd.decompose(**FAST)
