"""What is noted on a mesh to bring it back: `wcd_restore`.

It is the mesh's, as groups, slots and attributes are, whichever of its objects was
active.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields

import bpy

from .notes import not_ours, read_note, write_note

_RESTORE = "wcd_restore"


@dataclass(frozen=True)
class Restore:
    """What it takes to bring a mesh back.

    Attributes
    ----------
    groups : list of str
        Names of the vertex groups that we made, in the order of the parts.
    active_group : str
        Name of the active group before; empty if there was none.
    slots : list of str
        Names of the materials in the slots before; empty for an empty slot.
    active_slot : int
        Index of the active slot of the object before.
    material_index : int or None
        The one material index that all faces had, None if they differed.
    had_material_index : bool
        Whether the mesh kept material indices at all.
    """

    groups: list[str]
    active_group: str
    slots: list[str]
    active_slot: int
    material_index: int | None
    had_material_index: bool


def read_restore(mesh: bpy.types.Mesh) -> Restore | None:
    """Return what was noted on a mesh, None if we have not written to it."""
    noted = read_note(mesh, _RESTORE)
    if not noted:
        return None
    if noted.keys() != {field.name for field in fields(Restore)}:
        raise not_ours(mesh, _RESTORE)
    return Restore(**noted)


def write_restore(mesh: bpy.types.Mesh, restore: Restore | None) -> None:
    """Note on a mesh how to bring it back; None removes the note."""
    write_note(mesh, _RESTORE, asdict(restore) if restore else {})


def has_parts(obj: bpy.types.Object) -> bool:
    """Return whether the mesh of an object has parts of ours."""
    return _RESTORE in obj.data
