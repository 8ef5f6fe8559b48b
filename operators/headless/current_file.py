"""The file that is open in Blender: emptied before a load, its objects, their names."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..bridge.homes import view_layers
from ..bridge.hulls.listed import is_hull
from ..bridge.mesh.points import count_points, is_cloud
from ..bridge.refusals import WORKED_ON
from .quiet import quiet_blender

# Most names in a sentence.
_MOST_NAMES = 3


def open_empty_file() -> None:
    """Open an empty file; the user's settings and extensions stay as they are."""
    with quiet_blender():
        bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)


def mesh_objects() -> list[bpy.types.Object]:
    """Return the meshes and point clouds of the file.

    Returns
    -------
    list of Object
        Sorted by name. Only objects in a view layer, and no hulls from an earlier run:
        building hulls again replaces them.
    """
    found = [
        obj
        for obj in objects_in_view_layers()
        if obj.type in WORKED_ON and not is_hull(obj)
    ]
    return sorted(found, key=lambda obj: obj.name_full)


def objects_in_view_layers() -> set[bpy.types.Object]:
    """Return the objects of all view layers of all scenes, hidden or not."""
    return {obj for layer in view_layers() for obj in layer.objects}


def has_shape(obj: bpy.types.Object) -> bool:
    """Return whether one of `mesh_objects` has faces, or is a cloud with points."""
    return bool(count_points(obj) if is_cloud(obj) else obj.data.polygons)


def some_of(names: Sequence[str]) -> str:
    """Return the first of many names for a note, and how many more there are."""
    more = len(names) - _MOST_NAMES
    shown = ", ".join(names[:_MOST_NAMES])
    return f"{shown} and {more} more" if more > 0 else shown
