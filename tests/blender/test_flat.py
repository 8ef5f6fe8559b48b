"""Flat meshes and the curves that they are made of."""

import json

import bpy
import flats
import numpy as np
import pytest
from hand_made import activate, face_values, in_mode, mesh_object

POINTS = np.pad(flats.HAND, ((0, 0), (0, 1)))


def hand_curve():
    """Return the outline of a hand as a closed curve in three dimensions."""
    curve = bpy.data.curves.new("Hand", "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("POLY")
    spline.points.add(len(POINTS) - 1)
    for point, place in zip(spline.points, POINTS, strict=True):
        point.co = (*place, 1)
    spline.use_cyclic_u = True
    obj = bpy.data.objects.new("Hand", curve)
    bpy.context.collection.objects.link(obj)
    activate(obj)
    return obj


def check_fingers(obj, labels):
    centers = np.array([polygon.center[:2] for polygon in obj.data.polygons])
    assert len(np.unique(labels)) == 6
    for finger in flats.FINGERS:
        within = flats.inside(centers, [np.array(finger)])
        assert (labels[within] == np.bincount(labels[within]).argmax()).mean() > 0.9


def test_a_curve_is_a_hand_once_it_is_filled_as_told():
    obj = hand_curve()
    with pytest.raises(RuntimeError, match="2D and Fill Mode Both"):
        bpy.ops.wcd.decompose()
    obj.data.dimensions = "2D"
    obj.data.fill_mode = "BOTH"
    bpy.ops.object.convert(target="MESH")
    obj = bpy.context.active_object
    obj.rotation_euler = (1, 2, 3)
    bpy.ops.wcd.decompose()
    check_fingers(obj, face_values(obj.data, "wcd_part"))


def test_a_single_face_carries_parts_once_it_is_subdivided_as_told():
    obj = mesh_object("Hand", POINTS.tolist(), [list(range(len(POINTS)))])
    bpy.ops.wcd.decompose()
    assert "Edge > Subdivide" in json.loads(obj["wcd"])["notes"][0]
    in_mode(obj, "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.quads_convert_to_tris()
    bpy.ops.mesh.subdivide(number_cuts=3)
    in_mode(obj, "OBJECT")
    bpy.ops.wcd.decompose()
    assert json.loads(obj["wcd"])["notes"] == []
    check_fingers(obj, face_values(obj.data, "wcd_part"))
