"""What is picked in the viewports: the part under the cursor, for `ui` to draw.

Hovering changes nothing in Blender's data, so nothing has to be put back after it.
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ..bridge.read.target import object_with
from ..bridge.stored.identity import Identity
from ..running import modal
from .shown_parts import n_parts_of, shown_identities
from .turning import Turning
from .viewports import redraw, show_header

_KEYS = (
    "Click: choose, Shift-Click: add, Right-Click or W: menu,"
    " Alt-Wheel or Page Up and Down: number of parts, Esc: end"
)
_TURNED = "Click or Enter: keep {} parts, Esc or Right-Click: back to {}"


@dataclass
class Picking:
    """Parts are picked in the viewports.

    Attributes
    ----------
    workspace : str
        Name of the workspace whose status bar shows the keys.
    window : int
        The address of the window in which they are picked.
    hovered : (int, int) or None
        The `session_uid` of the object under the cursor, and the number of its part.
    name : str
        The name of the object that was under the cursor latest.
    place : (int, int)
        Where the cursor is in that window.
    merging : bool
        Whether the next part that is clicked is merged with the chosen ones.
    turning : Turning or None
        What the wheel has done since the number of parts was kept last.
    """

    workspace: str
    window: int
    hovered: tuple[int, int] | None = None
    name: str = ""
    place: tuple[int, int] = (0, 0)
    merging: bool = False
    turning: Turning | None = None

    def part(self) -> Identity | None:
        """Return who the part under the cursor is, None if there is none."""
        obj = self.object()
        return None if obj is None else shown_identities(obj).get(self.number)

    def go_to(self, workspace: str) -> None:
        """Take the text of the status bar away from where picking went on until now."""
        if workspace != self.workspace:
            modal.show_hint(self.workspace, None)
            self.workspace = workspace

    @property
    def number(self) -> int:
        """The number of the part under the cursor, -1 for none."""
        return -1 if self.hovered is None else self.hovered[1]

    def object(self) -> bpy.types.Object | None:
        """Return the object under the cursor, None if there is none."""
        if self.hovered is None:
            return None
        obj = object_with(self.hovered[0], self.name)
        self.name = "" if obj is None else obj.name
        return obj


# The one picking that is on.
current: Picking | None = None


def start(context: bpy.types.Context) -> Picking:
    """Begin to pick."""
    global current
    current = Picking(context.workspace.name, context.window.as_pointer())
    tell(context)
    return current


def stop(*_: object) -> None:
    """End the picking, and remove its traces. Blender passes arguments to handlers."""
    global current
    picking, current = current, None
    if picking is not None:
        show_header(None)
        modal.show_hint(picking.workspace, None)
        redraw()


def tell(context: bpy.types.Context) -> None:
    """Say in the headers what is picked, and in the status bar which keys there are."""
    if current is None:
        return
    show_header(_header(current, context))
    modal.show_hint(current.workspace, _keys(current, context))
    redraw()


def _keys(picking: Picking, context: bpy.types.Context) -> str:
    """Return which keys there are, for the status bar."""
    turning = picking.turning
    if turning is None:
        return _KEYS
    return _TURNED.format(n_parts_of(context.active_object), turning.n_before)


def _header(picking: Picking, context: bpy.types.Context) -> str:
    """Return what is happening, for the header."""
    part, obj = picking.part(), picking.object() or context.active_object
    of = "" if obj is None else f"{obj.name}: {n_parts_of(obj)} Parts"
    doing = "Merge with" if picking.merging else "Pick Parts"
    return "  |  ".join(each for each in (doing, part.name if part else "", of) if each)


HANDLERS = {"load_pre": stop}
