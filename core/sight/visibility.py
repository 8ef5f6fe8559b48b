"""The expensive half of a decomposition: samples, their lines of sight, embedding."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from ..clusters.embedding import embed
from ..errors import DecompositionError
from ..geometry.sampling import Samples, sample_faces, sample_surface
from ..geometry.transfer import Transfer
from ..parameters.parts import Parameters
from ..steps.memo import Memo
from ..steps.progress import Progress, Steps, within
from .cone import see_cones, see_uniform_pairs
from .containers import Grid, find_enclosed, see_through
from .lines import see_all_pairs, viewpoints
from .pairs import Matrix, PairVisibility
from .prepared import Form, Shape, form_of
from .ray_march import MakeCaster, RayMarcher

# Samples of which a matrix of all pairs fits into memory.
_MOST_FOR_ALL_PAIRS = 10_000
# Eigenvectors are looked for by this many: as many as a search of default settings
# needs.
_COORDINATES = 13
# What is remembered: two embeddings, their clusters, moves and pieces of these,
# tallies, the sides of a symmetric shape, the parts of three cuts.
_KEPT = 10


@dataclass(frozen=True, eq=False)
class Sight:
    """What samples of a shape see of each other.

    Attributes
    ----------
    form : Form
        The shape, ready for it.
    samples : Samples
    scene : RayMarcher
        What rays are cast at.
    along_rays : PairVisibility
        Whose visible pairs are the affinity: the LoS matrix (eq. 3), or what is known
        of it from rays in cones.
    pairs : PairVisibility
        For convexity ranks and psi.
    """

    form: Form
    samples: Samples
    scene: RayMarcher
    along_rays: PairVisibility
    pairs: PairVisibility


@dataclass(frozen=True, eq=False)
class Visibility:
    """All that a new number of parts, balance or smoothness can be found from.

    Attributes
    ----------
    samples : Samples
    ranked : PairVisibility
        Which samples are in line of sight, for convexity ranks.
    pairs : PairVisibility
        Which samples see each other, through containers too, for psi.
    affinity : (N, N) float32 or sparse
        What the embedding comes from.
    transfer : Transfer
        Between the samples and the nodes of the surface.
    form : Form
        Of the shape.
    unit_area : float
        Area that 1 stands for, in the units of the shape squared.
    memory : Memo
        What was found from it.
    """

    samples: Samples
    ranked: PairVisibility
    pairs: PairVisibility
    affinity: Matrix
    transfer: Transfer
    form: Form
    unit_area: float
    memory: Memo = field(default_factory=lambda: Memo(_KEPT))

    def embedding(self, n_parts: int, stochastic: bool) -> NDArray[np.float64]:
        """Return coordinates of the samples for some number of parts, (N, n) float.

        Eigenvectors differ a little by how many of them are looked for: they come in
        fixed numbers, so that parts do not depend on how many more are tried.
        """
        n_coordinates = _COORDINATES * -(-n_parts // _COORDINATES)
        return self.memory.recall(
            ("embedding", n_coordinates, stochastic),
            lambda: embed(self.affinity, n_coordinates, stochastic),
        )


def look(
    shape: Shape,
    parameters: Parameters,
    make_caster: MakeCaster,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Sight]:
    """Sample the surface of `shape` and find the lines of sight between samples.

    Parameters
    ----------
    shape : TriangleMesh or PointCloud
        In any units; nothing asks for a closed or connected surface.
    parameters : Parameters
    make_caster : callable
        Returns a RayCaster for the mesh it is given: `shape` centered, scaled and
        oriented, with its shells set apart, or the splats of its points.
    members : (P,) bool, optional
        Polygons, or points of a cloud, that samples lie on; all of them if left out.
        Lines of sight run through the whole shape.

    Returns
    -------
    Steps of Sight

    Raises
    ------
    DecompositionError
        If the surface has no area, or more faces than all pairs of can be looked up,
        where faces are the samples.
    """
    form = yield from within(form_of(shape), 0.0, 0.01)
    if members is not None:
        form = form.part(members)
    yield Progress("Samples", 0.01)
    rng = np.random.default_rng(parameters.seed)
    samples = _samples(form, parameters, rng)
    yield Progress("Ray tree", 0.01)
    caster = make_caster(form.targets)
    yield Progress("Ray tree", 0.015)
    scene = RayMarcher(form.targets, caster, form.grain, form.tilt)
    yield Progress("Ray tree", 0.018)
    views = viewpoints(scene, samples)
    if parameters.sight == "ALL_PAIRS":
        los = yield from within(see_all_pairs(scene, samples, views), 0.02, 1.0)
        pairs = PairVisibility(los.astype(np.float32), None)
        return Sight(form, samples, scene, pairs, pairs)
    positive, negative = yield from within(
        see_cones(
            scene, samples, views, parameters.rays, parameters.cone_angle, form.plane
        ),
        0.02,
        0.8,
    )
    along_rays = pairs = PairVisibility(positive, positive + negative)
    if parameters.psi_pairs == "UNIFORM":
        pairs = yield from within(
            see_uniform_pairs(scene, samples, views, rng), 0.8, 1.0
        )
    return Sight(form, samples, scene, along_rays, pairs)


def see(
    shape: Shape,
    parameters: Parameters,
    make_caster: MakeCaster,
    members: NDArray[np.bool_] | None = None,
) -> Steps[Visibility]:
    """Return the visibility of `shape`; parameters and errors are those of `look`."""
    sight = yield from within(look(shape, parameters, make_caster, members), 0.0, 0.8)
    ranked = sight.pairs
    if parameters.containers == "FILLED" and sight.form.plane is None:
        sight = yield from within(_through_containers(sight), 0.8, 0.9)
    yield Progress("Surface", 0.9)
    surface = sight.form.surface()
    yield Progress("Surface", 0.95)
    node_of_sample = sight.form.targets.polygons[sight.samples.triangles]
    transfer = Transfer(sight.samples, node_of_sample, surface)
    return Visibility(
        sight.samples,
        ranked,
        sight.pairs,
        sight.along_rays.visible,
        transfer,
        sight.form,
        shape.diagonal**2,
    )


def _samples(form: Form, parameters: Parameters, rng: np.random.Generator) -> Samples:
    """Return samples of those targets that are nodes of the form."""
    sampled = np.flatnonzero(form.targets.polygons <= form.nodes.max(initial=-1))
    mesh = form.targets
    if len(sampled) < len(mesh.triangles):
        if mesh.areas[sampled].sum() <= 0:
            raise DecompositionError(
                "The part has no surface that lines of sight could start from; choose"
                " another one."
            )
        mesh = replace(
            mesh, triangles=mesh.triangles[sampled], polygons=mesh.polygons[sampled]
        )
    if parameters.sampling == "FACES":
        samples = sample_faces(mesh)
        _check_number(samples, parameters)
    else:
        samples = sample_surface(mesh, parameters.samples, rng)
    return replace(samples, triangles=sampled[samples.triangles])


def _check_number(samples: Samples, parameters: Parameters) -> None:
    """Raise unless the number of faces suits the other parameters."""
    if parameters.sight == "ALL_PAIRS" and len(samples) > _MOST_FOR_ALL_PAIRS:
        raise DecompositionError(
            f"The lines of sight between all pairs of {len(samples):,} faces are too"
            " many; choose Cone for Lines of Sight or By Area for Sampling."
        )


def _through_containers(sight: Sight) -> Steps[Sight]:
    """Return the sight with the enclosed outside seen through."""
    grid = yield from within(find_enclosed(sight.scene, sight.form.targets), 0.0, 0.6)
    if not grid.encloses:
        return sight
    along_rays = yield from within(_revealed(sight, sight.along_rays, grid), 0.6, 0.9)
    pairs = along_rays
    if sight.pairs is not sight.along_rays:
        pairs = yield from within(_revealed(sight, sight.pairs, grid), 0.9, 1.0)
    return replace(sight, along_rays=along_rays, pairs=pairs)


def _revealed(sight: Sight, pairs: PairVisibility, grid: Grid) -> Steps[PairVisibility]:
    """Return the pairs, those that see each other through containers visible, too."""
    first, second = pairs.hidden()
    places = sight.samples.positions
    through = yield from see_through(grid, places[first], places[second])
    return pairs.revealed(first[through], second[through])
