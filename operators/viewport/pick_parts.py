"""Pick Parts: hover, click and act on the parts in the viewport itself."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...core.parameters.parameter import field_of, info_of
from ...core.parameters.parts import Parameters
from ..bridge.parts.rows import chosen_numbers
from ..bridge.refusals import edit_refusal, faces_refusal
from ..bridge.stored.names import RESULT
from ..bridge.watching import start_timer
from ..running import modal
from ..running.modal import is_free
from . import picking
from .choose_parts import choose_too
from .part_at import make_tree, part_at
from .shown_parts import n_parts_of
from .turning import Turning, keeps
from .viewports import CLICKED_MODES, navigates, no_viewport, viewport_at

# The pie menu, which `ui` draws.
_MENU = "WCD_MT_pick"
# What each key adds to the number of parts; wheels do with Alt.
_WHEELS = {"WHEELUPMOUSE": 1, "WHEELDOWNMOUSE": -1}
_PAGES = {"PAGE_UP": 1, "PAGE_DOWN": -1}
_FEWEST = int(info_of(field_of(Parameters, "min_parts")).low)
_MOST = int(info_of(field_of(Parameters, "parts")).high)
_ENTER = {"RET", "NUMPAD_ENTER"}


class WCD_OT_pick_parts(bpy.types.Operator):
    """Choose parts in the viewport, and act on them."""

    bl_idname = "wcd.pick_parts"
    bl_label = "Pick Parts"
    bl_description = (
        "Point at parts in the viewport. Click to choose one, Shift-click to add one,"
        " right-click for a menu. Alt and the mouse wheel change the number of parts;"
        " Esc goes back to the number before"
    )
    bl_options: ClassVar[set[str]] = set()

    # The number of parts that was asked for, and the one that is being cut; 0 for none.
    _asked: int = 0
    _cut_last: int = 0
    _right: bool = False  # whether the right mouse button is down
    # What ran when the last event came, how many parts the active object had, and in
    # which workspace.
    _told: tuple[str | None, int, str] | None = None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether an object has parts that can be picked."""
        return is_free(cls, _refusal(context))

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin, or end if parts are picked already."""
        if picking.current is not None:
            picking.stop()
            return {"FINISHED"}
        # Both are read now, and not when something hovers.
        n_parts_of(context.active_object)
        start_timer(make_tree)
        self._picking = picking.start(context)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Stop: Blender closes the window or loads another file."""
        picking.stop()

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take an event; navigation and all else that is not ours passes."""
        if self._is_over(context):
            return {"FINISHED", "PASS_THROUGH"}
        place = context.workspace.name
        now = modal.busy(), n_parts_of(context.active_object), place
        if self._told != now:
            self._told = now
            self._picking.go_to(place)
            picking.tell(context)
        if self._asked:
            self._cut(context)
        if event.type == "MOUSEMOVE":
            return self._hover(context, event.mouse_x, event.mouse_y)
        if event.type == "RIGHTMOUSE" and event.value == "RELEASE" and self._right:
            self._right = False
            return self._open_menu(context)
        if event.value != "PRESS":
            return {"PASS_THROUGH"}
        if self._keep(context, event) and event.type in _ENTER:
            return {"RUNNING_MODAL"}
        return self._press(context, event)

    def _is_over(self, context: bpy.types.Context) -> bool:
        """Return whether the picking has ended; end it if other modes take clicks."""
        if context.mode not in CLICKED_MODES:
            picking.stop()
        return picking.current is not self._picking  # or by the button, or by a load

    def _keep(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Keep the number of parts that the wheel asked for if a press means that."""
        kept = self._picking.turning is not None and keeps(event)
        if kept:
            self._picking.turning = None
            picking.tell(context)
        return kept

    def _press(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take a pressed key or button."""
        if event.type == "ESC":
            return self._escape(context)
        there = viewport_at(context, event.mouse_x, event.mouse_y)
        if there is None or navigates(event):
            return {"PASS_THROUGH"}
        if event.type == "LEFTMOUSE":
            self._click(context, event.shift)
            return {"RUNNING_MODAL"}
        if event.type == "RIGHTMOUSE":  # its release would close a menu
            self._right = True
            return {"RUNNING_MODAL"}
        if event.type == "W" and not _modified(event):
            return self._open_menu(context)
        step = (_WHEELS if event.alt else _PAGES).get(event.type)
        if step is None:
            return {"PASS_THROUGH"}
        self._count(context, step)
        return {"RUNNING_MODAL"}

    def _hover(self, context: bpy.types.Context, x: int, y: int) -> set[str]:
        """Look up what is under the cursor."""
        there = viewport_at(context, x, y)
        found = part_at(context, *there) if there else None
        hovered = found and (found[0].session_uid, found[1])
        before, self._picking.hovered = self._picking.hovered, hovered
        self._picking.place = x, y
        if hovered != before:
            picking.tell(context)
        elif hovered and there:  # its name goes with the cursor
            there[0].tag_redraw()
        return {"PASS_THROUGH"}

    def _escape(self, context: bpy.types.Context) -> set[str]:
        """Leave a merge that waits, or the numbers of the wheel, else the picking."""
        merging, turning = self._picking.merging, self._picking.turning
        self._picking.merging, self._picking.turning = False, None
        if turning is not None and not merging:
            self._asked = self._cut_last = 0
            modal.stop()  # the cut that runs, if any
            if not turning.take_back():
                n_before = turning.n_before
                self.report({"WARNING"}, f"Undo cannot go back to {n_before} parts")
        if merging or turning is not None:
            picking.tell(bpy.context)
            return {"RUNNING_MODAL"}
        picking.stop()
        return {"FINISHED"}

    def _click(self, context: bpy.types.Context, extend: bool) -> None:
        """Choose the part under the cursor, or merge it with those that are chosen."""
        obj, part = self._picking.object(), self._picking.part()
        if part is None:
            return
        number = part.number
        if not self._picking.merging:
            self._choose(obj, number, extend)
        elif obj != context.active_object:
            self.report({"WARNING"}, f"Click a part of {context.active_object.name}")
            return
        elif number not in chosen_numbers(obj):
            self._picking.merging = False
            choose_too(obj, number)  # the result has the name of the highlighted one
            self._call(bpy.ops.wcd.merge_parts)
        picking.tell(context)

    def _open_menu(self, context: bpy.types.Context) -> set[str]:
        """Open the menu for the part under the cursor; leave where there is none."""
        obj, part = self._picking.object(), self._picking.part()
        if part is None or self._picking.merging or self._picking.turning:
            return self._escape(context)
        if obj != context.active_object or part.number not in chosen_numbers(obj):
            self._choose(obj, part.number, extend=False)
        bpy.ops.wm.call_menu_pie("INVOKE_DEFAULT", name=_MENU)
        return {"RUNNING_MODAL"}

    def _count(self, context: bpy.types.Context, step: int) -> None:
        """Ask for one part more or less, from what was asked for last."""
        obj = context.active_object
        if edit_refusal(obj) is None:
            now = self._asked or n_parts_of(obj)
            if self._picking.turning is None:
                self._picking.turning = Turning.of(obj)
            self._asked = min(max(now + step, _FEWEST), _MOST)
            self._cut(context)
            picking.tell(context)

    def _cut(self, context: bpy.types.Context) -> None:
        """Cut the active object into as many parts as were asked for, as the chart."""
        if modal.busy() is not None:
            return
        if self._asked == self._cut_last:
            self._asked = self._cut_last = 0
            return
        self._cut_last = self._asked
        if self._picking.turning is not None:
            self._picking.turning.n_steps += 1
        self._call(bpy.ops.wcd.choose_part_count, parts=self._asked)

    def _choose(self, obj: bpy.types.Object, number: int, extend: bool) -> None:
        """Choose a part as a step of its own to undo to."""
        operator = bpy.ops.wcd.choose_part
        self._call(operator, object=obj.name, number=number, extend=extend)

    def _call(self, operator: Any, **values: str | int) -> None:
        """Start an operator as its button does; tell if it cannot work."""
        try:
            operator("INVOKE_DEFAULT", True, **values)
        except RuntimeError as error:  # what it reports, or why it cannot be called
            self.report({"WARNING"}, str(error).removeprefix("Error: ").strip())


CLASSES = (WCD_OT_pick_parts,)


def _refusal(context: bpy.types.Context) -> str | None:
    """Return why no parts can be picked."""
    if reason := no_viewport(context):
        return reason
    if context.mode not in CLICKED_MODES:
        return "Parts are picked in Object Mode, or a mesh's Edit Mode; switch the mode"
    reason = faces_refusal(context.active_object)
    noted = (obj for obj in context.visible_objects if RESULT in obj)
    if reason and any(not faces_refusal(obj) for obj in noted):
        return None
    return reason


def _modified(event: bpy.types.Event) -> bool:
    """Return whether a key is pressed together with a modifier key."""
    return event.ctrl or event.alt or event.shift or event.oskey
