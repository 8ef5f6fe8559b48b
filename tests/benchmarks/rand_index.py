"""Rand Index error of the parts on the Princeton Segmentation Benchmark.

    make bench PSB=DIRECTORY

DIRECTORY has the benchmark's own layout: off/N.off and seg/Benchmark/N/N_k.seg. The
error of a model is 1 - Rand Index over pairs of faces, the mean over its human
segmentations; "given" asks for the median number of their parts, "auto" for none.
"""

import argparse
import json
import os
import statistics
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
from weak_convex_decomposition.core.decomposition import find_parts
from weak_convex_decomposition.core.parameters import Parameters
from weak_convex_decomposition.core.progress import run
from weak_convex_decomposition.core.shapes import TriangleMesh
from weak_convex_decomposition.core.visibility import see
from weak_convex_decomposition.operators.bridge.ray_caster import BvhRayCaster
from weak_convex_decomposition.operators.headless.off_reader import read_off

# fmt: off
CATEGORIES = (
    "Human", "Cup", "Glasses", "Airplane", "Ant", "Chair", "Octopus", "Table",
    "Teddy", "Hand", "Plier", "Fish", "Bird", "Spring", "Armadillo", "Bust", "Mech",
    "Bearing", "Vase", "FourLeg",
)
# fmt: on
# Of the whole benchmark, by Chen, Golovinskiy and Funkhouser 2009. All but the
# humans' own are quoted from memory and approximate.
PUBLISHED = (
    ("Humans among themselves", 0.103, "recomputed"),
    ("Randomized Cuts", 0.152, "k given"),
    ("Normalized Cuts", 0.172, "k given"),
    ("Shape Diameter", 0.175, "automatic"),
    ("Core Extraction", 0.210, "automatic"),
    ("Fitting Primitives", 0.214, "k given"),
    ("Random Walks", 0.218, "k given"),
    ("K-Means", 0.251, "k given"),
)


@dataclass(frozen=True)
class Score:
    """What was measured on one model."""

    model: int
    given: float
    auto: float
    n_humans: int
    n_auto: int
    psi_before: float
    psi: float
    seconds: float

    @property
    def category(self) -> str:
        return CATEGORIES[(self.model - 1) // 20]


def rand_index_error(labels: np.ndarray, truth: np.ndarray) -> float:
    """Return the share of pairs of faces on which two segmentations disagree."""
    _, labels = np.unique(labels, return_inverse=True)
    _, truth = np.unique(truth, return_inverse=True)
    table = np.bincount(labels * (truth.max() + 1) + truth).astype(float)
    ours, theirs = (np.bincount(each).astype(float) for each in (labels, truth))
    agreed = (table**2).sum()
    pairs = len(labels) * (len(labels) - 1) / 2
    return (((ours**2).sum() + (theirs**2).sum()) / 2 - agreed) / pairs


def score(directory: Path, model: int, parameters: Parameters) -> Score:
    """Decompose one model with k chosen, then with k given."""
    mesh = read_model(directory / "off" / f"{model}.off")
    humans = [
        np.loadtxt(path, dtype=int)
        for path in sorted((directory / "seg/Benchmark" / str(model)).glob("*.seg"))
    ]
    n_humans = int(np.median([len(np.unique(human)) for human in humans]))
    started = time.perf_counter()
    visibility = run(see(mesh, parameters, BvhRayCaster))
    auto = run(find_parts(visibility, parameters))
    seconds = time.perf_counter() - started
    given = run(find_parts(visibility, replace(parameters, parts=n_humans)))

    def error(labels: np.ndarray) -> float:
        return statistics.fmean(rand_index_error(labels, human) for human in humans)

    return Score(
        model,
        error(given.labels),
        error(auto.labels),
        n_humans,
        auto.n_parts,
        auto.psi_before,
        auto.psi,
        seconds,
    )


def read_model(path: Path) -> TriangleMesh:
    """Return the mesh in an .off file."""
    vertices, triangles = read_off(path)
    # The benchmark has nothing but triangles.
    return TriangleMesh(vertices, np.array(triangles), np.arange(len(triangles)))


def report(scores: list[Score], command: str) -> str:
    """Return the table by category, beside the published averages."""
    lines = [
        f"$ {command}",
        f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]},"
        f" NumPy {np.__version__}, {os.cpu_count()} cores",
        "",
        f"{'category':24}{'given':>7}{'auto':>7}{'k humans':>10}{'k auto':>8}"
        f"{'psi 1':>8}{'psi':>7}{'seconds':>9}",
    ]
    for category in dict.fromkeys(score.category for score in scores):
        members = [score for score in scores if score.category == category]
        lines.append(_row(category, members))
    lines += ["", _row("all", scores), ""]
    lines += ["Published averages over the whole benchmark:"]
    lines += [f"{name:24}{error:7.3f}  {how}" for name, error, how in PUBLISHED]
    lines += ["", "model  given   auto  k humans  k auto  psi 1    psi  seconds"]
    lines += [
        f"{s.model:5}{s.given:7.3f}{s.auto:7.3f}{s.n_humans:10}{s.n_auto:8}"
        f"{s.psi_before:7.3f}{s.psi:7.3f}{s.seconds:9.2f}"
        for s in scores
    ]
    return "\n".join(lines)


def _row(name: str, scores: list[Score]) -> str:
    """Return the means of some scores, and the median of their seconds."""

    def mean(field: str) -> float:
        return statistics.fmean(getattr(score, field) for score in scores)

    return (
        f"{name:24}{mean('given'):7.3f}{mean('auto'):7.3f}{mean('n_humans'):10.1f}"
        f"{mean('n_auto'):8.1f}{mean('psi_before'):8.3f}{mean('psi'):7.3f}"
        f"{statistics.median(score.seconds for score in scores):9.2f}"
    )


def main() -> int:
    """Score every model of a directory and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument(
        "--models", type=int, nargs="*", help="numbers of models; all by default"
    )
    parser.add_argument(
        "--parameters",
        type=json.loads,
        default={},
        metavar="JSON",
        help='fields of Parameters, such as {"sight": "CONE"}',
    )
    arguments = parser.parse_args()
    models = arguments.models or sorted(
        int(path.stem) for path in (arguments.directory / "off").glob("*.off")
    )
    if not models:
        parser.error(f"no models: {arguments.directory}/off holds no .off files")
    scores = []
    for model in models:
        done = score(arguments.directory, model, Parameters(**arguments.parameters))
        scores.append(done)
        print(f"{model}: {done.given:.3f} {done.auto:.3f}", file=sys.stderr)
    print(report(scores, " ".join(["python", *sys.argv])))
    return 0


if __name__ == "__main__":
    sys.exit(main())
