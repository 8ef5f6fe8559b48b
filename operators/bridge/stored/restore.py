"""The note on a mesh that says how to bring it back.

It is on the mesh and not on the object, because groups, slots and attributes are the
mesh's, too: several objects may share one.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import bpy

from .forms import NONE, has_form
from .names import MATERIAL_NAME, MATERIAL_TAG, OWNER_LAYER, PART_LAYER, RESTORE
from .notes import not_ours, read_note, write_note

_FORM = {
    "groups": [str],
    "active_group": str,
    "slots": [str],
    "active_slot": int,
    "material_index": (int, NONE),
    "had_material_index": bool,
    "user_groups": ([str], NONE),
    "tagged": [str],
}


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
    user_groups : list of str or None
        Names of the vertex groups before; None if the note was lost.
    tagged : list of str
        Which of `slots` were made for parts, of another object or of what this one was
        separated from.
    """

    groups: list[str]
    active_group: str
    slots: list[str]
    active_slot: int
    material_index: int | None
    had_material_index: bool
    user_groups: list[str] | None
    tagged: list[str]

    def had(self, material: bpy.types.Material) -> bool:
        """Return whether a material that was made for a part was in a slot before.

        The names of other materials do not count: the user may rename such a material,
        and a part can get the name then.
        """
        return material.name in self.tagged


def read_restore(mesh: bpy.types.Mesh) -> Restore | None:
    """Return what was noted on a mesh, None if we have not written to it.

    Blender drops the note where an object with parts is joined to one without, and
    where it makes a new mesh. Then the materials of the parts say what is ours, or the
    mark on faces whose parts' colors are an overlay.
    """
    noted = read_note(mesh, RESTORE)
    if not noted:
        return _guessed(mesh)
    if noted.keys() != _FORM.keys() or not has_form(noted, _FORM):
        raise not_ours(mesh, RESTORE)
    return Restore(**noted)


def _guessed(mesh: bpy.types.Mesh) -> Restore | None:
    """Return how to bring back a mesh that has lost its note, None without parts."""
    if PART_LAYER not in getattr(mesh, "attributes", ()):
        return None
    ours = [m for m in mesh.materials if m and isinstance(m.get(MATERIAL_TAG), int)]
    users = [m.name if m else "" for m in mesh.materials if m not in ours]
    if not ours and OWNER_LAYER not in mesh.attributes:
        return None
    return Restore(
        groups=[m[MATERIAL_NAME] for m in ours if MATERIAL_NAME in m],
        active_group="",
        slots=users,
        active_slot=0,
        material_index=0,
        had_material_index=bool(users),
        user_groups=None,
        tagged=[],
    )


def write_restore(mesh: bpy.types.Mesh, restore: Restore | None) -> None:
    """Note on a mesh how to bring it back; None removes the note."""
    write_note(mesh, RESTORE, asdict(restore) if restore else {})


def sharers(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """Return the objects that use the mesh of an object and can be changed, by name."""
    if obj.data.users == 1:  # files have thousands of objects
        return [obj]
    return [o for o in bpy.data.objects if o.data == obj.data and o.is_editable]


def has_parts(obj: bpy.types.Object) -> bool:
    """Return whether the mesh of an object has parts of ours."""
    return RESTORE in obj.data or _guessed(obj.data) is not None
