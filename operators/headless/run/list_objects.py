"""Lists the objects of a file that need no parts, because only hulls are asked for."""

from __future__ import annotations

from ..current_file import has_shape
from ..read.load import LoadedFile
from .results import ObjectResult


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
