"""Rand Index error of the parts of flat shapes, beside that of people.

    make bench-outlines OUTLINES=DIRECTORY [BENCH="--seeds 0 1 2"]

DIRECTORY is the 2D Shape Structure Dataset: triangulated outlines in Shapes/NAME.json,
a label for each triangle by each of 24 people or more in Annotations/NAME.json. The
parts of a person are the pieces of equal label that are connected across edges. The
error of an outline is 1 - Rand Index over pairs of triangles, the mean over people,
with the number of parts found. Beside it stands the error by area: each triangle then
counts as much as it is large. Means over seeds.
"""

import argparse
import json
import os
import statistics
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy
import checkout  # noqa: F401  # makes the package importable
import numpy as np
from computed import decompose
from princeton import median_count
from weak_convex_decomposition.core.geometry.graphs.face_graph import face_graph
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster


@dataclass(frozen=True)
class Score:
    """What was measured on one outline; each error by triangles, and by area."""

    name: str
    ours: np.ndarray
    people: np.ndarray
    one_part: np.ndarray
    n_ours: float
    n_people: float


def read_outline(directory: Path, name: str) -> tuple[TriangleMesh, list[np.ndarray]]:
    """Return the triangles of an outline in the plane, and each person's labels."""
    shape = json.loads((directory / "Shapes" / f"{name}.json").read_text())
    points = [(point["x"], point["y"], 0.0) for point in shape["points"]]
    corners = [[each[f"p{n}"] for n in (1, 2, 3)] for each in shape["triangles"]]
    mesh = TriangleMesh(np.array(points), np.array(corners), np.arange(len(corners)))
    people = json.loads((directory / "Annotations" / f"{name}.json").read_text())
    return mesh, [np.array(labels) for labels in people["annotations"]]


def score(
    directory: Path, name: str, parameters: Parameters, seeds: Sequence[int]
) -> Score:
    """Decompose one outline with each seed."""
    mesh, labels = read_outline(directory, name)
    graph = run(face_graph(mesh))
    people = [graph.pieces(each, 0.0) for each in labels]
    found = [
        decompose(mesh, replace(parameters, seed=seed), make_caster=BvhRayCaster)
        for seed in seeds
    ]
    # Share of people who have each two triangles in one part.
    share = np.mean([together(each) for each in people], axis=0)
    others = len(people) / (len(people) - 1)

    def errors(differences: np.ndarray) -> np.ndarray:
        each = np.ones(mesh.n_polygons), mesh.areas
        pairs = [np.outer(one, one) - np.diag(one * one) for one in each]
        return np.array([np.average(differences, weights=pair) for pair in pairs])

    return Score(
        name,
        np.mean([errors(abs(together(each.labels) - share)) for each in found], axis=0),
        errors(2 * share * (1 - share) * others),
        errors(1 - share),
        statistics.fmean(parts.n_parts for parts in found),
        median_count(people),
    )


def together(labels: np.ndarray) -> np.ndarray:
    """Return which two triangles have one label, (T, T) bool."""
    return labels[:, None] == labels


def report(scores: Sequence[Score], heading: str) -> str:
    """Return the table of all outlines, and of each."""
    errors = ("ours", "people", "one_part")
    titles = ("ours", "people", "one part")
    by_two = "".join(f"{title:>18}" for title in titles)
    kinds = "".join(f"{'triangles':>11}{'area':>7}" for _ in titles)

    def row(name: str, of: Callable[[str], np.ndarray]) -> str:
        cells = "".join(f"{a:11.3f}{b:7.3f}" for a, b in map(of, errors))
        return f"{name:18}{cells}{of('n_ours'):9.1f}{of('n_people'):10.1f}"

    def mean(some: Sequence[Score]) -> Callable[[str], np.ndarray]:
        return lambda field: np.mean([getattr(each, field) for each in some], axis=0)

    return "\n".join(
        [
            heading,
            "",
            f"{'':18}{by_two}   parts of",
            f"{'outline':18}{kinds}{'ours':>9}{'people':>10}",
            row(f"all {len(scores)}", mean(scores)),
            row("every other one", mean(scores[::2])),
            row("the rest", mean(scores[1::2])),
            "",
            *(row(each.name, mean([each])) for each in scores),
        ]
    )


def main() -> int:
    """Measure all outlines of a directory and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--seeds", type=int, nargs="+", default=[0, 1, 2])
    parser.add_argument("--parameters", type=json.loads, default={}, metavar="JSON")
    given = parser.parse_args()
    names = sorted(path.stem for path in (given.directory / "Shapes").glob("*.json"))
    if not names:
        parser.error(f"no outlines: {given.directory}/Shapes holds no .json files")
    parameters = Parameters(**given.parameters)
    scores = [score(given.directory, name, parameters, given.seeds) for name in names]
    heading = (
        f"$ {' '.join(['python', *sys.argv])}\n"
        f"bpy {bpy.app.version_string}, Python {sys.version.split()[0]},"
        f" NumPy {np.__version__}, {os.cpu_count()} cores"
    )
    print(report(scores, heading))
    return 0


if __name__ == "__main__":
    sys.exit(main())
