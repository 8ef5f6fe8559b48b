"""The rows of the table of parts: which parts the user has ticked, locked and renamed.

Figures, colors and order come from the mesh and the record. Rows are Blender
properties, so that undo, saving and copying treat them like all other data.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import bpy

from ....core.parameters.hulls import SHAPES
from ..mesh.layers import let_undo_see_all
from ..registering import own, register_class
from ..stored.identity import Identity, rgb
from . import renaming
from .read import part_identities

# The choice of a part whose hull has the shape that is set for all.
AS_SET = "AS_SET"
# The number of a row that is being made.
_NO_NUMBER = -1
# Seconds for which a row that was clicked shows its part in the viewports.
_LOOK = 1.5
# The object whose row was clicked latest, and when, by `time.monotonic`.
_looked: tuple[int, float] | None = None


def _rename(row: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    obj = row.id_data
    if row.number == _NO_NUMBER:  # it is being made
        return
    typed = row.name.strip()
    name, reason = renaming.rename_part(obj, row.number, typed)
    if name != row.name:
        row.name = name  # this asks for the name that the part has, which is no news
    let_undo_see_all(obj)
    renaming.refused = (obj.session_uid, row.number, typed) if reason else None


def _set(row: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Let undo take back what was set, in Edit Mode too."""
    if row.number != _NO_NUMBER:  # it is not being made
        let_undo_see_all(row.id_data)


def _tick(row: bpy.types.PropertyGroup, context: bpy.types.Context) -> None:
    """Keep the highlight on a ticked row, as long as there is one."""
    _set(row, context)
    obj = row.id_data
    active = active_row(obj)
    ticked = [place for place, each in enumerate(obj.wcd_parts) if each.chosen]
    # A click on another row takes ticks away, too; that highlight stays.
    if ticked and not active.chosen and (row.chosen or row == active):
        obj.wcd_active_part = ticked[0]


def _highlight(obj: bpy.types.Object, context: bpy.types.Context) -> None:
    """Take all ticks away when a row is highlighted that is not ticked."""
    global _looked
    _looked = obj.session_uid, time.monotonic()
    let_undo_see_all(obj)
    active = active_row(obj)
    for row in obj.wcd_parts if active and not active.chosen else ():
        if row.chosen:
            row.chosen = False


def _color(row: bpy.types.PropertyGroup) -> tuple[float, float, float]:
    return renaming.color_of_part(row.id_data, row.number)


def _recolor(row: bpy.types.PropertyGroup, color: Sequence[float]) -> None:
    renaming.recolor_part(row.id_data, row.number, rgb(color))
    _set(row, bpy.context)


class WCD_PG_part(bpy.types.PropertyGroup):
    """A part in the list."""


WCD_PG_part.__annotations__ = {
    "name": bpy.props.StringProperty(
        name="Name",
        description="Name of the part, its vertex group and its material",
        update=_rename,
    ),
    "number": bpy.props.IntProperty(default=_NO_NUMBER, options={"HIDDEN"}),
    "color": bpy.props.FloatVectorProperty(
        name="Color",
        description="Color of the part on this object",
        subtype="COLOR",
        min=0.0,
        max=1.0,
        default=renaming.UNSET,
        get=_color,
        set=_recolor,
    ),
    "chosen": bpy.props.BoolProperty(
        name="Choose",
        description="Let the buttons act on this part and all others that are ticked. A"
        " click on a row that is not ticked takes the ticks away",
        update=_tick,
    ),
    "locked": bpy.props.BoolProperty(
        name="Lock",
        description="Keep this part when the object is decomposed again. Locked parts"
        " count towards the number of Parts",
        update=_set,
    ),
    "hull_shape": bpy.props.EnumProperty(
        name="Hull Shape",
        description="Shape of this part's hull, if each part gets one",
        items=(
            (AS_SET, "As Set", "The shape that is set for all"),
            *((each.identifier, each.label, each.help) for each in SHAPES),
        ),
        update=_set,
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
    global _looked
    obj.wcd_parts.clear()
    active = 0
    for place, identity in enumerate(identities):
        row = obj.wcd_parts.add()
        before = kept.get(identity.number, Row(False, False, False, AS_SET))
        row.chosen, row.locked = before.chosen, before.locked
        row.hull_shape = before.hull_shape
        row.name = identity.name
        row.number = identity.number  # last: the others are no news
        active = place if before.active else active
    obj.wcd_active_part = active  # last, because ticks move it
    _looked = None  # nobody has clicked it
    renaming.forget_refused()


def erase_rows(obj: bpy.types.Object) -> None:
    """Remove the table from an object."""
    for name in ("wcd_parts", "wcd_active_part"):
        obj.property_unset(name)


def chosen_numbers(obj: bpy.types.Object) -> set[int]:
    """Return the numbers of the parts that buttons act on.

    They are those of the ticked rows, or of the highlighted row if none is ticked. A
    click on a row that is not ticked takes all ticks away, and a tick highlights its
    row, so that the highlighted row is always one of them. Faces are not looked at.
    """
    active = active_row(obj)
    if active is None:
        return set()
    if not active.chosen:
        return {active.number}
    return {row.number for row in obj.wcd_parts if row.chosen}


def chosen_parts(obj: bpy.types.Object) -> list[int]:
    """Return the places of the parts that buttons act on: see `chosen_numbers`.

    Places are among the parts that the object has now, by number. Rows of parts that
    have no faces do not count; if there are no others, it is the first part.
    """
    numbers = chosen_numbers(obj)
    identities = part_identities(obj)
    places = [p for p, each in enumerate(identities) if each.number in numbers]
    return places or [0]


def hull_shapes(obj: bpy.types.Object) -> dict[int, str]:
    """Return the shapes that the user chose for hulls of single parts, by place."""
    chosen = {row.number: row.hull_shape for row in obj.wcd_parts}
    return {
        place: chosen[each.number]
        for place, each in enumerate(part_identities(obj))
        if chosen.get(each.number, AS_SET) != AS_SET
    }


def look_left(obj: bpy.types.Object) -> float:
    """Return for how many seconds viewports still show a row that was clicked."""
    if _looked is None or _looked[0] != obj.session_uid:
        return 0.0
    return max(_looked[1] + _LOOK - time.monotonic(), 0.0)


def active_row(obj: bpy.types.Object) -> Any:
    """Return the highlighted row, None if there are no rows."""
    last = len(obj.wcd_parts) - 1
    return obj.wcd_parts[min(max(obj.wcd_active_part, 0), last)] if last >= 0 else None


def noted_refusal(obj: bpy.types.Object) -> str | None:
    """Return why the highlighted part did not get the name that was typed latest."""
    row = active_row(obj)
    return row and renaming.noted_refusal(obj, row.number)


def active_part(obj: bpy.types.Object) -> int:
    """Return the place of the highlighted part, or of the first if it has no faces."""
    numbers = [each.number for each in part_identities(obj)]
    row = active_row(obj)
    number = None if row is None else row.number
    return numbers.index(number) if number in numbers else 0


def register() -> None:
    """Add the table's properties to objects."""
    register_class(WCD_PG_part)
    bpy.types.Object.wcd_parts = bpy.props.CollectionProperty(type=WCD_PG_part)
    active = bpy.props.IntProperty(
        name="Part", description="The highlighted part", update=_highlight
    )
    bpy.types.Object.wcd_active_part = own(active)


def unregister() -> None:
    """Undo `register`."""
    del bpy.types.Object.wcd_active_part
    del bpy.types.Object.wcd_parts
    bpy.utils.unregister_class(WCD_PG_part)
