"""The rows of the table of parts: which parts the user has ticked, locked and renamed.

Figures, colors and order come from the record. Rows are Blender properties, so that
undo, saving and copying treat them like all other data.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import bpy

from ..stored.identity import Identity
from .renaming import rename_part


def _rename(row: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    obj = row.id_data
    index = int(row.path_from_id().rpartition("[")[2].rstrip("]"))
    name = rename_part(obj, index, row.name.strip())
    if name != row.name:
        row.name = name


class WCD_PG_part(bpy.types.PropertyGroup):
    """A part in the table."""


WCD_PG_part.__annotations__ = {
    "name": bpy.props.StringProperty(
        name="Name",
        description="Name of the part, its vertex group and its material",
        update=_rename,
    ),
    "number": bpy.props.IntProperty(options={"HIDDEN"}),
    "chosen": bpy.props.BoolProperty(
        name="Choose",
        description="Let the buttons act on this part. If no part is ticked, they act"
        " on the highlighted one",
    ),
    "locked": bpy.props.BoolProperty(
        name="Lock",
        description="Keep this part when the object is decomposed again. Locked parts"
        " count towards the number of Parts",
    ),
}


@dataclass(frozen=True)
class Row:
    """The state of a row that the record does not hold."""

    chosen: bool
    locked: bool
    active: bool


def kept_rows(obj: bpy.types.Object) -> dict[int, Row]:
    """Return the state of an object's rows, by the numbers of the parts."""
    return {
        row.number: Row(row.chosen, row.locked, place == active_part(obj))
        for place, row in enumerate(obj.wcd_parts)
    }


def write_rows(
    obj: bpy.types.Object, identities: Iterable[Identity], kept: dict[int, Row]
) -> None:
    """Replace the rows of the table; parts that had a row keep its state."""
    obj.wcd_parts.clear()
    obj.wcd_active_part = 0
    for place, identity in enumerate(identities):
        row = obj.wcd_parts.add()
        row.number, row.name = identity.number, identity.name
        before = kept.get(identity.number, Row(False, False, False))
        row.chosen, row.locked = before.chosen, before.locked
        if before.active:
            obj.wcd_active_part = place


def erase_rows(obj: bpy.types.Object) -> None:
    """Remove the table from an object."""
    for name in ("wcd_parts", "wcd_active_part"):
        obj.property_unset(name)


def chosen_parts(obj: bpy.types.Object) -> list[int]:
    """Return the ticked parts, or the highlighted one if none is ticked."""
    ticked = [index for index, row in enumerate(obj.wcd_parts) if row.chosen]
    return ticked or [active_part(obj)]


def active_part(obj: bpy.types.Object) -> int:
    """Return the highlighted part."""
    return min(max(obj.wcd_active_part, 0), len(obj.wcd_parts) - 1)


def register() -> None:
    """Add the table's properties to objects."""
    bpy.utils.register_class(WCD_PG_part)
    bpy.types.Object.wcd_parts = bpy.props.CollectionProperty(type=WCD_PG_part)
    bpy.types.Object.wcd_active_part = bpy.props.IntProperty(
        name="Part", description="The highlighted part"
    )


def unregister() -> None:
    """Undo `register`."""
    del bpy.types.Object.wcd_active_part
    del bpy.types.Object.wcd_parts
    bpy.utils.unregister_class(WCD_PG_part)
