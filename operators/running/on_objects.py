"""What operators on objects share: which objects they take, and how they report."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, ClassVar

import bpy

from ...core.errors import DecompositionError
from ..bridge.hulls.listed import is_hull
from ..bridge.refusals import rough_refusal
from . import modal

if TYPE_CHECKING:  # at run time the whole operator has this base, and its halves not
    from bpy.types import Operator
else:
    Operator = object


# How many objects that failed are named in one sentence.
_NAMED = 4


class OnObjects(Operator):
    """Half an operator on the selected objects.

    The other half has `_refusal(obj)`, which returns why an object cannot be worked on.
    It waits for the seams of parts, unless it replaces or removes the parts. It also
    waits while something is computed, unless it only selects or shows something: what
    is written at the end would undo what it did.
    """

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}
    _needs_seams = True
    _waits = True

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Return whether there is an object to work on."""
        busy = modal.busy() if cls._waits else None
        return modal.is_free(cls, busy or cls._obstacle(context))

    @classmethod
    def _obstacle(cls, context: bpy.types.Context) -> str | None:
        """Return why nothing can be done now, None if something can.

        Panels ask for it many times a second, while thousands of objects may be
        selected. So it looks no further than to the first that can be worked on.
        """
        refusal, there = cls._refusals(), cls._candidates(context)
        if all(map(refusal, there)):
            there = [active_object(context)]
            reason = refusal(there[0])
            if reason:
                return reason
        for obj in there if cls._needs_seams else ():
            reason = rough_refusal(obj)
            if reason and refusal(obj) is None:
                return reason
        return None

    @classmethod
    def _chosen(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the objects to work on, the active one first.

        They are the candidates that can be worked on. If there is none, it is the
        active one, so that the user is told why.
        """
        refusal = cls._refusals()
        fit = [obj for obj in cls._candidates(context) if refusal(obj) is None]
        return fit or [active_object(context)]

    @classmethod
    def _refusals(cls) -> Callable[[Any], str | None]:
        """Return `_refusal`, or what looks at the file once for many objects."""
        refusal: Callable[[Any], str | None] = cls._refusal
        return refusal

    @classmethod
    def _candidates(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the selected objects, or those in Edit Mode, the active one first.

        In other modes it is the only one: no other object is in them. So it is where a
        script set the window to None: the context has no selection then. Hulls that are
        selected with their object go with it.
        """
        active, selects = active_object(context), hasattr(context, "selected_objects")
        if not selects or (active and active.mode not in {"OBJECT", "EDIT"}):
            return [active]
        in_edit_mode = active and active.mode == "EDIT"
        there = context.objects_in_mode if in_edit_mode else context.selected_objects
        owners = set(there)  # panels ask often, and thousands may be selected
        chosen = [obj for obj in there if not (is_hull(obj) and obj.parent in owners)]
        return sorted(chosen, key=lambda obj: bool(obj != active))

    def _conclude(
        self, failures: Sequence[tuple[str, str]], n_objects: int, late: bool = False
    ) -> set[str]:
        """Report which of `n_objects` failed, and why; return the operator's answer.

        Scripts get an error as an exception. So failures are errors only if nothing was
        done; otherwise they are warnings. So are those that come `late`, while the user
        does something else: an error opens a popup, which would take the next key.

        The status bar shows the last report only. So one more names all that failed.
        """
        none_done = len(failures) == n_objects
        kind = {"ERROR" if none_done and not late else "WARNING"}
        for name, error in failures:
            self.report(kind, f"{name}: {error}" if n_objects > 1 else error)
        if len(failures) > 1 and kind == {"WARNING"}:
            self.report(kind, _all_failed([name for name, _ in failures], n_objects))
        return {"CANCELLED" if none_done else "FINISHED"}


class OnActive(Operator):
    """Half an operator on the active object only; comes before `OnObjects`."""

    @classmethod
    def _candidates(cls, context: bpy.types.Context) -> list[bpy.types.Object]:
        """Return the active object."""
        return [active_object(context)]


class OnEach(OnObjects):
    """Half an operator that does `_work(obj)` on each object at once.

    If one object fails, the others are still done.
    """

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Work on the objects."""
        objects, failures = self._chosen(context), []
        for obj in objects:
            try:
                self._work(obj)
            except DecompositionError as error:
                failures.append((obj.name, str(error)))
        return self._conclude(failures, len(objects))


def _all_failed(names: Sequence[str], n_objects: int) -> str:
    """Return which objects failed, in a sentence."""
    there = ", ".join(names[:_NAMED]) + (" and others" if names[_NAMED:] else "")
    share = f"{len(names)} of {n_objects} objects failed"
    return f"{share}: {there}. The Info editor says why."


def active_object(context: bpy.types.Context) -> Any:
    """Return the active object or None, also where a script set the window to None."""
    if hasattr(context, "active_object"):
        return context.active_object
    return context.view_layer.objects.active
