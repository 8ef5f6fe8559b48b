"""What each stage is good for: the Rand Index error with it switched off.

    make bench-ablation PSB=DIRECTORY [BENCH="--jobs 2 --line 'no graph cut'"]

One line for each, and for what is not on by default; errors are those of
rand_index.py. Psi is counted for all of them as the full method counts it, by its own
samples.
"""

import shlex
import statistics
import sys
from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any
from unittest import mock

import numpy as np
from over_models import add_jobs, measured, parse, parser
from princeton import category, mean_error, median_count, read_humans, read_model
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.clusters.embedding import embed
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.parameters.presets import preset
from weak_convex_decomposition.core.parts import part_count, part_memo, partition
from weak_convex_decomposition.core.parts.merging.creases import CreaseParts
from weak_convex_decomposition.core.sight import visibility
from weak_convex_decomposition.core.sight.pair_visibility import PairVisibility
from weak_convex_decomposition.core.sight.prepared import PreparedShape
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster


def of_equal_length(embedding: np.ndarray) -> np.ndarray:
    """Return the embedding with eigenvectors that are not scaled by eigenvalues."""
    lengths = np.linalg.norm(embedding, axis=0)
    return embedding / lengths * np.sqrt(len(embedding))


def by_sight_alone(pairs: PairVisibility, _positions: np.ndarray) -> Iterator[None]:
    """Return, as steps, lines of sight in place of likely pairs."""
    yield from ()
    return pairs


def no_sides(*_: object) -> Iterator[None]:
    """Return, as steps, that a shape has no mirror plane."""
    yield from ()
    return ()


FULL = "full"
CONE = {"sight": "CONE", "samples": 3000}
# What each line changes of the parameters.
CHANGES: dict[str, dict[str, object]] = {
    FULL: {},
    "all pairs of samples": {"sight": "ALL_PAIRS"},
    "cone sight": CONE,
    "cone sight, psi from ray hits": {**CONE, "psi_pairs": "RAYS"},
    "containers hollow": {"containers": "HOLLOW"},
    "balance alpha = 1": {"alpha": 1.0},
    "eigenvectors of equal length": {},
    "no likely pairs": {},
    "no loops of creases": {},
    "no psi-raising moves": {},
    "no psi in moves and seams": {"refinement": "EMBEDDING"},
    "no graph cut": {"smoothness": 0.0},
    "no symmetry": {},
    "no tolerance in the search for k": {},
    "no comparison with loose clusters": {},
    "bends kept": {"bends": "KEEP"},
    "no details": {"levels": 1},
    "two levels": {"levels": 2},
    "preset of the paper": preset("PAPER").changes,
}
# What lines replace in the code, where no parameter does: module, name, replacement.
PATCHES: dict[str, Sequence[tuple[Any, str, Any]]] = {
    "eigenvectors of equal length": [
        (part_memo, "embed", lambda *given: of_equal_length(embed(*given)))
    ],
    "no likely pairs": [(visibility, "likely_pairs", by_sight_alone)],
    "no loops of creases": [(CreaseParts, "better", lambda _, rivals, *__: rivals)],
    "no psi-raising moves": [
        (partition, "raise_psi", lambda _pairs, labels, *_: labels)
    ],
    "no tolerance in the search for k": [
        (partition, "_NEGLIGIBLE", 0.0),
        (part_count, "_GAIN_TOLERANCE", 0.0),
        (part_count, "_WIDE_TOLERANCE", 0.0),
    ],
    "no symmetry": [(part_memo, "find_sides", no_sides)],
    "no comparison with loose clusters": [
        (partition.Partitioner, "psi_of_clusters", lambda *_: -np.inf)
    ],
}
# What comes after lines of sight: lines that differ in these alone share them.
AFTERWARDS = {
    "parts", "alpha", "containers", "normalization", "min_parts", "max_parts",
    "refinement", "smoothness", "bends", "smallest_part", "levels",
}  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """What came of one model on one line."""

    model: int
    line: str
    given: float
    auto: float
    n_auto: int
    psi: float


