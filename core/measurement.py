"""The convexity rank of a shape, or of some of its faces (eq. 1)."""

from __future__ import annotations

from dataclasses import replace

from .cache import ShapeCache
from .errors import DecompositionError
from .geometry.array_checks import check_types
from .geometry.mesh import LEAST_AREA
from .geometry.shape import Shape, check_members
from .parameters.parts import Parameters
from .results.parts import Measurement
from .sight.prepared import PreparedShape
from .sight.visibility import find_lines_of_sight
from .steps.arrays import BoolArray
from .steps.progress import Steps, within

# Largest number of samples on chosen faces: rays are cast between all pairs of them.
_MOST_SAMPLES = 2000
# Pairs of each sample with random ones that replace blocks, whose inferred pairs would
# leave the standard error unknown. More of them lower it little.
_PAIRS_PER_SAMPLE = 50


def measure_in_steps(
    shape: Shape,
    parameters: Parameters,
    cache: ShapeCache,
    members: BoolArray | None = None,
) -> Steps[Measurement]:
    """Estimate the convexity rank of a shape, or of some of its faces (eq. 1).

    The rank is the share of pairs of surface points that see each other.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units.
    parameters : Parameters
        Only the settings of samples and lines of sight are used. With `members`, only
        `samples` and `seed` are: all pairs of samples are tested. Blocks are not used:
        random pairs are tested in their place.
    cache : ShapeCache
        Keeps the prepared shape for the next call.
    members : (P,) bool, optional
        Polygons to measure, or points of a cloud; all if left out. Lines of sight run
        through the whole shape.

    Returns
    -------
    Steps of Measurement

    Raises
    ------
    TypeError
        If an argument has a wrong type.
    DecompositionError
        If the shape cannot be normalized, or if the members do not fit it, have no
        area, or do not lie at the outline of a flat mesh.
    """
    check_types(
        shape=(shape, Shape),
        parameters=(parameters, Parameters),
        cache=(cache, ShapeCache),
    )
    check_members(members, shape)
    prepared = yield from within(cache.prepare(shape), 0.0, 0.1)
    if members is not None:
        prepared = yield from within(_part_of(prepared, members), 0.1, 0.1)
    tested = _without_blocks(parameters, members is not None)
    steps = find_lines_of_sight(prepared, tested)
    sight = yield from within(steps, 0.1, 1.0)
    n_samples, pairs = len(sight.samples), sight.rank_pairs
    return Measurement(*pairs.rank_of_all(), n_samples, prepared.notes, pairs.n_cast)


def _without_blocks(parameters: Parameters, of_members: bool) -> Parameters:
    """Return parameters with which all pairs of samples are tested, or random ones."""
    if of_members:
        n_samples = min(parameters.samples, _MOST_SAMPLES)
        return Parameters(sight="ALL_PAIRS", samples=n_samples, seed=parameters.seed)
    if parameters.sight == "BLOCKS":
        n_rays = parameters.rays or _PAIRS_PER_SAMPLE
        return replace(parameters, sight="ALL_PAIRS", rays=n_rays)
    return parameters


def _part_of(shape: PreparedShape, members: BoolArray) -> Steps[PreparedShape]:
    """Return the chosen faces as a shape; raise if no sample can lie on them."""
    graph = yield from shape.graph_in_steps()
    area = graph.areas[shape.nodes[members]].sum()
    part = shape.part(members)
    if area <= LEAST_AREA or len(part.sampled) == 0:
        raise DecompositionError(
            "The chosen faces have no area, lie within the solid, or none lies at the"
            " outline of the flat mesh; select other faces."
        )
    return part
