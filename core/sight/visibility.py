"""The samples of a shape, and which of them see each other.

============== ==================== ================ ==================================
`Visibility`   is made from         is seen through  is read for
============== ==================== ================ ==================================
`rank_pairs`   rays                 the inside       convexity ranks
`affinity`     rays                 containers, too  the embedding
`psi_pairs`    `rank_pairs`         containers, too  psi that is shown, choice of k
`likely_pairs` `psi_pairs`, places  containers, too  psi while parts and seams are found
============== ==================== ================ ==================================

`psi_pairs` is `rank_pairs` itself if nothing is enclosed, and `likely_pairs` is
`psi_pairs` itself if nothing is guessed. `affinity` is the matrix of `psi_pairs` if all
pairs are known. Of random pairs, it also has those of each sample with itself; with
cones, `psi_pairs` may be random ones.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import sparse

from ..errors import DecompositionError
from ..geometry.sampling import Samples, take_samples
from ..parameters.parts import Parameters
from ..steps.arrays import FloatArray, IntArray
from ..steps.progress import Progress, Steps, within
from .all_pairs import see_all_pairs, see_uniform_pairs
from .blocks import see_blocks
from .cone import see_cones, shared_rays
from .containers import see_through_containers
from .likely_pairs import likely_pairs
from .lines import RayBudget
from .pair_visibility import Matrix, PairVisibility
from .prepared import PreparedShape
from .viewpoints import thickness_at, viewpoints

# Most samples whose matrix of all pairs fits into memory.
_MOST_FOR_ALL_PAIRS = 10_000
# A mesh of fewer triangles takes fewer samples to find parts: seams follow its edges.
_FEW_TRIANGLES = 600
# Least share of the samples that it takes, and number that is not reduced.
_LEAST_SHARE = 1 / 3
_ENOUGH_SAMPLES = 400


@dataclass(frozen=True, eq=False)
class LinesOfSight:
    """Which samples see each other through the inside only.

    Attributes
    ----------
    samples : Samples
        N points on the surface.
    affinity_pairs : PairVisibility
        Pairs of the LoS matrix M (eq. 3): all pairs, or those that rays were cast for.
        Every sample sees itself.
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1).
    """

    samples: Samples
    affinity_pairs: PairVisibility
    rank_pairs: PairVisibility


@dataclass(frozen=True, eq=False)
class Visibility:
    """What parts are computed from, for any number of parts, alpha and smoothness.

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
    likely_pairs : PairVisibility
        How likely pairs lie in one part, or `psi_pairs`. Parts are found from it.
    rank_pairs : PairVisibility
        Pairs that convexity ranks are counted from (eq. 1), through the inside only.
    """

    shape: PreparedShape
    samples: Samples
    affinity: Matrix
    psi_pairs: PairVisibility
    likely_pairs: PairVisibility
    rank_pairs: PairVisibility

    @cached_property
    def nodes(self) -> IntArray:
        """Node of the shape's graph that each sample lies on, (N,) int."""
        return self.shape.targets.polygons[self.samples.triangles]

    @property
    def is_guessed(self) -> bool:
        """Whether likely pairs were guessed from more than lines of sight."""
        return self.likely_pairs is not self.psi_pairs

    @property
    def shows_all_of_solid(self) -> bool:
        """Whether the shape is a whole mesh, not flat, and all pairs are known."""
        shape = self.shape
        whole = bool((shape.targets.polygons < shape.n_nodes).all())
        solid = whole and shape.plane is None and not shape.is_cloud
        return solid and self.psi_pairs.known is None

    @cached_property
    def thickness(self) -> FloatArray:
        """Length inside the shape of a ray straight inwards from each sample, (N,)."""
        return thickness_at(self.shape.marcher, self.samples)


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
    yield from within(shape.marcher.caster_in_steps(), 0.0, 0.01)
    yield Progress("Ray tree", 0.01)
    views = yield from within(viewpoints(shape.marcher, samples), 0.01, 0.02)
    n_rays = parameters.rays
    if parameters.sight == "CONE":
        (n_pairs, n_rays), drawn = shared_rays(parameters, len(samples)), None
        if n_pairs:
            steps = see_uniform_pairs(views, rng, n_pairs)
            drawn = yield from within(steps, 0.02, 0.2)
        steps = see_cones(shape, views, n_rays, parameters.cone_angle)
        in_cones = yield from within(steps, 0.2, 1.0)
        return LinesOfSight(samples, in_cones, drawn or in_cones)
    if parameters.sight == "BLOCKS":
        steps = see_blocks(views, n_rays)
    elif 0 < 2 * n_rays < len(samples):
        n_pairs = n_rays * len(samples)
        steps = see_uniform_pairs(views, rng, n_pairs, RayBudget(n_pairs))
    else:
        steps = see_all_pairs(views)
    pairs = yield from within(steps, 0.02, 1.0)
    return LinesOfSight(samples, _all_seeing_themselves(pairs), pairs)


def _all_seeing_themselves(pairs: PairVisibility) -> PairVisibility:
    """Return pairs in which each sample sees itself; random pairs may leave that out.

    A sample that sees none, not even itself, has no place in the embedding.
    """
    if not isinstance(pairs.visible, sparse.csr_array):
        return pairs
    itself = sparse.diags_array(np.float32(pairs.visible.diagonal() == 0))
    return replace(pairs, visible=sparse.csr_array(pairs.visible + itself))


def _samples_of(
    shape: PreparedShape, parameters: Parameters, rng: np.random.Generator
) -> Samples:
    """Return samples of a shape; raise if they have too many pairs."""
    samples = take_samples(
        shape.targets, shape.sampled, parameters.sampling, parameters.samples, rng
    )
    if parameters.sight != "CONE" and len(samples) > _MOST_FOR_ALL_PAIRS:
        raise DecompositionError(
            f"{len(samples):,} faces have too many pairs to look up all lines of"
            " sight; choose Cone for Lines of Sight or By Area for Sampling."
        )
    return samples


def _for_size(shape: PreparedShape, parameters: Parameters) -> Parameters:
    """Return parameters with fewer samples for a mesh of few triangles.

    Time grows with their square. Parts of a larger mesh get all of them.
    """
    if shape.is_cloud or shape.plane is not None:
        return parameters
    share = max(_LEAST_SHARE, len(shape.targets.triangles) / _FEW_TRIANGLES)
    few = max(_ENOUGH_SAMPLES, round(share * parameters.samples))
    return replace(parameters, samples=min(parameters.samples, few))


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
    steps = find_lines_of_sight(shape, _for_size(shape, parameters))
    sight = yield from within(steps, 0.0, 0.9)
    affinity, psi = sight.affinity_pairs, sight.rank_pairs
    if parameters.containers == "FILLED" and shape.plane is None:
        affinity, psi = yield from within(
            see_through_containers(shape.marcher, sight.samples, affinity, psi),
            0.9,
            0.95,
        )
    seen = Visibility(
        shape, sight.samples, affinity.visible, psi, psi, sight.rank_pairs
    )
    # All samples of a large face are likely in one part, and it would be one of its
    # own. People divide whole shapes. Within a part, lines of sight tell more.
    if not seen.shows_all_of_solid or len(shape.targets.triangles) < _FEW_TRIANGLES:
        return seen
    guesses = likely_pairs(psi, sight.samples.positions)
    likely = yield from within(guesses, 0.95, 1.0)
    return replace(seen, likely_pairs=likely)
