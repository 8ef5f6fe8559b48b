"""What the user is told about what was read of an object."""

from __future__ import annotations

import bpy

from .carrier import is_waiting
from .shown_mesh import shown_modifiers, shows_keys


def reading_notes(obj: bpy.types.Object, for_parts: bool = True) -> tuple[str, ...]:
    """Return sentences to the user about what was read of an object.

    Parameters
    ----------
    obj : bpy.types.Object
    for_parts : bool, optional
        Whether it was read to write parts to it, which objects may share.
    """
    if is_waiting(obj):
        curve = obj.parent.name
        return (
            f'Parts are on faces: they are on the new mesh object "{curve} parts",'
            f" and {curve} is hidden.",
        )
    notes = []
    modifiers = [modifier.name for modifier in shown_modifiers(obj)]
    if modifiers:
        notes.append(
            "The mesh was read without its modifiers"
            f" ({', '.join(modifiers)}); apply them, or choose the evaluated mesh"
            " (--apply-modifiers on the command line), to include them."
        )
    if shows_keys(obj):
        notes.append("The mesh was read in its Basis shape, without shape keys.")
    if for_parts and obj.data.users > 1:  # else not counted: files have thousands
        sharers = sum(
            other.data == obj.data and bool(other.users_collection)
            for other in bpy.data.objects
        )
        if sharers > 1:
            notes.append(
                f"{sharers} objects share this mesh: the parts show on all of them."
            )
    return tuple(notes)
