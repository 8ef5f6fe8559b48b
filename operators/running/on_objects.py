"""What operators on objects share: which objects they take, and how they report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import bpy

from ...core.errors import DecompositionError
from ..bridge.refusals import rough_refusal

if TYPE_CHECKING:  # at run time the whole operator has this base, and its halves not
    from bpy.types import Operator
else:
    Operator = object


class OnObjects(Operator):
    """Half an operator on the selected objects.

    The other half has `_refusal(obj)`, which returns why an object cannot be worked on.
    It waits for the seams of parts, unless it replaces or removes the parts.
    """

    _needs_seams = True

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is an object to work on."""
        return is_free(cls, cls._obstacle(context))

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return why nothing can be done now, None if something can."""
        chosen = cls._chosen(context)
        reason: str | None = cls._refusal(chosen[0])
        if reason is None and cls._needs_seams:
            reason = next(filter(None, map(rough_refusal, chosen)), None)
        return reason

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to work on, the active one first."""
        return chosen_objects(context, cls._refusal)

    def _conclude(
        self, failures: Sequence[str], n_objects: int, late: bool = False
    ) -> set[str]:
        """Report the failures among `n_objects`; return the answer of the operator.

        Scripts get an error as an exception. So failures are errors only if nothing was
        done; otherwise they are warnings. So are those that come `late`, while the user
        does something else: an error opens a popup, which would take the next key.
        """
        none_done = len(failures) == n_objects
        for failure in failures:
            self.report({"ERROR" if none_done and not late else "WARNING"}, failure)
        return {"CANCELLED" if none_done else "FINISHED"}


class OnActive(Operator):
    """Half an operator on the active object only; comes before `OnObjects`."""

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the active object."""
        return [context.active_object]


class OnEach(OnObjects):
    """Half an operator that does `_work(context, obj)` on each object at once.

    If one object fails, the others are still done.
    """

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Work on the objects."""
        objects, failures = self._chosen(context), []
        for obj in objects:
            try:
                self._work(context, obj)
            except DecompositionError as error:
                title = f"{obj.name}: " if objects[1:] else ""
                failures.append(f"{title}{error}")
        return self._conclude(failures, len(objects))


def is_free(operator: type[Operator], obstacle: str | None) -> bool:
    """Return whether an operator can be called; its button tells of an obstacle."""
    if obstacle:
        operator.poll_message_set(obstacle)
    return obstacle is None


def chosen_objects(
    context: bpy.types.Context, refusal: Callable[[bpy.types.Object], str | None]
) -> list[bpy.types.Object]:
    """Return the selected objects, or those in Edit Mode, that `refusal` lets pass.

    The active object comes first. If no object passes, it is the only one, so that the
    user is told why. In other modes it is, too: no other object is in them.
    """
    active = context.active_object
    if active and active.mode == "EDIT":
        there = context.objects_in_mode
    elif active and active.mode != "OBJECT":
        there = [active]
    else:
        there = context.selected_objects
    fit = [obj for obj in there if refusal(obj) is None]
    return sorted(fit, key=lambda obj: bool(obj != active)) or [active]
