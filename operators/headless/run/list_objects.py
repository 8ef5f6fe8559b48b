"""Lists the objects of a file that need no parts, because only hulls are asked for."""

from __future__ import annotations

from collections.abc import Sequence

import bpy

from ..current_file import has_shape
from ..request.options import Request
from ..request.outputs import Targets
from .results import ObjectResult


def needs_parts(targets: Targets, request: Request) -> bool:
    """Return whether parts are to be found: not for hulls by error alone.

    Parameters
    ----------
    targets : Targets
        The files to write.
    request : Request
    """
    shows_parts = bool(targets.output or targets.picture or not targets.hulls)
    return shows_parts or request.hull_parameters.pieces == "PARTS"


def list_objects(objects: Sequence[bpy.types.Object]) -> tuple[ObjectResult, ...]:
    """Return a result for each object, without parts; those without faces get a note.

    Parameters
    ----------
    objects : sequence of Object
    """
    note = "It has no faces and gets no hulls."
    return tuple(
        ObjectResult(obj.name_full, record={})
        if has_shape(obj)
        else ObjectResult(obj.name_full, notes=(note,))
        for obj in objects
    )
