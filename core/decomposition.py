"""The paper's algorithm, one line per stage."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .parameters.parts import Parameters
from .parts.find import Decomposition, find_parts
from .parts.levels import split_again
from .sight.prepared import Shape
from .sight.ray_march import MakeCaster
from .sight.visibility import Visibility, look, see
from .steps.progress import Steps, within


@dataclass(frozen=True)
class Measurement:
    """The convexity rank of a shape (eq. 1).

    Attributes
    ----------
    rank : float
    standard_error : float
        Of `rank`, from the samples it is estimated on.
    n_samples : int
    notes : tuple of str
    """

    rank: float
    standard_error: float
    n_samples: int
    notes: tuple[str, ...]


def decompose(
    shape: Shape,
    parameters: Parameters,
    make_caster: MakeCaster,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Decomposition]:
    """Split `shape`, or some of its faces, into weakly convex parts.

    Where only members are split, all samples lie on them, so that what is small in the
    whole shape, such as fingers, is seen; lines of sight run through the whole shape.
    Arguments and errors are those of `look`.

    Returns
    -------
    Steps of Decomposition
        Of all polygons, or points, or of the members in their order. Yields Progress;
        `run` gets the value.
    """
    share = share_of_sight(parameters)
    looked = see(shape, parameters, make_caster, members)
    visibility = yield from within(looked, 0.0, share)
    steps = decompose_seen(shape, visibility, parameters, make_caster, members)
    return (yield from within(steps, share, 1.0))


def share_of_sight(parameters: Parameters) -> float:
    """Return the share of the time of `decompose` that the visibility takes."""
    return 0.8 if parameters.levels == 1 else 0.15


def decompose_seen(
    shape: Shape,
    visibility: Visibility,
    parameters: Parameters,
    make_caster: MakeCaster,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Decomposition]:
    """Return what `decompose` does, from a visibility computed before.

    Every `recut` among the parameters may differ from those of `visibility`.
    """
    if parameters.levels == 1:
        return (yield from find_parts(visibility, parameters))
    found = yield from within(find_parts(visibility, parameters), 0.0, 0.1)
    if members is None:
        members = np.ones(len(found.labels), dtype=bool)
    again = split_again(shape, visibility, found, parameters, make_caster, members)
    return (yield from within(again, 0.1, 1.0))


def measure(
    shape: Shape, parameters: Parameters, make_caster: MakeCaster
) -> Steps[Measurement]:
    """Estimate the convexity rank of `shape` (eq. 1).

    Parameters and errors are those of `decompose`; only what concerns samples and
    lines of sight matters.
    """
    sight = yield from look(shape, parameters, make_caster)
    rank, standard_error = sight.pairs.rank_of_all()
    return Measurement(rank, standard_error, len(sight.samples), sight.form.notes)
