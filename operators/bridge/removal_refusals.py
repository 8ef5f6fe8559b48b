"""Why nothing of ours can be removed from an object, each "why not" in one sentence.

They are like those in `refusals.py`. What an object cannot be decomposed for, such as
its type, does not keep the user from removing what is there.
"""

from __future__ import annotations

from collections.abc import Callable, Container

from .mesh.seams import has_marked_seams
from .read.carrier import is_copy
from .refusals import (
    CONVERTIBLE,
    LEAVE_EDIT_MODE,
    WORKED_ON,
    Candidate,
    library_refusal,
    no_hulls_refusal,
    refusal,
    unless,
)
from .stored.names import CARRIER_TAG, WHOLE_MESH
from .stored.notes import or_not_ours
from .stored.record import beside_parts, has_record, record_if_ours
from .stored.restore import has_parts


@or_not_ours
def clear_refusal(obj: Candidate, has_hulls: Callable[[Candidate], bool]) -> str | None:
    """Return why nothing can be cleared from an object."""
    if record_if_ours(obj) and obj.type not in WORKED_ON:
        return _object_refusal(obj)  # the user made a curve of it, or the like
    if obj is not None and obj.type in CONVERTIBLE:
        return f"{obj.name} is not a mesh and has no parts; select a mesh with parts"
    reason = refusal(obj, writes_mesh=False)
    if reason is None and has_parts(obj) and not beside_parts(obj):
        reason = library_refusal(obj)  # parts of a linked mesh are the library's
    if reason is not None:
        return reason
    if not (_has_ours(obj) or has_hulls(obj)):
        return f"{obj.name} has no parts to clear"
    if WHOLE_MESH in obj.data and obj.data.is_editmode:
        return (
            f"The faces of {obj.name} are cut, and come back in Object Mode only;"
            " switch the mode"
        )
    if CARRIER_TAG in obj and obj.mode != "OBJECT":
        return LEAVE_EDIT_MODE
    return None


def remove_hulls_refusal(obj: Candidate, owners: Container[Candidate]) -> str | None:
    """Return why hulls cannot be removed from an object, if it is among `owners`."""
    # It may have been converted since, or have lost its faces.
    if obj in owners and (obj.type != "MESH" or not obj.data.polygons):
        return _object_refusal(obj)
    return no_hulls_refusal(obj, owners)


def _has_ours(obj: Candidate) -> bool:
    """Return whether there is anything of ours on an object, beside hulls."""
    if has_record(obj) or WHOLE_MESH in obj.data:
        return True
    if obj.type == "MESH" and has_marked_seams(obj.data):
        return True
    # Clear on a copy that shares the mesh took the parts; the source is still hidden.
    return CARRIER_TAG in obj and obj.parent is not None and not is_copy(obj)


def _object_refusal(obj: Candidate) -> str | None:
    """Return why an object cannot be changed, whatever its data are."""
    return library_refusal(obj, writes_mesh=False) or unless(
        obj.mode == "OBJECT", LEAVE_EDIT_MODE
    )
