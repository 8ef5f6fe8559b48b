"""Figures in the sidebar are of the mesh as it is now, or said to be out of date."""

from types import SimpleNamespace

import bmesh
import bpy
import numpy as np
import pytest
from edited import FAST, record_of
from hand_made import (
    activate,
    bands,
    decompose_by_hand,
    decomposition_of,
    face_values,
    in_mode,
    mesh_object,
)
from mathutils import Matrix
from stand_ins.layout import context
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.operators.bridge.hulls.listed import hulls_of
from weak_convex_decomposition.operators.bridge.mesh.fingerprint import (
    MEASURED_ON,
    fits,
    to_be_noted,
)
from weak_convex_decomposition.operators.bridge.parts.figures import figures_of
from weak_convex_decomposition.operators.bridge.parts.write import write_parts
from weak_convex_decomposition.ui.hulls_panel import WCD_PT_hulls
from weak_convex_decomposition.ui.panels import WCD_PT_parts, notes_of
from weak_convex_decomposition.ui.parts_table import WCD_UL_parts
from weak_convex_decomposition.ui.use_panel import WCD_PT_why

QUICK = {"samples": 50}


class Texts(list):
    """Stands for a layout: keeps all texts that are drawn in it."""

    def __getattr__(self, name):
        return lambda *_, **look: self.append(look.get("text")) or self


def value_of(panel, name):
    """Return the text that a panel draws behind a name, None without one."""
    texts = Texts()
    panel.draw(SimpleNamespace(layout=texts), context())
    return texts[texts.index(name) + 1] if name in texts else None


def hull_cells(obj):
    """Return the last text of each row of the table: the error of the part's hull."""
    cells = {}
    for row in obj.wcd_parts:
        texts = Texts()
        names = ("wcd_active_part", 0)
        WCD_UL_parts.draw_item(None, context(), texts, obj, row, 0, obj, *names)
        if texts:
            cells[row.name] = [text for text in texts if text][-1]
    return cells


def delete_faces(obj, doomed):
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    faces = [face for face, gone in zip(bm.faces[:], doomed, strict=True) if gone]
    bmesh.ops.delete(bm, geom=faces, context="FACES")
    bm.to_mesh(obj.data)
    bm.free()


def upper_half(obj):
    return [polygon.center.z > 0 for polygon in obj.data.polygons]


@pytest.mark.parametrize("n_parts", [0, 3])
def test_the_rank_of_another_mesh_is_out_of_date(suzanne, n_parts):
    if n_parts:
        decompose_by_hand(suzanne, n_parts, **FAST)
    bpy.ops.wcd.measure(**QUICK)
    assert value_of(WCD_PT_parts, "Convexity").startswith("0.")
    delete_faces(suzanne, upper_half(suzanne))
    assert value_of(WCD_PT_parts, "Convexity") == "out of date"
    bpy.ops.wcd.measure(**QUICK)
    assert value_of(WCD_PT_parts, "Convexity").startswith("0.")


def test_a_rank_is_known_in_both_modes_and_by_copies(suzanne):
    bpy.ops.wcd.measure(**QUICK)
    in_mode(suzanne, "EDIT")
    assert value_of(WCD_PT_parts, "Convexity").startswith("0.")
    in_mode(suzanne, "OBJECT")
    bpy.ops.object.duplicate()
    assert value_of(WCD_PT_parts, "Convexity").startswith("0.")
    bpy.context.active_object.data.transform(suzanne.matrix_world.Scale(2, 4))
    assert value_of(WCD_PT_parts, "Convexity") == "out of date"


def test_a_separated_piece_has_no_rank_of_the_whole(suzanne):
    bpy.ops.wcd.measure(**QUICK)
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.separate(type="LOOSE")
    in_mode(suzanne, "OBJECT")
    pieces = [obj for obj in bpy.data.objects if "wcd" in obj]
    assert len(pieces) == 3
    for piece in pieces:
        activate(piece)
        assert value_of(WCD_PT_parts, "Convexity") == "out of date"


