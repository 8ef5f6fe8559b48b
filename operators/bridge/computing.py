"""What is computed of an object: checked and read at once, done step by step."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from typing import TYPE_CHECKING, TypeVar

import bpy

from ...core.errors import DecompositionError
from ...core.hull_parameters import HullParameters
from ...core.parameters import Parameters
from ...core.progress import Progress, Steps, within
from .converting import CONVERTIBLE
from .hulls import hull_refusal, part_labels
from .ray_caster import BvhRayCaster
from .read import read_shape, reading_notes
from .record import check_records
from .write import check_writable

if TYPE_CHECKING:  # imports SciPy, which enabling the add-on must not
    from ...core.decomposition import Decomposition, Measurement
    from ...core.hull_decomposition import HullDecomposition

    Result = TypeVar("Result", Decomposition, Measurement, HullDecomposition)

# In the order in which they load each other.
_LIBRARIES = (
    "scipy.linalg",
    "scipy.spatial",
    "scipy.optimize",
    "scipy.stats",
    "sklearn.utils",
    "sklearn.neighbors",
    "sklearn.cluster",
)


def decompose_object(
    obj: bpy.types.Object, parameters: Parameters
) -> Steps[Decomposition]:
    """Check and read an object that is to be written to; return the work to be done.

    Raises
    ------
    DecompositionError
        At once, if the object cannot be read or written to.
    """
    if obj.type not in CONVERTIBLE:  # else parts go to a new object
        check_writable(obj)
    mesh = read_shape(obj)

    def work() -> Steps[Decomposition]:
        from ...core.decomposition import decompose

        return (yield from decompose(mesh, parameters, BvhRayCaster))

    return _prepared(reading_notes(obj), work())


def measure_object(obj: bpy.types.Object, parameters: Parameters) -> Steps[Measurement]:
    """Check and read an object; return the work to be done.

    Errors are those of `decompose_object`.
    """
    check_records(obj)
    mesh = read_shape(obj)

    def work() -> Steps[Measurement]:
        from ...core.decomposition import measure

        return (yield from measure(mesh, parameters, BvhRayCaster))

    return _prepared(reading_notes(obj), work())


def build_hulls_of(
    obj: bpy.types.Object, parameters: Parameters, hull_parameters: HullParameters
) -> Steps[HullDecomposition]:
    """Check and read an object; return the work of building hulls around its parts.

    An object without parts is decomposed, but they are not written to it. Errors are
    those of `decompose_object`.
    """
    reason = hull_refusal(obj)
    if reason:
        raise DecompositionError(f"{reason}.")
    check_records(obj)
    mesh, labels = read_shape(obj), part_labels(obj)

    def work() -> Steps[HullDecomposition]:
        from ...core.decomposition import decompose
        from ...core.hull_decomposition import build_hulls

        found = labels
        if found is None:
            parts = yield from within(decompose(mesh, parameters, BvhRayCaster), 0, 0.4)
            found = parts.labels
        steps = build_hulls(mesh, found, hull_parameters, parameters.seed)
        return (yield from within(steps, 0.0 if labels is not None else 0.4, 1.0))

    return _prepared(reading_notes(obj), work())


def _load_libraries() -> Steps[None]:
    """Load what the core needs: a second that enabling the add-on must not take.

    Once in a session, and one library after the other, so that a window stays alive.
    """
    for name in _LIBRARIES:
        if name not in sys.modules:
            yield Progress("Libraries", 0.0)
            import_module(name)


def hull_summary(found: HullDecomposition) -> str:
    """Return the figures of a hull decomposition in a line."""
    return (
        f"{found.n_hulls} {'hull' if found.n_hulls == 1 else 'hulls'},"
        f" largest error {found.errors.max():.3f},"
        f" volume of hulls / volume {found.volume_ratio:.2f}"
    )


def _prepared(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Load what `steps` need, run them and put `notes` before those of their value."""
    yield from _load_libraries()
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
