"""Rand Index error of the parts on the Princeton Segmentation Benchmark, and psi.

    make bench PSB=DIRECTORY [BENCH="--beside FOLDER --fresh"]

DIRECTORY has the benchmark's own layout: off/N.off and seg/Benchmark/N/N_k.seg. The
error of a model is 1 - Rand Index over pairs of faces, the mean over its human
segmentations; "given" asks for the median number of their parts, "auto" for none.
"""

import os
import statistics
import sys
import time
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
from kmeans_parts import clusters, connected_clusters
from over_models import add_jobs, measured, parse, parser
from princeton import mean_error, median_count, read_humans, read_model
from score_table import Score, report
from symmetry import find_mirror
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parts.find import Decomposition
from weak_convex_decomposition.core.sight.visibility import find_lines_of_sight
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster


def score(
    directory: Path,
    model: int,
    parameters: Parameters,
    beside: Path | None,
    fresh: bool,
) -> Score:
    """Decompose one model with k chosen, then with k given."""
    mesh = read_model(directory, model)
    humans = read_humans(directory, model)
    n_humans = median_count(humans)
    given_parameters = replace(parameters, parts=n_humans)
    started, processor_started = time.perf_counter(), time.process_time()
    cache = ShapeCache(BvhRayCaster)
    auto = run(decompose_in_steps(mesh, parameters, cache))
    seconds = time.perf_counter() - started
    processor_seconds = time.process_time() - processor_started
    given = run(decompose_in_steps(mesh, given_parameters, cache))
    return Score(
        model=model,
        given=mean_error(given.labels, humans),
        auto=mean_error(auto.labels, humans),
        n_humans=n_humans,
        n_auto=auto.n_parts,
        psi_before=auto.psi_before,
        psi=auto.psi,
        seconds=seconds,
        processor_seconds=processor_seconds,
        **asymmetries(mesh, auto.labels, humans),
        **(on_fresh_samples(mesh, cache, auto, parameters) if fresh else {}),
        **(of_coacd(beside, model, humans) if beside else {}),
    )


def asymmetries(
    mesh: TriangleMesh, labels: np.ndarray, humans: list[np.ndarray]
) -> dict[str, float]:
    """Return the asymmetry of labels and the humans' mean, if there is a mirror."""
    mirror = find_mirror(mesh)
    if mirror is None:
        return {}
    return {
        "asymmetry": mirror.asymmetry(labels),
        "human_asymmetry": statistics.fmean(map(mirror.asymmetry, humans)),
    }


def on_fresh_samples(
    mesh: TriangleMesh,
    cache: ShapeCache,
    auto: Decomposition,
    parameters: Parameters,
) -> dict[str, float]:
    """Return psi (eq. 5) by all pairs of samples that no parts were found from."""
    shape = run(cache.prepare(mesh))
    memo = run(cache.see(shape, parameters))
    others = Parameters(sight="ALL_PAIRS", seed=parameters.seed + 1)
    fresh = run(find_lines_of_sight(shape, others))
    polygons = mesh.polygons[fresh.samples.triangles]

    def psi(labels: np.ndarray) -> float:
        tally = fresh.rank_pairs.tally(labels[polygons], int(labels.max()) + 1)
        return tally.psi(parameters.alpha)

    k = auto.n_parts
    return {
        "fresh_psi": psi(auto.labels),
        "kmeans_psi": psi(clusters(memo, k, parameters)),
        "connected_psi": psi(connected_clusters(memo, k, parameters)),
    }


def of_coacd(segments: Path, model: int, humans: list[np.ndarray]) -> dict[str, float]:
    """Return the error and seconds of CoACD, if it did not fail on the model."""
    if not (segments / f"{model}.seconds").exists():
        return {}
    labels = np.loadtxt(segments / f"{model}.seg", dtype=int)
    return {
        "coacd": mean_error(labels, humans),
        "coacd_seconds": float((segments / f"{model}.seconds").read_text()),
    }


def main() -> int:
    """Score every model of a directory and print the table."""
    options = parser(__doc__)
    add_jobs(options)
    options.add_argument(
        "--beside", type=Path, metavar="FOLDER", help="what bench-coacd wrote"
    )
    options.add_argument(
        "--fresh",
        action="store_true",
        help="compare psi with that of k-means on other samples, in twice the time",
    )
    arguments = parse(options)

    def measure(model: int) -> list[Score]:
        done = score(
            arguments.directory,
            model,
            arguments.parameters,
            arguments.beside,
            arguments.fresh,
        )
        print(f"{model}: {done.given:.3f} {done.auto:.3f}", file=sys.stderr)
        return [done]

    heading = (
        f"$ {' '.join(['python', *sys.argv])}\n"
        f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]},"
        f" NumPy {np.__version__}, {os.cpu_count()} cores"
    )
    print(report(measured(arguments, measure, Score), heading))
    return 0


if __name__ == "__main__":
    sys.exit(main())
