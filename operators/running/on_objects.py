"""What operators on objects share: which they are for, and what is told of failures."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ...core.errors import DecompositionError
from ..bridge.read.target import chosen


class OnObjects:
    """Half an operator on the selected objects.

    The other half has `_refusal(obj)`, which returns why an object cannot be worked on.
    """

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is an object to work on."""
        reason = cls._obstacle(context)
        if reason:
            cls.poll_message_set(reason)
        return reason is None

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return why nothing can be done now, None if something can."""
        return cls._refusal(cls._chosen(context)[0])

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to work on, the active one first."""
        return chosen(context, cls._refusal)

    def _conclude(self, failures: Sequence[str], n_objects: int) -> set[str]:
        """Report what failed; return what an operator on so many objects is to return.

        Errors are exceptions to scripts, so that they are for when nothing was done.
        """
        none_done = len(failures) == n_objects
        for failure in failures:
            self.report({"ERROR" if none_done else "WARNING"}, failure)
        return {"CANCELLED" if none_done else "FINISHED"}


class OnActive:
    """Half an operator on the active object alone, before `OnObjects`."""

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the active object."""
        return [context.active_object]


class OnEach(OnObjects):
    """Half an operator that does `_work(context, obj)` on each object at once.

    One that fails does not stop the others.
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
