"""Lines of sight over the viewports, ranks of selected faces, and pictures."""

from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
import weak_convex_decomposition as package
from edited import record_of
from hand_made import decompose_by_hand, in_mode
from mathutils import Matrix
from snapshot import snapshot
from weak_convex_decomposition.operators.bridge.views.images import images_of
from weak_convex_decomposition.operators.viewport import show_sight, sight_overlay

FAST = {"samples": 100}
_PICTURES = ("SIGHT", "DISTANCES", "SCATTER")


@pytest.fixture
def cube():
    bpy.ops.mesh.primitive_cube_add(location=(3, 0, 0))
    cube = bpy.context.active_object
    cube.scale = (2, 1, 1)
    bpy.context.view_layer.update()
    return cube


def face_towards(obj, direction):
    normals = np.array([polygon.normal for polygon in obj.data.polygons])
    return int((normals @ direction).argmax())


def test_a_face_of_a_cube_sees_all_other_faces(cube):
    before = snapshot(cube)
    top = face_towards(cube, (0, 0, 1))
    assert bpy.ops.wcd.show_sight(face=top, **FAST) == {"FINISHED"}
    overlay = sight_overlay.current
    scale = np.diagonal(overlay.stretch)
    places = overlay.view.places / scale  # in the space of the object
    assert np.abs(places).max() == pytest.approx(1.0, abs=1e-5)
    assert overlay.view.visible[places[:, 2] < 0.99].all()
    assert overlay.view.point / scale == pytest.approx([0, 0, 1], abs=1e-3)
    assert snapshot(cube) == before
    assert bpy.ops.wcd.hide_sight() == {"FINISHED"}
    assert sight_overlay.current is None
    with pytest.raises(RuntimeError, match="No lines of sight are shown; show some"):
        bpy.ops.wcd.hide_sight()


def test_a_face_in_the_hole_of_a_huge_ring_is_looked_at_from_within():
    bpy.ops.mesh.primitive_torus_add(minor_segments=3)
    ring = bpy.context.active_object
    ring.scale = (1e5, 1e5, 1e5)
    bpy.context.view_layer.update()
    face = min(ring.data.polygons, key=lambda polygon: polygon.center.length)
    bpy.ops.wcd.show_sight(face=face.index, **FAST)
    overlay = sight_overlay.current
    point = overlay.view.point / np.diagonal(overlay.stretch)
    assert point == pytest.approx(tuple(face.center), abs=1e-3)


def test_nothing_is_shown_of_what_cannot_be_read(cube):
    with pytest.raises(RuntimeError, match="has no face 99; it has 6"):
        bpy.ops.wcd.show_sight(face=99, **FAST)
    with pytest.raises(RuntimeError, match="scripts name a face instead"):
        bpy.ops.wcd.show_sight(**FAST)
    bpy.ops.object.light_add()
    with pytest.raises(RuntimeError, match="is not a mesh"):
        bpy.ops.wcd.show_sight(face=0, **FAST)
    assert sight_overlay.current is None


