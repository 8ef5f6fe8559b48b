"""The expensive half of a decomposition: samples, lines of sight, embedding."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .cone import see_cones, see_uniform_pairs
from .convexity import KnownPairs, Matrix
from .orientation import oriented
from .parameters import Parameters
from .progress import Progress, Steps, within
from .sampling import Samples, sample_surface
from .scene import RayCaster, Scene
from .shapes import TriangleMesh
from .shells import set_apart
from .sight import see_all_pairs, viewpoints
from .spectral import embed
from .transfer import Transfer

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
    affinity : (N, N) float32 or sparse
        The LoS matrix (eq. 3), or its positive entries.
    pairs : KnownPairs
        For convexity ranks and psi.
    """

    mesh: TriangleMesh
    notes: tuple[str, ...]
    samples: Samples
    affinity: Matrix
    pairs: KnownPairs


@dataclass(frozen=True, eq=False)
class Visibility:
    """All that a new number of parts, balance or smoothness can be found from.

    Attributes
    ----------
    samples : Samples
    pairs : KnownPairs
        Which samples see each other.
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
        If the surface has no area.
    """
    mesh, notes = oriented(mesh.normalized())
    apart = set_apart(mesh)
    yield Progress("Samples", 0.0)
    rng = np.random.default_rng(parameters.seed)
    samples = sample_surface(apart, parameters.samples, rng)
    yield Progress("Ray tree", 0.01)
    scene = Scene(apart, make_caster(apart))
    views = viewpoints(scene, samples)
    if parameters.sight == "ALL_PAIRS":
        los = yield from within(see_all_pairs(scene, samples, views), 0.02, 1.0)
        matrix = los.astype(np.float32)
        return Sight(mesh, notes, samples, matrix, KnownPairs(matrix, None))
    positive, negative = yield from within(
        see_cones(scene, samples, views, parameters.rays, parameters.cone_angle),
        0.02,
        0.8,
    )
    if parameters.psi_pairs == "RAYS":
        return Sight(
            mesh, notes, samples, positive, KnownPairs(positive, positive + negative)
        )
    pairs = yield from within(see_uniform_pairs(scene, samples, views, rng), 0.8, 1.0)
    return Sight(mesh, notes, samples, positive, pairs)


def see(
    mesh: TriangleMesh, parameters: Parameters, make_caster: MakeCaster
) -> Steps[Visibility]:
    """Return the visibility of `mesh`; parameters and errors are those of `look`."""
    sight = yield from within(look(mesh, parameters, make_caster), 0.0, 0.9)
    yield Progress("Embedding", 0.9)
    transfer = Transfer(sight.samples, sight.mesh)
    yield Progress("Embedding", 0.95)
    embedding = embed(
        sight.affinity,
        parameters.eigenvectors or max(parameters.parts, parameters.max_parts),
        parameters.regularization,
        parameters.normalization == "STOCHASTIC",
    )
    return Visibility(
        sight.samples, sight.pairs, embedding, transfer, mesh.diagonal**2, sight.notes
    )
