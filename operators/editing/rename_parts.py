"""Rename many parts at once, in a dialog or from a script."""

from __future__ import annotations

import math
from typing import Any

import bpy

from ...core.errors import DecompositionError
from ..bridge.parts.read import part_identities
from ..bridge.parts.renaming import rename_parts
from ..bridge.refusals import edit_refusal
from ..running.on_objects import OnActive, OnEach
from .edit_parts import in_scope, scope
from .new_names import EditableName, editable, numbered, replaced, with_bases

# Rows in a column of the dialog, and the width of a column in points.
_ROWS = 16
_WIDTH = 340
_WAYS = (
    ("TYPE", "Type", "Type each name"),
    ("NUMBER", "Number", "Give all names a pattern with a number"),
    ("REPLACE", "Find & Replace", "Replace a text in all names"),
)


class WCD_PG_new_name(bpy.types.PropertyGroup):
    """A name in the dialog; `name` is the one before."""


WCD_PG_new_name.__annotations__ = {
    "new": bpy.props.StringProperty(name="Name", description="New name of the part")
}


class WCD_OT_rename_parts(OnActive, OnEach, bpy.types.Operator):
    """Rename all parts of an object, or the chosen ones."""

    bl_idname = "wcd.rename_parts"
    bl_label = "Rename Convex Parts"
    bl_description = (
        "Rename all parts in one dialog: type the names, number them, or find and"
        " replace. The two parts of a pair, .L and .R, keep one name"
    )
    _refusal = staticmethod(edit_refusal)
    _waits = False  # runs take names as they are at their end

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Ask for the names."""
        self.names.clear()
        rows = self._rows(context.active_object)
        for row in rows:
            name = self.names.add()
            name.name = name.new = row.base
        columns = math.ceil(len(rows) / _ROWS)
        answer: set[str] = context.window_manager.invoke_props_dialog(
            self, width=_WIDTH * columns
        )
        return answer

    def draw(self, context: bpy.types.Context) -> None:
        """Draw the way to rename, and the names that it gives."""
        layout, rows = self.layout, self._rows(context.active_object)
        layout.row().prop(self, "way", expand=True)
        names = ("pattern",) if self.way == "NUMBER" else ("find", "replace")
        for name in names if self.way != "TYPE" else ():
            layout.prop(self, name)
        try:
            bases = self._bases(rows)
        except DecompositionError as error:
            layout.label(text=str(error), icon="ERROR", translate=False)
            return
        flow = layout.column_flow(columns=math.ceil(len(rows) / _ROWS))
        for place, (row, base) in enumerate(zip(rows, bases, strict=True)):
            split = flow.split(factor=0.42)
            sides = "  .L .R" if len(row.endings) > 1 else ""
            split.label(text=row.base + sides, translate=False)
            if self.way == "TYPE" and place < len(self.names):
                split.activate_init = not place  # the first name is ready to be typed
                split.prop(self.names[place], "new", text="")
            else:
                split.label(text=base, translate=False)

    def _rows(self, obj: bpy.types.Object) -> list[EditableName]:
        """Return the names to edit."""
        names = [each.name for each in part_identities(obj)]
        return editable(names, in_scope(obj, self.scope))

    def _bases(self, rows: list[EditableName]) -> list[str]:
        """Return the new base of each row."""
        if self.way == "NUMBER":
            return numbered(rows, self.pattern)
        if self.way == "REPLACE":
            return replaced(rows, self.find, self.replace)
        typed = {each.name: each.new for each in self.names}
        return [typed.get(row.base, row.base) for row in rows]

    def _work(self, obj: bpy.types.Object) -> None:
        rows, identities = self._rows(obj), part_identities(obj)
        names = with_bases(rows, self._bases(rows))
        by_number = {identities[place].number: name for place, name in names.items()}
        for reason in rename_parts(obj, by_number):
            self.report({"WARNING"}, f"{reason}.")


WCD_OT_rename_parts.__annotations__ = {
    "way": bpy.props.EnumProperty(name="Way", description="How to rename", items=_WAYS),
    "pattern": bpy.props.StringProperty(
        name="Pattern",
        description="The new names; # is the number, ## has two digits",
        default="Part ##",
    ),
    "find": bpy.props.StringProperty(name="Find", description="Text in the names"),
    "replace": bpy.props.StringProperty(
        name="Replace", description="Text that takes its place"
    ),
    "names": bpy.props.CollectionProperty(type=WCD_PG_new_name, options={"SKIP_SAVE"}),
    "scope": scope("ALL", "Names Of", "The parts that are renamed"),
}

CLASSES: tuple[Any, ...] = (WCD_PG_new_name, WCD_OT_rename_parts)