def test_overlays_end_with_the_file_and_with_the_extension(cube, tmp_path):
    path = str(tmp_path / "cube.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wcd.show_sight(face=0, **FAST)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert sight_overlay.current is None
    bpy.ops.wcd.show_sight(face=0, **FAST)
    package.unregister()
    assert sight_overlay.current is None
    assert show_sight.stop not in bpy.app.handlers.load_pre
    package.register()


def nudge(cube, mode):
    """Move a vertex of the cube, and let Blender notice."""
    if mode == "OBJECT":
        cube.data.vertices[0].co.x += 0.1
        cube.data.update()
    else:
        bm = bmesh.from_edit_mesh(cube.data)
        bm.verts.ensure_lookup_table()
        bm.verts[0].co.x += 0.1
        bmesh.update_edit_mesh(cube.data)
    bpy.context.view_layer.update()


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_overlays_end_when_the_mesh_changes(cube, mode):
    bpy.ops.wcd.show_sight(face=0, **FAST)
    cube.location.x += 1.0
    cube.modifiers.new("Bevel", "BEVEL")
    in_mode(cube, mode)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.object.mode_set(mode=mode)
    bpy.context.view_layer.update()
    assert sight_overlay.current is not None
    nudge(cube, mode)
    assert sight_overlay.current is None


def clicking(cube):
    """Return the operator as it is while it waits for clicks."""
    bpy.ops.wcd.show_sight(face=0, **FAST)
    own = vars(show_sight.WCD_OT_show_sight)
    waiting = type("Waiting", (), {n: own[n] for n in ("modal", "_press")})()
    waiting._viewer, waiting._overlay = object(), sight_overlay.current
    waiting._clicked = lambda _, *place: place
    return waiting


def event(kind, x=0, y=0, alt=False, ctrl=False):
    place = {"mouse_x": x, "mouse_y": y}
    return SimpleNamespace(type=kind, value="PRESS", alt=alt, ctrl=ctrl, **place)


def viewport(*extra, mode="OBJECT"):
    window = SimpleNamespace(type="WINDOW", x=100, y=50, width=400, height=300)
    window.data = SimpleNamespace(perspective_matrix=Matrix())
    area = SimpleNamespace(type="VIEW_3D", regions=[window, *extra])
    window_of = SimpleNamespace(screen=SimpleNamespace(areas=[area]))
    return SimpleNamespace(mode=mode, window=window_of), window


def test_clicks_in_the_viewport_pick_and_others_pass(cube):
    sidebar = SimpleNamespace(type="UI", x=450, y=50, width=50, height=300)
    waiting, (context, window) = clicking(cube), viewport(sidebar)
    assert waiting.modal(context, event("LEFTMOUSE", 120, 70)) == (window, 20, 20)
    for passed in (
        event("LEFTMOUSE", 470, 70),  # the sidebar lies over the viewport
        event("LEFTMOUSE", 20, 70),
        event("MIDDLEMOUSE", 120, 70),
        event("LEFTMOUSE", 120, 70, alt=True),  # it may emulate the middle button
        event("RIGHTMOUSE", 120, 70, ctrl=True),
        event("RIGHTMOUSE", 470, 70),
        event("RIGHTMOUSE", 20, 70),
    ):
        assert waiting.modal(context, passed) == {"PASS_THROUGH"}
    assert sight_overlay.current
    assert waiting.modal(context, event("RIGHTMOUSE", 120, 70)) == {"FINISHED"}
    assert sight_overlay.current is None


@pytest.mark.parametrize(("key", "kept"), [("ESC", False), ("RET", True)])
def test_keys_end_the_picking(cube, key, kept):
    waiting = clicking(cube)
    assert waiting.modal(viewport()[0], event(key)) == {"FINISHED"}
    assert (sight_overlay.current is not None) == kept


def test_clicks_pass_in_other_modes_and_the_picture_stays(cube):
    context, press = viewport(mode="SCULPT")[0], event("LEFTMOUSE", 120, 70)
    assert clicking(cube).modal(context, press) == {"FINISHED", "PASS_THROUGH"}
    assert sight_overlay.current


def test_hiding_ends_the_picking(cube):
    waiting = clicking(cube)
    bpy.ops.wcd.hide_sight()
    assert "FINISHED" in waiting.modal(viewport()[0], event("MOUSEMOVE"))


def test_selected_faces_are_measured(suzanne):
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.wcd.measure_selection(**FAST)
    everything = record_of(suzanne)["selection"]
    assert everything["faces"] == 500
    bpy.ops.mesh.select_all(action="DESELECT")
    in_mode(suzanne, "OBJECT")
    bpy.ops.wcd.measure(**FAST)
    measured = record_of(suzanne)["measured"]
    assert everything["convexity_rank"] == pytest.approx(measured["convexity_rank"])
    for polygon in suzanne.data.polygons:
        polygon.select = polygon.center.x > 0.8  # an ear
    in_mode(suzanne, "EDIT")
    bpy.ops.wcd.measure_selection(**FAST)
    in_mode(suzanne, "OBJECT")
    record = record_of(suzanne)
    assert record["selection"]["faces"] < 100
    assert record["selection"]["convexity_rank"] != everything["convexity_rank"]
    assert record["measured"] == measured
    bpy.ops.wcd.clear()
    assert "wcd" not in suzanne


def test_a_selection_is_asked_for(suzanne):
    with pytest.raises(RuntimeError, match="selected in Edit Mode; switch the mode"):
        bpy.ops.wcd.measure_selection(**FAST)
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="No faces are selected; select the faces"):
        bpy.ops.wcd.measure_selection(**FAST)


def test_pictures_are_images_that_clear_removes(suzanne, tmp_path):
    for name in ("Mine", "Suzanne Distances"):
        bpy.data.images.new(name, 4, 4).use_fake_user = True
    before = snapshot(suzanne)
    bpy.ops.wcd.decompose(**FAST)
    for picture in (*_PICTURES, *_PICTURES):
        assert bpy.ops.wcd.show_picture(picture=picture) == {"FINISHED"}
    names = sorted(image.name for image in images_of(suzanne))
    others = ["Suzanne Embedding", "Suzanne Lines of Sight"]
    assert names == ["Suzanne Distances.001", *others]
    image = bpy.data.images["Suzanne Lines of Sight"]
    pixels = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(pixels)
    assert 0.05 < pixels.reshape(-1, 4)[:, :3].mean() < 0.95
    path = str(tmp_path / "parts.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    again = np.empty_like(pixels)
    bpy.data.images["Suzanne Lines of Sight"].pixels.foreach_get(again)
    assert (again == pixels).all()
    bpy.ops.wcd.clear()
    assert [image.name for image in bpy.data.images] == ["Mine", "Suzanne Distances"]
    assert snapshot(bpy.context.active_object) == before


def test_pictures_need_parts_and_object_mode(suzanne):
    with pytest.raises(RuntimeError, match="Suzanne has no parts; press Decompose"):
        bpy.ops.wcd.show_picture()
    decompose_by_hand(suzanne, 3, **FAST)
    in_mode(suzanne, "EDIT")
    with pytest.raises(RuntimeError, match="switch to Object Mode"):
        bpy.ops.wcd.show_picture()


def test_a_picture_is_one_undo_step(suzanne):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.ed.undo_push(message="before")
    bpy.ops.wcd.show_picture("EXEC_DEFAULT", True)
    assert len(bpy.data.images) == 1
    bpy.ops.ed.undo()
    assert len(bpy.data.images) == 0