def test_the_rank_of_a_selection_is_out_of_date_with_the_mesh(suzanne):
    in_mode(suzanne, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.wcd.measure_selection(**QUICK)
    name = f"{len(suzanne.data.polygons)} Faces"
    assert value_of(WCD_PT_why, name).startswith("0.")
    bpy.ops.mesh.delete(type="FACE")
    assert value_of(WCD_PT_why, name) == "out of date"


def test_points_have_a_rank_until_they_move():
    bpy.ops.mesh.primitive_uv_sphere_add()
    sphere = bpy.context.active_object
    bm = bmesh.new()
    bm.from_mesh(sphere.data)
    bmesh.ops.delete(bm, geom=bm.edges[:], context="EDGES_FACES")
    bm.to_mesh(sphere.data)
    bm.free()
    bpy.ops.wcd.measure(**QUICK)
    for mode in ("EDIT", "OBJECT"):
        in_mode(sphere, mode)
        assert value_of(WCD_PT_parts, "Convexity") != "out of date"
    sphere.data.transform(sphere.matrix_world.Translation((1, 0, 0)))
    assert value_of(WCD_PT_parts, "Convexity") == "out of date"


def test_cut_faces_keep_the_rank_of_their_shape():
    outline = [(1, 1), (1, 4), (0, 4), (0, 0), (4, 0), (4, 1)]
    walls = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    places = [(x, y, z) for z in (0, 1) for x, y in outline]
    angle = mesh_object("L", places, [range(6, 12), range(5, -1, -1), *walls])
    bpy.ops.wcd.measure(**QUICK)
    for seams in ("CUT", "KEEP"):
        bpy.ops.wcd.decompose(samples=200, parts=2, seams=seams)
        assert (len(angle.data.polygons) > 8) == (seams == "CUT")
        assert value_of(WCD_PT_parts, "Convexity") != "out of date"


def test_errors_of_hulls_are_those_of_the_mesh(suzanne):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    assert float(value_of(WCD_PT_hulls, "Largest Error")) > 0
    assert value_of(WCD_PT_hulls, "Volume Ratio")
    assert all(float(cell) > 0 for cell in hull_cells(suzanne).values())
    delete_faces(suzanne, face_values(suzanne.data, "wcd_part") == 0)
    assert value_of(WCD_PT_hulls, "Largest Error") == "out of date"
    assert value_of(WCD_PT_hulls, "Volume Ratio") is None
    assert hull_cells(suzanne) == {"Part 02": "–", "Part 03": "–"}


def test_a_hull_is_that_of_the_part_with_its_number(suzanne):
    decompose_by_hand(suzanne, 3, **FAST)
    delete_faces(suzanne, face_values(suzanne.data, "wcd_part") == 0)
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    hulls = record_of(suzanne)["hulls"]["hulls"]
    errors = {hull["part"]: f"{hull['error']:.2f}" for hull in hulls}
    assert hull_cells(suzanne) == {"Part 02": errors[1], "Part 03": errors[2]}


def test_notes_go_with_the_hulls_and_with_the_mesh(suzanne):
    bpy.ops.wcd.build_hulls(max_hulls=2, max_error=0.05)
    (note,) = notes_of(suzanne)
    assert note.startswith("The error is")
    bpy.ops.object.duplicate()
    assert notes_of(bpy.context.active_object) == []  # its hulls are not duplicated
    activate(suzanne)
    for hull in hulls_of(suzanne):
        bpy.data.objects.remove(hull)
    assert notes_of(suzanne) == []
    suzanne.modifiers.new("Mirror", "MIRROR")
    bpy.ops.wcd.measure(**QUICK)
    assert len(notes_of(suzanne)) == 1
    delete_faces(suzanne, upper_half(suzanne))
    assert notes_of(suzanne) == []


@pytest.mark.parametrize("far", [0.0, 1.0e4])
def test_many_faces_far_from_the_origin_are_known_again(far):
    sums = np.array([123_456, 6.5, far + 0.123_456, -far, 0.5])
    noted = {MEASURED_ON: to_be_noted(sums)}
    assert fits(noted, sums)
    for place, change in ((0, 1.0), (1, 0.1), (3, 0.1)):
        other = sums.copy()
        other[place] += change
        assert not fits(noted, other)


def test_parts_far_from_the_origin_are_not_out_of_date(suzanne):
    suzanne.data.transform(suzanne.matrix_world.Translation((9876.54, 0, 0)))
    decompose_by_hand(suzanne, 3, **FAST)
    assert figures_of(suzanne).problem is None


def test_notes_of_parts_go_with_their_faces(suzanne):
    found = decomposition_of(bands(suzanne, 3), ["Look twice."])
    write_parts(suzanne, found, Parameters(**FAST))
    assert notes_of(suzanne) == ["Look twice."]
    delete_faces(suzanne, upper_half(suzanne))
    assert notes_of(suzanne) == []


def test_hulls_around_former_parts_are_of_none_of_the_new_ones(suzanne):
    decompose_by_hand(suzanne, 3, **FAST)
    bpy.ops.wcd.build_hulls(pieces="PARTS", shape="BOX")
    decompose_by_hand(suzanne, 2, **FAST)
    hulls = record_of(suzanne)["hulls"]["hulls"]
    assert [hull["part"] for hull in hulls] == [None] * 3


def test_figures_of_a_mesh_far_from_its_origin_fit_in_edit_mode_too():
    """Edit Mode computes areas in single precision."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.active_object
    obj.data.transform(Matrix.Translation((2e5, 2e5, 0)))
    decompose_by_hand(obj, 4)
    bpy.ops.wcd.refresh_parts()
    assert figures_of(obj).problem is None
    in_mode(obj, "EDIT")
    assert figures_of(obj).problem is None
