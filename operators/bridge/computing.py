"""What is computed of an object: checked and read at once, done step by step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

import bpy

from ...core.parameters import Parameters
from ...core.progress import Steps
from .ray_caster import BvhRayCaster
from .read import read_shape, reading_notes
from .record import check_records
from .write import check_writable

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ...core.decomposition import Decomposition, Measurement

    Result = TypeVar("Result", Decomposition, Measurement)


def decompose_object(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Decomposition]:
    """Check and read an object that is to be written to; return the work to be done.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    # Loads SciPy and scikit-learn: seconds that enabling the add-on must not take.
    from ...core.decomposition import decompose

    check_writable(obj)
    steps = decompose(read_shape(obj), parameters, BvhRayCaster)
    return _with_notes(reading_notes(obj), steps)


def measure_object(obj: bpy.types.Object, parameters: Parameters) -> Steps[Measurement]:
    """Check and read an object; return the work to be done.

    Errors are those of `decompose_object`.
    """
    # As above.
    from ...core.decomposition import measure

    check_records(obj)
    steps = measure(read_shape(obj), parameters, BvhRayCaster)
    return _with_notes(reading_notes(obj), steps)


def _with_notes(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Run `steps` and put `notes` before those of their value."""
    value = yield from steps
    return replace(value, notes=(*notes, *value.notes))


def summary(decomposition: Decomposition) -> str:
    """Return the figures of a decomposition in a line."""
    n_parts = decomposition.n_parts
    return (
        f"{n_parts} {'part' if n_parts == 1 else 'parts'},"
        f" psi {decomposition.psi_before:.3f} → {decomposition.psi:.3f},"
        f" mean convexity rank {decomposition.ranks.mean():.3f}"
    )
