"""Samples of a shape, and which of them see each other."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..errors import DecompositionError
from ..geometry.sampling import Samples, take_samples
from ..geometry.transfer import Transfer
from ..parameters.parts import Parameters
from ..steps.progress import Progress, Steps, within
from .cone import see_cones, see_uniform_pairs
from .containers import see_through_containers
from .lines import see_all_pairs, viewpoints
from .pairs import Matrix, PairVisibility
from .prepared import PreparedShape

# A matrix of all pairs of more samples does not fit into memory.
_MOST_FOR_ALL_PAIRS = 10_000


@dataclass(frozen=True, eq=False)
class LinesOfSight:
    """What samples see of each other through the inside alone.

    Attributes
    ----------
    samples : Samples
    affinity_pairs : PairVisibility
        All pairs, or those that rays in cones found: the LoS matrix M (eq. 3).
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1).
    """

    samples: Samples
    affinity_pairs: PairVisibility
    rank_pairs: PairVisibility


@dataclass(frozen=True, eq=False)
class Visibility:
    """All that parts are found from, whatever their number, balance or smoothness.

    Attributes
    ----------
    shape : PreparedShape
    samples : Samples
    affinity : (N, N) float32 or sparse
        The LoS matrix M (eq. 3), through containers too. The embedding comes from it.
    psi_pairs : PairVisibility
        Pairs that psi is counted from (eq. 5), through containers too.
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1), through the inside alone.
    transfer : Transfer
        Carries labels between the samples and the nodes of the graph.
    """

    shape: PreparedShape
    samples: Samples
    affinity: Matrix
    psi_pairs: PairVisibility
    rank_pairs: PairVisibility
    transfer: Transfer


def find_lines_of_sight(
    shape: PreparedShape, parameters: Parameters
) -> Steps[LinesOfSight]:
    """Sample a shape and find the lines of sight between the samples.

    Parameters
    ----------
    shape : PreparedShape
    parameters : Parameters

    Raises
    ------
    DecompositionError
        If no surface carries samples, or if faces are the samples and their pairs do
        not fit into memory.
    """
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    samples = take_samples(
        shape.targets, shape.sampled, parameters.sampling, parameters.samples, rng
    )
    all_pairs = parameters.sight == "ALL_PAIRS"
    if all_pairs and len(samples) > _MOST_FOR_ALL_PAIRS:
        raise DecompositionError(
            f"The lines of sight between all pairs of {len(samples):,} faces are too"
            " many; choose Cone for Lines of Sight or By Area for Sampling."
        )
    yield Progress("Ray tree", 0.0)
    _ = shape.marcher.caster  # half of the time of the ray tree, a step of its own
    yield Progress("Ray tree", 0.01)
    views = viewpoints(shape.marcher, samples)
    if all_pairs:
        pairs = yield from within(
            see_all_pairs(shape.marcher, samples, views), 0.02, 1.0
        )
        return LinesOfSight(samples, pairs, pairs)
    in_cones = yield from within(
        see_cones(shape, samples, views, parameters.rays, parameters.cone_angle),
        0.02,
        0.8,
    )
    if parameters.psi_pairs == "RAYS":
        return LinesOfSight(samples, in_cones, in_cones)
    drawn = see_uniform_pairs(shape.marcher, samples, views, rng)
    return LinesOfSight(samples, in_cones, (yield from within(drawn, 0.8, 1.0)))


def see_in_steps(shape: PreparedShape, parameters: Parameters) -> Steps[Visibility]:
    """Find what parts are found from: the expensive half of a decomposition.

    Parameters and errors are those of `find_lines_of_sight`.
    """
    sight = yield from within(find_lines_of_sight(shape, parameters), 0.0, 0.8)
    affinity, psi = sight.affinity_pairs, sight.rank_pairs
    if parameters.containers == "FILLED" and shape.plane is None:
        affinity, psi = yield from within(
            see_through_containers(shape.marcher, sight.samples, affinity, psi),
            0.8,
            0.9,
        )
    yield Progress("Surface", 0.9)
    graph = shape.graph
    yield Progress("Surface", 0.95)
    nodes = shape.targets.polygons[sight.samples.triangles]
    return Visibility(
        shape,
        sight.samples,
        affinity.visible,
        psi,
        sight.rank_pairs,
        Transfer(sight.samples, nodes, graph),
    )
