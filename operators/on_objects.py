"""Work on several objects at once: one that fails does not stop the others."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import bpy

from ..core.errors import DecompositionError


def do_each(
    operator: bpy.types.Operator,
    objects: Sequence[bpy.types.Object],
    work: Callable[[bpy.types.Object], object],
) -> set[str]:
    """Do `work` on each object; return what the operator is to return."""
    failures = []
    for obj in objects:
        title = f"{obj.name}: " if objects[1:] else ""
        try:
            work(obj)
        except DecompositionError as error:
            failures.append(f"{title}{error}")
    return conclude(operator, failures, len(objects))


def conclude(
    operator: bpy.types.Operator, failures: Sequence[str], n_objects: int
) -> set[str]:
    """Report what failed; return what an operator on so many objects is to return.

    Errors are exceptions to scripts, so that they are for when nothing was done.
    """
    none_done = len(failures) == n_objects
    for failure in failures:
        operator.report({"ERROR" if none_done else "WARNING"}, failure)
    return {"CANCELLED" if none_done else "FINISHED"}
