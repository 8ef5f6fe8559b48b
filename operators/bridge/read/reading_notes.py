"""What the user is told about what was read of an object."""

from __future__ import annotations

import bpy

from .carrier import is_waiting
from .shown_mesh import shown_modifiers, shows_keys


def reading_notes(obj: bpy.types.Object) -> tuple[str, ...]:
    """Return sentences to the user about what was read of an object."""
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
            f" ({', '.join(modifiers)}); apply them, or choose the evaluated mesh, to"
            " include them."
        )
    if shows_keys(obj):
        notes.append("The mesh was read in its Basis shape, without shape keys.")
    if obj.data.users > 1:  # objects are counted only then: files have thousands
        sharers = sum(other.data == obj.data for other in bpy.data.objects)
        if sharers > 1:
            notes.append(
                f"{sharers} objects share this mesh: the parts show on all of them."
            )
    return tuple(notes)
