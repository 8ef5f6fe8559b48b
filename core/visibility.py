"""The expensive half of a decomposition: samples, lines of sight, embedding."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .cone import see_cones, see_uniform_pairs
from .containers import Grid, find_enclosed, see_through
from .convexity import KnownPairs
from .errors import DecompositionError
from .orientation import oriented
from .parameters import Parameters
from .progress import Progress, Steps, within
from .sampling import Samples, sample_faces, sample_surface
from .scene import RayCaster, Scene
from .shapes import TriangleMesh
from .shells import set_apart
from .sight import see_all_pairs, viewpoints
from .spectral import embed
from .transfer import Transfer

# Samples of which a matrix of all pairs fits into memory.
_MOST_FOR_ALL_PAIRS = 10_000

MakeCaster = Callable[[TriangleMesh], RayCaster]


@dataclass(frozen=True, eq=False)
class Sight:
    """What samples of a shape see of each other.

    Attributes
    ----------
    mesh : TriangleMesh
        Oriented, centered and of diagonal 1.
    notes : tuple of str
        Sentences to the user about what was turned.
    samples : Samples
    scene : Scene
        What rays are cast at: `mesh` with its shells set apart.
    along_rays : KnownPairs
        Whose visible pairs are the affinity: the LoS matrix (eq. 3), or what is known
        of it from rays in cones.
    pairs : KnownPairs
        For convexity ranks and psi.
    """

    mesh: TriangleMesh
    notes: tuple[str, ...]
    samples: Samples
    scene: Scene
    along_rays: KnownPairs
    pairs: KnownPairs


@dataclass(frozen=True, eq=False)
class Visibility:
    """All that a new number of parts, balance or smoothness can be found from.

    Attributes
    ----------
    samples : Samples
    ranked : KnownPairs
        Which samples are in line of sight, for convexity ranks.
    pairs : KnownPairs
        Which samples see each other, through containers too, for psi.
    embedding : (N, n) float
        Coordinates of the samples.
    transfer : Transfer
        Between the samples and the polygons.
    unit_area : float
        Area that 1 stands for, in the units of the mesh squared.
    notes : tuple of str
        Sentences to the user about the shape.
    """

    samples: Samples
    ranked: KnownPairs
    pairs: KnownPairs
    embedding: NDArray[np.float64]
    transfer: Transfer
    unit_area: float
    notes: tuple[str, ...]


def look(
    mesh: TriangleMesh, parameters: Parameters, make_caster: MakeCaster
) -> Steps[Sight]:
    """Sample the surface of `mesh` and find the lines of sight between samples.

    Parameters
    ----------
    mesh : TriangleMesh
        In any units; nothing asks for a closed or connected surface.
    parameters : Parameters
    make_caster : callable
        Returns a RayCaster for the mesh it is given: `mesh` centered, scaled and
        oriented, with its shells set apart.

    Returns
    -------
    Steps of Sight

    Raises
    ------
    DecompositionError
        If the surface has no area, or more faces than all pairs of can be looked up,
        where faces are the samples.
    """
    mesh, notes = oriented(mesh.normalized())
    apart = set_apart(mesh)
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    if parameters.sampling == "FACES":
        samples = sample_faces(apart)
        _check_number(samples, parameters)
    else:
        samples = sample_surface(apart, parameters.samples, rng)
    yield Progress("Ray tree", 0.01)
    scene = Scene(apart, make_caster(apart))
    views = viewpoints(scene, samples)
    if parameters.sight == "ALL_PAIRS":
        los = yield from within(see_all_pairs(scene, samples, views), 0.02, 1.0)
        pairs = KnownPairs(los.astype(np.float32), None)
        return Sight(mesh, notes, samples, scene, pairs, pairs)
    positive, negative = yield from within(
        see_cones(scene, samples, views, parameters.rays, parameters.cone_angle),
        0.02,
        0.8,
    )
    along_rays = pairs = KnownPairs(positive, positive + negative)
    if parameters.psi_pairs == "UNIFORM":
        pairs = yield from within(
            see_uniform_pairs(scene, samples, views, rng), 0.8, 1.0
        )
    return Sight(mesh, notes, samples, scene, along_rays, pairs)


def see(
    mesh: TriangleMesh, parameters: Parameters, make_caster: MakeCaster
) -> Steps[Visibility]:
    """Return the visibility of `mesh`; parameters and errors are those of `look`."""
    sight = yield from within(look(mesh, parameters, make_caster), 0.0, 0.8)
    ranked = sight.pairs
    if parameters.containers == "FILLED":
        sight = yield from within(_through_containers(sight), 0.8, 0.9)
    yield Progress("Embedding", 0.9)
    transfer = Transfer(sight.samples, sight.mesh)
    yield Progress("Embedding", 0.95)
    embedding = embed(
        sight.along_rays.visible,
        max(parameters.parts, parameters.max_parts),
        parameters.normalization == "STOCHASTIC",
    )
    return Visibility(
        sight.samples,
        ranked,
        sight.pairs,
        embedding,
        transfer,
        mesh.diagonal**2,
        sight.notes,
    )


def _check_number(samples: Samples, parameters: Parameters) -> None:
    """Raise unless the number of faces suits the other parameters."""
    if parameters.sight == "ALL_PAIRS" and len(samples) > _MOST_FOR_ALL_PAIRS:
        raise DecompositionError(
            f"The lines of sight between all pairs of {len(samples):,} faces are too"
            " many; choose Cone for Lines of Sight or By Area for Sampling."
        )


def _through_containers(sight: Sight) -> Steps[Sight]:
    """Return the sight with the enclosed outside seen through."""
    grid = yield from within(find_enclosed(sight.scene, sight.mesh), 0.0, 0.6)
    if not grid.encloses:
        return sight
    along_rays = yield from within(_revealed(sight, sight.along_rays, grid), 0.6, 0.9)
    pairs = along_rays
    if sight.pairs is not sight.along_rays:
        pairs = yield from within(_revealed(sight, sight.pairs, grid), 0.9, 1.0)
    return replace(sight, along_rays=along_rays, pairs=pairs)


def _revealed(sight: Sight, pairs: KnownPairs, grid: Grid) -> Steps[KnownPairs]:
    """Return the pairs, those that see each other through containers visible, too."""
    first, second = pairs.hidden()
    places = sight.samples.positions
    through = yield from see_through(grid, places[first], places[second])
    return pairs.revealed(first[through], second[through])