def outcomes(
    directory: Path, model: int, parameters: Parameters, lines: Sequence[str]
) -> list[Outcome]:
    """Return what comes of one model on some lines."""
    mesh, humans = read_model(directory, model), read_humans(directory, model)
    n_humans = median_count(humans)
    found = []
    with shared_sight(mesh):
        cache = ShapeCache(BvhRayCaster)
        shape = run(cache.prepare(mesh))
        full = run(cache.see(shape, parameters)).visibility
        for line in lines:
            settings = replace(parameters, **CHANGES[line])
            given_settings = replace(settings, parts=n_humans)
            with patched(PATCHES.get(line, ())):
                cache = ShapeCache(BvhRayCaster)
                auto, given = (
                    run(decompose_in_steps(mesh, asked, cache))
                    for asked in (settings, given_settings)
                )
            samples = auto.labels[full.nodes]
            tally = full.psi_pairs.tally(samples, auto.n_parts)
            found.append(
                Outcome(
                    model,
                    line,
                    mean_error(given.labels, humans),
                    mean_error(auto.labels, humans),
                    auto.n_parts,
                    tally.psi(parameters.alpha),
                )
            )
    return found


@contextmanager
def patched(replacements: Sequence[tuple[Any, str, Any]]) -> Iterator[None]:
    """Put replacements in the place of what modules have under a name."""
    with ExitStack() as stack:
        for module, name, replacement in replacements:
            stack.enter_context(mock.patch.object(module, name, replacement))
        yield


@contextmanager
def shared_sight(mesh: TriangleMesh) -> Iterator[None]:
    """Look once for all lines that see the same: that takes longest."""

    def looked_at(shape: PreparedShape, parameters: Parameters) -> Hashable:
        if shape.n_nodes < mesh.n_polygons:
            return object()  # samples of a part alone are nobody else's
        named = vars(parameters).items()
        return frozenset(item for item in named if item[0] not in AFTERWARDS)

    keys: dict[str, Callable[..., Hashable]] = {
        "find_lines_of_sight": looked_at,
        "see_through_containers": lambda *given: tuple(map(id, given[1:])),
    }
    shared = {name: once(getattr(visibility, name), key) for name, key in keys.items()}
    with patched([(visibility, name, steps) for name, steps in shared.items()]):
        yield


def once(steps: Callable[..., Any], key: Callable[..., Hashable]) -> Callable[..., Any]:
    """Return the steps as they are for the first call of each key, then their value."""
    kept: dict[Hashable, Any] = {}

    def steps_or_value(*arguments: Any) -> Iterator[Any]:
        asked = key(*arguments)
        if asked not in kept:
            kept[asked] = yield from steps(*arguments)
        return kept[asked]

    return steps_or_value


def report(found: Sequence[Outcome], lines: Sequence[str]) -> str:
    """Return the table, one line for each stage switched off."""
    dry = [outcome for outcome in found if category(outcome.model) != "Cup"]
    n_models = len({outcome.model for outcome in found})
    rows = [
        f"Means over {n_models} models",
        "",
        f"{'':34}{'':14}{'without cups':>15}",
        f"{'':34}{'given':>7}{'auto':>7}{'given':>8}{'auto':>7}{'k auto':>8}{'psi':>7}",
    ]
    for line in lines:
        cells = (
            format(_mean(some, line, field), form)
            for some, field, form in (
                (found, "given", "7.3f"),
                (found, "auto", "7.3f"),
                (dry, "given", "8.3f"),
                (dry, "auto", "7.3f"),
                (found, "n_auto", "8.1f"),
                (found, "psi", "7.3f"),
            )
        )
        rows.append(f"{line:34}{''.join(cells)}")
    return "\n".join(rows)


def _mean(found: Sequence[Outcome], line: str, field: str) -> float:
    """Return the mean of a figure on one line; of nothing, it is not a number."""
    figures = [getattr(outcome, field) for outcome in found if outcome.line == line]
    return statistics.fmean(figures) if figures else float("nan")


def main() -> int:
    """Measure every model of a directory on every line and print the table."""
    options = parser(__doc__)
    add_jobs(options)
    options.add_argument(
        "--line", action="append", choices=tuple(CHANGES), help="measure this one alone"
    )
    arguments = parse(options)
    lines = arguments.line or tuple(CHANGES)

    def measure(model: int) -> list[Outcome]:
        print(model, file=sys.stderr)
        return outcomes(arguments.directory, model, arguments.parameters, lines)

    found = measured(arguments, measure, Outcome)
    print(f"$ {shlex.join(['python', *sys.argv])}\n\n{report(found, lines)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
