"""Parts of point clouds against those of the meshes they are drawn from.

    make bench-clouds PSB=DIRECTORY [BENCH="--models 13 33 --normals given --embree"]

5,000 points on each model, with noise or cut off where a scanner on one side sees
nothing. Errors are 1 - Rand Index over pairs of these points, the mean over the human
segmentations, with the number of parts found; the mesh's parts are looked up at the
same points. --normals leaves out the other rows. With --embree rays are those of
embreex, the same hits in less time, which has to be installed.
"""

import statistics
import sys
from dataclasses import dataclass
from itertools import groupby

import bpy  # noqa: F401  # first: it brings mathutils
import checkout  # noqa: F401  # makes the package importable
import numpy as np
from computed import decompose
from over_models import add_jobs, measured, parse, parser
from princeton import mean_error, read_humans, read_model
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.geometry.point_cloud import PointCloud
from weak_convex_decomposition.core.geometry.sampling import Samples, sample_surface
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight.ray_caster import MakeCaster
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster

_POINTS = 5000
# Noise in diagonals, share that is cut away, whether normals are given.
_CASES = (
    (0.0, 0.0, True),
    (0.005, 0.0, True),
    (0.01, 0.0, True),
    (0.0, 0.25, True),
    (0.0, 0.5, True),
    (0.0, 0.0, False),
    (0.005, 0.0, False),
    (0.01, 0.0, False),
    (0.0, 0.5, False),
)


@dataclass
class Score:
    """What came of one cloud: errors, and the share of normals that point outwards."""

    model: int
    case: int
    cloud: float
    mesh: float
    outward: float


def scores(
    model: int,
    mesh: TriangleMesh,
    humans: list,
    parameters: Parameters,
    make_caster: MakeCaster,
    cases: list[int],
) -> list[Score]:
    """Decompose a model and its clouds of some cases, rows of `_CASES`."""
    labels = decompose(mesh, parameters, make_caster=make_caster).labels
    found = []
    for case in cases:
        noise, missing, oriented = _CASES[case]
        rng = np.random.default_rng(model)
        samples = sample_surface(mesh, _POINTS, rng)
        kept = scanned(mesh, samples, missing, rng)
        jitter = noise * mesh.diagonal * rng.normal(size=(len(kept), 3))
        normals = samples.normals[kept]
        cloud = PointCloud(
            samples.positions[kept] + jitter, normals if oriented else None
        )
        parts = decompose(cloud, parameters, make_caster=make_caster)
        faces = mesh.polygons[samples.triangles[kept]]
        truths = [human[faces] for human in humans]
        used = normals if parts.normals is None else parts.normals
        outward = float(((used * normals).sum(axis=1) > 0).mean())
        errors = (mean_error(each, truths) for each in (parts.labels, labels[faces]))
        found.append(Score(model, case, *errors, outward))
    return found


def scanned(
    mesh: TriangleMesh, samples: Samples, missing: float, rng: np.random.Generator
) -> np.ndarray:
    """Return the samples that are left by a scanner that looks from one side.

    Hidden ones go first, then those that are seen at the flattest angle.
    """
    towards = rng.normal(size=3)
    towards /= np.linalg.norm(towards)
    starts = samples.positions + 1e-4 * mesh.diagonal * samples.normals
    hits, _ = BvhRayCaster(mesh).first_hit(
        starts,
        np.broadcast_to(towards, starts.shape),
        np.full(len(starts), 2 * mesh.diagonal),
    )
    seen = samples.normals @ towards - 2.0 * (hits >= 0)
    return np.sort(np.argsort(seen, kind="stable")[int(missing * len(seen)) :])


def table(rows: list[Score]) -> str:
    """Return the means of each case in a table."""
    lines = [
        "| noise | cut away | normals | outward | points | mesh | difference |",
        "|---|---|---|---|---|---|---|",
    ]
    rows = sorted(rows, key=lambda row: row.case)
    for case, group in groupby(rows, key=lambda row: row.case):
        noise, missing, oriented = _CASES[case]
        each = list(group)
        cloud, mesh, outward = (
            statistics.fmean(getattr(row, name) for row in each)
            for name in ("cloud", "mesh", "outward")
        )
        lines.append(
            f"| {noise:.1%} | {missing:.0%} | {'given' if oriented else 'estimated'} |"
            f" {outward:.1%} | {cloud:.3f} | {mesh:.3f} | {cloud - mesh:+.3f} |"
        )
    return "\n".join(lines)


def main() -> int:
    """Score every model of a directory and print the table."""
    options = parser(__doc__)
    add_jobs(options)
    options.add_argument("--embree", action="store_true", help="cast rays by Embree")
    options.add_argument(
        "--normals", choices=["given", "estimated"], help="only rows with such normals"
    )
    arguments = parse(options)
    cases = [
        case
        for case, (_, _, oriented) in enumerate(_CASES)
        if arguments.normals in (None, "given" if oriented else "estimated")
    ]
    make_caster = BvhRayCaster
    if arguments.embree:
        from weak_convex_decomposition.operators.bridge.rays.embree import (
            EmbreeRayCaster as make_caster,
        )

    def measure(model: int) -> list[Score]:
        mesh = read_model(arguments.directory, model)
        humans = read_humans(arguments.directory, model)
        print(model, file=sys.stderr)
        return scores(model, mesh, humans, arguments.parameters, make_caster, cases)

    rows = measured(arguments, measure, Score)
    n_models = len({row.model for row in rows})
    print(f"$ {' '.join(['python', *sys.argv])}\n\n{n_models} models\n\n{table(rows)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
