"""The algorithm of the paper, one line for each stage."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from .cache import ShapeCache
from .geometry.array_checks import check_types
from .geometry.shape import Shape, check_members
from .parameters.parts import Parameters
from .parts.convex_whole import as_one_part, stays_whole
from .parts.details.levels import finds_details, split_further
from .parts.find import find_parts
from .parts.pairs import mirror_pairs
from .results.parts import Decomposition
from .steps.arrays import BoolArray
from .steps.memo import digest
from .steps.progress import Steps, within

# Progress at the end of the stages surface, lines of sight and parts. With further
# levels, these three are only the first quarter; with details, more.
_ONE_LEVEL = (0.02, 0.8, 1.0)
_DETAILS = (0.02, 0.7, 0.85)
_LEVELS = (0.01, 0.15, 0.25)


def decompose_in_steps(
    shape: Shape,
    parameters: Parameters,
    cache: ShapeCache,
    members: BoolArray | None = None,
    rough: bool = False,
) -> Steps[Decomposition]:
    """Split a shape, or some of its faces, into weakly convex parts.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units. It may be open, in several pieces or not manifold.
    parameters : Parameters
        `seams` is not used: faces stay as they are.
    cache : ShapeCache
        Keeps the shape and its lines of sight for the next call.
    members : (P,) bool, optional
        Polygons, or points, to split; all if left out. Rays cross the whole shape.
    rough : bool, optional
        Whether a first look at the parts is enough.

    Returns
    -------
    Steps of Decomposition
        Its labels are those of all polygons or points, or of the members in order.

    Raises
    ------
    TypeError
        If an argument has a wrong type.
    DecompositionError
        If the shape has no area, if faces are the samples and there are too many, or if
        `members` does not fit the shape.

    References
    ----------
    Asafi, Goren and Cohen-Or 2013, "Weak Convex Decomposition by Lines-of-sight".
    """
    check_types(
        shape=(shape, Shape),
        parameters=(parameters, Parameters),
        cache=(cache, ShapeCache),
    )
    check_members(members, shape)
    steps = partial(_decompose, shape, parameters, cache, members, rough)
    if rough:  # it is as good as what is known
        return (yield from steps())
    key = "parts", parameters, None if members is None else digest(members)
    return replace((yield from cache.recall(shape, key, steps)))  # it may be kept


def _decompose(
    shape: Shape,
    parameters: Parameters,
    cache: ShapeCache,
    members: BoolArray | None,
    rough: bool,
) -> Steps[Decomposition]:
    """Split a shape that is not known yet."""
    ready, seen, done = _ends_of_stages(parameters)
    # Section 5: replace points by splats, turn faces outwards, find shells.
    prepared = yield from within(cache.prepare(shape), 0.0, ready)
    prepared = prepared if members is None else prepared.part(members)
    if stays_whole(prepared, parameters):
        return as_one_part(prepared)
    # Sections 3 and 5: place samples, and fill the matrix of lines of sight (eq. 3).
    memo = yield from within(cache.see(prepared, parameters), ready, seen)
    # Section 4: embed, cluster, choose k by psi (eq. 5), cut the seams (eq. 4).
    found = yield from within(find_parts(memo, parameters, rough), seen, done)
    # Section 5: split parts further, each seen by samples of its own.
    steps = split_further(memo, found, parameters, cache.see)
    found = yield from within(steps, done, 1.0)
    if members is not None:
        return found
    # Beyond the paper: which parts are mirror images of each other.
    return replace(found, pairs=(yield from mirror_pairs(memo, found.labels)))


def _ends_of_stages(parameters: Parameters) -> tuple[float, float, float]:
    """Return the progress at the end of surface, lines of sight and parts."""
    if finds_details(parameters):
        return _DETAILS
    return _LEVELS if parameters.levels > 1 else _ONE_LEVEL
