"""Flat meshes."""

import bpy
from edited import record_of
from hand_curves import POINTS, check_fingers
from hand_made import face_values, in_mode, mesh_object


def test_a_single_face_carries_parts_once_it_is_subdivided_as_told():
    obj = mesh_object("Hand", POINTS.tolist(), [list(range(len(POINTS)))])
    bpy.ops.wcd.decompose()
    assert "Edge > Subdivide" in record_of(obj)["notes"][0]
    in_mode(obj, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.quads_convert_to_tris()
    bpy.ops.mesh.subdivide(number_cuts=3)
    in_mode(obj, "OBJECT")
    bpy.ops.wcd.decompose()
    assert record_of(obj)["notes"] == []
    check_fingers(obj, face_values(obj.data, "wcd_part"))
