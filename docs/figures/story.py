"""A character from a gray mesh to named, colored and repaired parts, step by step."""

from __future__ import annotations

import bpy
import extension
import numpy as np
import shapes
from image import below, beside
from mathutils import Euler, Vector
from panels import paint
from render import panel

_SIZE = 440
_GRAY = (0.5, 0.5, 0.5)
_SKIN = (0.85, 0.35, 0.18)
_TURN = 25.0
_LETTERS = 0.42  # height of the names, in units of the scene
# How far names are from the middle of their parts: sideways away from the body, and up.
_BESIDE = {
    "Head": (0, 1.05), "Body": (1.4, -0.9), "Arm": (0, 0.6), "Hand": (0, -1.0),
    "Leg": (0.95, 0),
}  # fmt: skip


def story() -> np.ndarray:
    """Draw what an artist does with a character, from its mesh to collision hulls."""
    obj = shapes.figure()
    paint(obj, _GRAY)
    panels = [panel([obj], "1  a mesh", _SIZE, _TURN)]
    obj.data.materials.clear()
    extension.decompose(obj, parts=7)
    panels.append(panel([obj], "2  Decompose into 7: one hand", _SIZE, _TURN))
    extension.mirror(obj)
    panels.append(panel([obj], "3  Mirror: both hands", _SIZE, _TURN))
    rows = extension.rows(obj)
    for row, name in zip(rows, _names(obj), strict=True):
        row.name = name
    for row in rows:
        if row.name in ("Head", "Hand.L", "Hand.R"):
            row.color = _SKIN
    text = "4  names, and colors of one's own"
    panels.append(panel([obj, *_written(obj)], text, _SIZE, _TURN))
    extension.explode(obj, 0.35)
    panels.append(panel([obj], "5  Exploded View", _SIZE, _TURN))
    extension.implode(obj)
    hulls = [
        bpy.data.objects.new(each.name, each.data) for each in extension.hulls(obj)
    ]
    text = f"6  Build Hulls: {len(hulls)} hulls"
    panels.append(panel(hulls, text, _SIZE, _TURN))
    return below([beside(panels[:3]), beside(panels[3:])])


def _names(obj: bpy.types.Object) -> list[str]:
    """Return what a person would call each part, by where it lies."""
    names = []
    for x, _, z in _middles(obj):
        side = ".L" if x > 0 else ".R"
        if abs(x) < 0.2:
            names.append("Head" if z > 2.2 else "Body")
        elif z < 0:
            names.append("Leg" + side)
        else:
            names.append(("Hand" if abs(x) > 3 else "Arm") + side)
    return names


def _middles(obj: bpy.types.Object) -> np.ndarray:
    """Return the middle of the faces of each part, (K, 3)."""
    centers = np.array([face.center for face in obj.data.polygons])
    labels = extension.parts_of_faces(obj)
    return np.array(
        [centers[labels == k].mean(axis=0) for k in range(labels.max() + 1)]
    )


def _written(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Return the name of each part as an object beside the part."""
    turned = Euler((np.radians(68), 0, np.radians(_TURN)))
    ink = bpy.data.materials.new("Ink")
    ink.diffuse_color = (0.02, 0.02, 0.02, 1)
    found = []
    for row, middle in zip(extension.rows(obj), _middles(obj), strict=True):
        curve = bpy.data.curves.new(row.name, "FONT")
        curve.body, curve.size = row.name, _LETTERS
        curve.align_x = curve.align_y = "CENTER"
        curve.materials.append(ink)
        text = bpy.data.objects.new(row.name, curve)
        aside, up = _BESIDE[row.name.split(".")[0]]
        outwards = 1 if middle[0] > 0 else -1
        text.location = Vector(middle) + Vector((outwards * aside, 0, up))
        text.rotation_euler = turned
        found.append(text)
    return found
