"""Decompose an object again, except for its locked parts."""

from __future__ import annotations

from dataclasses import replace

import bpy
import numpy as np

from .... import core
from ....core.errors import DecompositionError
from ....core.geometry.shape import Shape
from ....core.parameters.parts import Parameters
from ....core.steps.progress import Steps
from ..parts.present_parts import PresentParts, present_parts
from ..refusals import edit_refusal
from .computing import decompose_object
from .run_edit import Edited, edit_object
from .session_cache import session_cache


def decompose_unlocked(obj: bpy.types.Object, parameters: Parameters) -> Steps[Edited]:
    """Return the steps that decompose an object, except for its locked parts.

    Parameters
    ----------
    obj : bpy.types.Object
    parameters : Parameters
        Numbers of parts include the locked parts.

    Returns
    -------
    Steps of Edited

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to, all parts are locked, or
        the number of parts leaves none for the unlocked faces.
    """
    locks = edit_refusal(obj) is None and any(row.locked for row in obj.wcd_parts)
    if locks:
        return _decompose_rest(obj, parameters)
    steps = decompose_object(obj, parameters)

    def work() -> Steps[Edited]:
        return Edited((yield from steps), None, parameters)

    return work()


def _decompose_rest(obj: bpy.types.Object, parameters: Parameters) -> Steps[Edited]:
    """Return the steps that decompose the unlocked faces, from their own samples."""
    parts = present_parts(obj)
    locked = np.flatnonzero(parts.locked)
    members = ~np.isin(parts.labels, locked)
    rest = _parameters_of_rest(parameters, len(np.unique(parts.labels[~members])))
    if not members.any():
        raise DecompositionError(
            "All parts are locked, so nothing is left to decompose; unlock some."
        )

    def change(
        shape: Shape, _: core.PartMemo, parts: PresentParts
    ) -> Steps[core.Change]:
        cache = session_cache()
        found = yield from core.decompose_in_steps(shape, rest, cache, members)
        labels = parts.labels.copy()
        first = len(parts.identities)
        labels[members] = first + found.labels
        ranks = {first + part: rank for part, rank in enumerate(found.ranks.tolist())}
        return core.Change(labels, ranks)

    return edit_object(obj, change, parameters)


def _parameters_of_rest(parameters: Parameters, n_locked: int) -> Parameters:
    """Return parameters for the unlocked faces, without the locked parts in numbers."""
    fewest = max(2, parameters.min_parts - n_locked)
    most = max(fewest, parameters.max_parts - n_locked)
    n_parts = parameters.parts
    if n_parts and n_parts <= n_locked:
        raise DecompositionError(
            f"Parts is {n_parts}, but {n_locked} parts are locked and count too; raise"
            f" it to {n_locked + 1} at least, set it to 0, or unlock some."
        )
    return replace(
        parameters,
        parts=n_parts - n_locked if n_parts else 0,
        min_parts=fewest,
        max_parts=most,
    )
