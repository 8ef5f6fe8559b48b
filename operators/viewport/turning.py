"""What the wheel has done to the number of parts, until it is kept or taken back.

Each turn is an undo step of its own, so undo takes them back: names, ticks and all that
a run may have changed come back with it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy

from ..bridge.stored.record import noted_parameters, record_of
from .shown_parts import n_parts_of
from .viewports import navigates

# Buttons and keys beside the wheel that neither keep nor take back a number: they turn
# the view, or are held while the wheel turns.
_LOOKING = {
    "MIDDLEMOUSE",
    *("WHEELUPMOUSE", "WHEELDOWNMOUSE", "PAGE_UP", "PAGE_DOWN"),
    *(
        f"{side}_{key}"
        for side in ("LEFT", "RIGHT")
        for key in ("ALT", "CTRL", "SHIFT")
    ),
}
_TAKES_BACK = {"ESC", "RIGHTMOUSE"}


@dataclass
class Turning:
    """Numbers of parts that the wheel has asked for, one after the other.

    Attributes
    ----------
    object : int
        The `session_uid` of the object.
    n_before : int
        How many parts it had.
    before : object
        What tells the parts that it had from those of other numbers.
    n_steps : int
        How many numbers were cut: each makes an undo step, if it is not cancelled.
    """

    object: int
    n_before: int
    before: Any
    n_steps: int = 0

    @classmethod
    def of(cls, obj: bpy.types.Object) -> Turning:
        """Return that nothing was asked for yet."""
        return cls(obj.session_uid, n_parts_of(obj), _state(obj))

    def take_back(self) -> bool:
        """Undo the steps; return whether that was far enough.

        Blender keeps as many steps as the user allows, and none without Global Undo.
        """
        for _ in range(self.n_steps):
            if self._is_back() or not bpy.ops.ed.undo.poll():
                break
            bpy.ops.ed.undo()
        return self._is_back()

    def _is_back(self) -> bool:
        """Return whether there is nothing to take back, or it is another object."""
        obj = bpy.context.active_object
        gone = obj is None or obj.session_uid != self.object
        return gone or _state(obj) == self.before


def keeps(event: bpy.types.Event) -> bool:
    """Return whether a press keeps the number that the wheel asked for."""
    if event.type in _LOOKING | _TAKES_BACK or navigates(event):
        return False
    return event.type == "NUMPAD_ENTER" or not event.type.startswith("NUMPAD_")


def _state(obj: bpy.types.Object) -> Any:
    """Return what differs between two cuts; finer seams of one cut do not count."""
    return record_of(obj).get("k"), noted_parameters(obj)
