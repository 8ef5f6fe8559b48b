"""Hulls that a file has beside its models, so that they are not taken for models."""

from __future__ import annotations

import json
import re

import bpy

from ....core.parameters.hull_names import UNREAL_PREFIXES
from ...bridge.hulls.listed import is_hull
from ...bridge.stored.names import HULL_TAG
from ..current_file import some_of
from ..shear import put_below

# How Unreal knows hulls: UCX_Name_01, of the mesh called Name.
_UNREAL = re.compile(rf"(?:{'|'.join(UNREAL_PREFIXES.values())})_(.+?)(_\d+)?")


def adopt_hulls() -> None:
    """Make hulls of a file the children of their objects, as those of ours are.

    These are the meshes whose name says so, by Unreal's rule, and hulls that we wrote
    to a format without parents. A file of hulls alone has no such objects: they are
    its models.
    """
    meshes = [obj for obj in bpy.data.objects if obj.type == "MESH"]
    models = {obj.name: obj for obj in meshes if not _is_named_hull(obj)}
    for hull in meshes:
        owner = None if is_hull(hull) else _owner_of(hull, models)
        if owner is None:
            continue
        put_below(hull, owner, hull.matrix_world.copy())
        if HULL_TAG not in hull:
            hull[HULL_TAG] = json.dumps({"kind": "HULL"})


def hull_note() -> str | None:
    """Return a sentence about the hulls of the file that was loaded; None without."""
    names = sorted(obj.name for obj in bpy.data.objects if is_hull(obj))
    if not names:
        return None
    return f"Hulls in the file are no models and were not decomposed: {some_of(names)}."


def _is_named_hull(obj: bpy.types.Object) -> bool:
    """Return whether an object has the mark of our hulls, or a name of Unreal's."""
    return HULL_TAG in obj or _UNREAL.fullmatch(obj.name) is not None


def _owner_of(
    hull: bpy.types.Object, models: dict[str, bpy.types.Object]
) -> bpy.types.Object | None:
    """Return the object that a hull belongs to, None if there is none."""
    named = _UNREAL.fullmatch(hull.name)
    if named:
        for name in (hull.name[4:], named[1]):
            if name in models:
                return models[name]
    if HULL_TAG not in hull:
        return None
    within = [name for name in models if name in hull.name]
    return models[max(within, key=len)] if within else None
