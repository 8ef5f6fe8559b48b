"""The rows of the table of parts: which parts the user has ticked, locked and renamed.

Figures, colors and order come from the mesh and the record. Rows are Blender
properties, so that undo, saving and copying treat them like all other data.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import bpy

from ....core.parameters.hulls import SHAPES
from ..stored.identity import Identity
from .read import part_identities
from .renaming import color_of_part, recolor_part, rename_part

# The choice of a part whose hull has the shape that is set for all.
AS_SET = "AS_SET"


def _rename(row: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    name = rename_part(row.id_data, row.number, row.name.strip())
    if name != row.name:
        row.name = name


def _color(row: bpy.types.PropertyGroup) -> tuple[float, float, float]:
    return color_of_part(row.id_data, row.number)


def _recolor(row: bpy.types.PropertyGroup, color: Sequence[float]) -> None:
    red, green, blue = color
    recolor_part(row.id_data, row.number, (red, green, blue))


class WCD_PG_part(bpy.types.PropertyGroup):
    """A part in the table."""


WCD_PG_part.__annotations__ = {
    "name": bpy.props.StringProperty(
        name="Name",
        description="Name of the part, its vertex group and its material",
        update=_rename,
    ),
    "number": bpy.props.IntProperty(options={"HIDDEN"}),
    "color": bpy.props.FloatVectorProperty(
        name="Color",
        description="Color of the part on this object",
        subtype="COLOR",
        min=0.0,
        max=1.0,
        get=_color,
        set=_recolor,
    ),
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
    "hull_shape": bpy.props.EnumProperty(
        name="Hull Shape",
        description="Shape of this part's hull, if each part gets one",
        items=(
            (AS_SET, "As Set", "The shape that is set for all"),
            *((each.identifier, each.label, each.help) for each in SHAPES),
        ),
    ),
}


@dataclass(frozen=True)
class Row:
    """The state of a row that nothing else holds."""

    chosen: bool
    locked: bool
    active: bool
    hull_shape: str


def kept_rows(obj: bpy.types.Object) -> dict[int, Row]:
    """Return the state of an object's rows, by the numbers of the parts."""
    active = obj.wcd_active_part
    return {
        row.number: Row(row.chosen, row.locked, place == active, row.hull_shape)
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
        before = kept.get(identity.number, Row(False, False, False, AS_SET))
        row.chosen, row.locked = before.chosen, before.locked
        row.hull_shape = before.hull_shape
        if before.active:
            obj.wcd_active_part = place


def erase_rows(obj: bpy.types.Object) -> None:
    """Remove the table from an object."""
    for name in ("wcd_parts", "wcd_active_part"):
        obj.property_unset(name)


def chosen_numbers(obj: bpy.types.Object) -> set[int]:
    """Return the numbers of the ticked parts, or of the highlighted one without ticks.

    Faces are not looked at, so it is quick enough for each time a viewport is drawn.
    """
    ticked = {row.number for row in obj.wcd_parts if row.chosen}
    place = obj.wcd_active_part
    highlighted = obj.wcd_parts[place : place + 1] if place >= 0 else ()
    return ticked or {row.number for row in highlighted}


def chosen_parts(obj: bpy.types.Object) -> list[int]:
    """Return the places of the ticked parts, or of the highlighted one without ticks.

    Places are among the parts that the object has now, by number. Rows of parts that
    have no faces do not count.
    """
    ticked = {row.number for row in obj.wcd_parts if row.chosen}
    identities = part_identities(obj)
    places = [p for p, each in enumerate(identities) if each.number in ticked]
    return places or [active_part(obj)]


def hull_shapes(obj: bpy.types.Object) -> dict[int, str]:
    """Return the shapes that the user chose for hulls of single parts, by place."""
    chosen = {row.number: row.hull_shape for row in obj.wcd_parts}
    return {
        place: chosen[each.number]
        for place, each in enumerate(part_identities(obj))
        if chosen.get(each.number, AS_SET) != AS_SET
    }


def active_part(obj: bpy.types.Object) -> int:
    """Return the place of the highlighted part, or of the first if it has no faces."""
    numbers = [each.number for each in part_identities(obj)]
    row = min(max(obj.wcd_active_part, 0), len(obj.wcd_parts) - 1)
    number = obj.wcd_parts[row].number if row >= 0 else None
    return numbers.index(number) if number in numbers else 0


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
