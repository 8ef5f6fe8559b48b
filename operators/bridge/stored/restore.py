"""The note on a mesh that says how to bring it back.

It is on the mesh and not on the object, because groups, slots and attributes are the
mesh's, too: several objects may share one.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields

import bpy

from .names import RESTORE
from .notes import not_ours, read_note, write_note


@dataclass(frozen=True)
class Restore:
    """The state of a mesh before parts were written to it.

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
        The material index of all faces, None if faces had different ones.
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
    noted = read_note(mesh, RESTORE)
    if not noted:
        return None
    if noted.keys() != {field.name for field in fields(Restore)}:
        raise not_ours(mesh, RESTORE)
    return Restore(**noted)


def write_restore(mesh: bpy.types.Mesh, restore: Restore | None) -> None:
    """Note on a mesh how to bring it back; None removes the note."""
    write_note(mesh, RESTORE, asdict(restore) if restore else {})


def has_parts(obj: bpy.types.Object) -> bool:
    """Return whether the mesh of an object has parts of ours."""
    return RESTORE in obj.data
