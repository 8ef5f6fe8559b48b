"""What operators share that replace the parts of the active object by others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..bridge.work.computing import summary
from .computation import Computation
from .on_objects import OnActive

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ..bridge.work.editing import Edited


class Replacement(OnActive, Computation):
    """Half an operator whose `_begin` returns the work of an `Edited`.

    It is for the active object: the table shows its parts, and its lines of sight are
    those that are kept.
    """

    def _commit(self, obj: bpy.types.Object, value: Edited) -> str:
        value.write(obj)
        return summary(value.decomposition)
