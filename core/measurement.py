"""The convexity rank of some faces of a shape (eq. 1)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from .decomposition import Measurement
from .errors import DecompositionError
from .geometry.mesh import TriangleMesh
from .geometry.sampling import sample_surface
from .parameters.parts import Parameters
from .sight.lines import see_all_pairs, viewpoints
from .sight.pairs import PairVisibility
from .sight.prepared import form_of
from .sight.ray_march import MakeCaster, RayMarcher
from .steps.progress import Progress, Steps, within

# Faces of less area are lines or points, in squared diagonals.
_LEAST_AREA = 1e-9
# Samples, at most: all pairs of them are looked up.
_MOST_SAMPLES = 2000


def measure_region(
    mesh: TriangleMesh,
    faces: NDArray[np.bool_],
    parameters: Parameters,
    make_caster: MakeCaster,
) -> Steps[Measurement]:
    """Estimate the share of pairs of points on some faces that see each other.

    Parameters
    ----------
    mesh : TriangleMesh
        The whole shape, which lines of sight run through.
    faces : (P,) bool
        Which polygons are meant.
    parameters : Parameters
        Only the number of samples and the seed matter.
    make_caster : callable
        As `visibility.look` has it.

    Returns
    -------
    Steps of Measurement

    Raises
    ------
    DecompositionError
        If no face is meant, or none with an area; of a flat mesh, none at the outline.
    """
    form = yield from within(form_of(mesh), 0.0, 0.1)
    targets = form.targets
    rows = np.flatnonzero(faces[targets.polygons])
    area = mesh.areas[faces[mesh.polygons]].sum() / mesh.diagonal**2
    if area <= _LEAST_AREA or len(rows) == 0:
        raise DecompositionError(
            "The faces chosen have no area, or a flat mesh has none of them at its"
            " outline; select others."
        )
    yield Progress("Samples", 0.1)
    samples = sample_surface(
        TriangleMesh(targets.vertices, targets.triangles[rows], np.zeros_like(rows)),
        min(parameters.samples, _MOST_SAMPLES),
        np.random.default_rng(parameters.seed),
    )
    samples = replace(samples, triangles=rows[samples.triangles])
    scene = RayMarcher(targets, make_caster(targets), form.grain, form.tilt)
    yield Progress("Lines of sight", 0.15)
    views = viewpoints(scene, samples)
    los = yield from within(see_all_pairs(scene, samples, views), 0.2, 1.0)
    pairs = PairVisibility(los.astype(np.float32), None)
    rank, standard_error = pairs.rank_of_all()
    return Measurement(rank, standard_error, len(samples), form.notes)
