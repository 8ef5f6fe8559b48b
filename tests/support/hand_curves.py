"""The paper's hand in two dimensions, as a curve, and what its parts have to be."""

import bpy
import flats
import numpy as np
from hand_made import activate

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
