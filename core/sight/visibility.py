"""The samples of a shape, and which of them see each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import DecompositionError
from ..geometry.sampling import Samples, take_samples
from ..parameters.parts import Parameters
from ..steps.progress import Progress, Steps, within
from .cone import see_cones
from .containers import see_through_containers
from .lines import see_all_pairs, see_uniform_pairs
from .pair_visibility import Matrix, PairVisibility
from .prepared import PreparedShape
from .viewpoints import viewpoints

# Most samples whose matrix of all pairs fits into memory.
_MOST_FOR_ALL_PAIRS = 10_000


@dataclass(frozen=True, eq=False)
class LinesOfSight:
    """Which samples see each other through the inside only.

    Attributes
    ----------
    samples : Samples
        N points on the surface.
    affinity_pairs : PairVisibility
        Pairs of the LoS matrix M (eq. 3): all pairs, or those found by cones of rays.
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1).
    """

    samples: Samples
    affinity_pairs: PairVisibility
    rank_pairs: PairVisibility


@dataclass(frozen=True, eq=False)
class Visibility:
    """What parts are computed from, for any number of parts, balance and smoothness.

    Attributes
    ----------
    shape : PreparedShape
        The shape that the samples lie on.
    samples : Samples
        N points on its surface.
    affinity : (N, N) float32 or sparse
        LoS matrix M (eq. 3), also through containers. The embedding comes from it.
    psi_pairs : PairVisibility
        Pairs that psi is counted from (eq. 5), also through containers.
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1), through the inside only.
    nodes : (N,) int
        Node of the shape's graph that each sample lies on.
    """

    shape: PreparedShape
    samples: Samples
    affinity: Matrix
    psi_pairs: PairVisibility
    rank_pairs: PairVisibility
    nodes: NDArray[np.int64]


def find_lines_of_sight(
    shape: PreparedShape, parameters: Parameters
) -> Steps[LinesOfSight]:
    """Sample a shape and find the lines of sight between the samples.

    Parameters
    ----------
    shape : PreparedShape
        The shape to look through.
    parameters : Parameters
        Only those that affect lines of sight are used.

    Returns
    -------
    Steps of LinesOfSight

    Raises
    ------
    DecompositionError
        If no surface carries samples, or if each face is a sample and the matrix of all
        pairs does not fit into memory.
    """
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    samples = _samples_of(shape, parameters, rng)
    yield Progress("Ray tree", 0.0)
    _ = shape.marcher.caster  # takes half of the time of this stage: a separate step
    yield Progress("Ray tree", 0.01)
    views = viewpoints(shape.marcher, samples)
    if parameters.sight == "ALL_PAIRS":
        pairs = yield from within(
            see_all_pairs(shape.marcher, samples, views), 0.02, 1.0
        )
        return LinesOfSight(samples, pairs, pairs)
    drawn = None
    if parameters.psi_pairs == "UNIFORM":
        drawn = yield from within(
            see_uniform_pairs(shape.marcher, samples, views, rng), 0.02, 0.2
        )
    in_cones = yield from within(
        see_cones(shape, samples, views, parameters.rays, parameters.cone_angle),
        0.2,
        1.0,
    )
    return LinesOfSight(samples, in_cones, drawn or in_cones)


def _samples_of(
    shape: PreparedShape, parameters: Parameters, rng: np.random.Generator
) -> Samples:
    """Return samples of a shape; raise if they have too many pairs."""
    samples = take_samples(
        shape.targets, shape.sampled, parameters.sampling, parameters.samples, rng
    )
    if parameters.sight == "ALL_PAIRS" and len(samples) > _MOST_FOR_ALL_PAIRS:
        raise DecompositionError(
            f"{len(samples):,} faces have too many pairs to look up all lines of"
            " sight; choose Cone for Lines of Sight or By Area for Sampling."
        )
    return samples


def see_in_steps(shape: PreparedShape, parameters: Parameters) -> Steps[Visibility]:
    """Compute the visibility of a shape: the expensive half of a decomposition.

    Parameters
    ----------
    shape : PreparedShape
        The shape to look through.
    parameters : Parameters
        Only those that affect lines of sight are used.

    Returns
    -------
    Steps of Visibility

    Raises
    ------
    DecompositionError
        If no surface carries samples, or if each face is a sample and the matrix of all
        pairs does not fit into memory.
    """
    sight = yield from within(find_lines_of_sight(shape, parameters), 0.0, 0.9)
    affinity, psi = sight.affinity_pairs, sight.rank_pairs
    if parameters.containers == "FILLED" and shape.plane is None:
        affinity, psi = yield from within(
            see_through_containers(shape.marcher, sight.samples, affinity, psi),
            0.9,
            1.0,
        )
    return Visibility(
        shape,
        sight.samples,
        affinity.visible,
        psi,
        sight.rank_pairs,
        shape.targets.polygons[sight.samples.triangles],
    )
