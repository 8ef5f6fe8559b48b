"""Lists the objects of a file that need no parts, because only hulls are asked for."""

from __future__ import annotations

from ..current_file import has_shape
from ..read.load import LoadedFile
from ..request.outputs import Targets
from .results import ObjectResult


def shows_parts(targets: Targets) -> bool:
    """Return whether parts are what is asked for: not if hulls alone are.

    Parameters
    ----------
    targets : Targets
        The files to write.
    """
    return bool(targets.output or targets.picture or not targets.hulls)


def list_objects(loaded: LoadedFile) -> tuple[ObjectResult, ...]:
    """Return a result for each object, without parts; those without faces get a note.

    Parameters
    ----------
    loaded : LoadedFile
    """
    results = []
    for obj in loaded.objects:
        notes = loaded.notes_of(obj)
        if has_shape(obj):
            results.append(ObjectResult(obj.name_full, record={}, notes=notes))
        else:
            notes = (*notes, "It has no faces and gets no hulls.")
            results.append(ObjectResult(obj.name_full, notes=notes))
    return tuple(results)
