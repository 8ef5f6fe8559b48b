"""Curves and their like in a file, which are left out, so that somebody says so."""

from __future__ import annotations

import bpy

from ...bridge.refusals import CONVERTIBLE
from ..current_file import objects_in_view_layers


def convertible_note() -> str | None:
    """Return a sentence about curves, texts and their like with faces; None without.

    Paths and outlines are not seen, and what shapes other curves is there for these.
    """
    helpers = {
        each
        for curve in bpy.data.curves
        for each in (curve.bevel_object, curve.taper_object)
    }
    others = (obj for obj in objects_in_view_layers() if obj.type in CONVERTIBLE)
    number = sum(obj not in helpers and _has_faces(obj) for obj in others)
    if number == 0:
        return None
    which, what = f"{number:,} curves, texts or metaballs get", "them to meshes"
    if number == 1:
        which, what = "A curve, text or metaball gets", "it to a mesh"
    return (
        f"{which} neither parts nor hulls; convert {what} first"
        " (Object > Convert > Mesh)."
    )


def _has_faces(obj: bpy.types.Object) -> bool:
    """Return whether Blender shows faces of what is no mesh, or would if it were shown.

    What is hidden is not evaluated. Others may have no faces before, such as metaballs.
    """
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return any(_has_faces_now(each) for each in (obj, evaluated))


def _has_faces_now(obj: bpy.types.Object) -> bool:
    """Return whether an object, evaluated or not, has faces as a mesh."""
    mesh = obj.to_mesh()
    try:
        return bool(mesh and mesh.polygons)
    finally:
        obj.to_mesh_clear()
