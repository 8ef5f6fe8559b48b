"""What each stage is good for: the Rand Index error with it switched off.

    make bench-ablation PSB=DIRECTORY BENCH="--jobs 2 --seeds 0 1 2 --line 'no details'"

One line for each, and for what is not on by default; errors are those of
rand_index.py. What a line changes is told with its standard error: by models, each the
mean of its seeds.
"""

import shlex
import statistics
import sys
from collections.abc import Callable, Hashable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from over_models import add_jobs, measured, parse, parser
from princeton import category, mean_error, median_count, read_humans, read_model
from stages import CHANGES, FULL, PATCHES, patched
from weak_convex_decomposition.core.cache import ShapeCache
from weak_convex_decomposition.core.decomposition import decompose_in_steps
from weak_convex_decomposition.core.geometry.mesh import TriangleMesh
from weak_convex_decomposition.core.parameters.parts import Parameters
from weak_convex_decomposition.core.sight import visibility
from weak_convex_decomposition.core.sight.prepared import PreparedShape
from weak_convex_decomposition.core.steps.progress import run
from weak_convex_decomposition.operators.bridge.rays.bvh import BvhRayCaster

# What comes after lines of sight: lines that differ in these alone share them.
AFTERWARDS = {
    "parts", "alpha", "containers", "normalization", "min_parts", "max_parts",
    "refinement", "smoothness", "bends", "smallest_part", "levels",
}  # fmt: skip


@dataclass(frozen=True)
class Outcome:
    """What came of one model on one line."""

    model: int
    seed: int
    line: str
    given: float
    auto: float
    n_auto: int


def outcomes(
    directory: Path, model: int, parameters: Parameters, lines: Sequence[str]
) -> list[Outcome]:
    """Return what comes of one model on some lines."""
    mesh, humans = read_model(directory, model), read_humans(directory, model)
    n_humans = median_count(humans)
    found = []
    with shared_sight(mesh):
        for line in lines:
            settings = replace(parameters, **CHANGES[line])
            given_settings = replace(settings, parts=n_humans)
            with patched(PATCHES.get(line, ())):
                cache = ShapeCache(BvhRayCaster)
                auto, given = (
                    run(decompose_in_steps(mesh, asked, cache))
                    for asked in (settings, given_settings)
                )
            found.append(
                Outcome(
                    model,
                    parameters.seed,
                    line,
                    mean_error(given.labels, humans),
                    mean_error(auto.labels, humans),
                    auto.n_parts,
                )
            )
    return found


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
    models = sorted({outcome.model for outcome in found})
    seeds = sorted({outcome.seed for outcome in found})
    n_busts = sum(category(model) == "Bust" for model in models)
    rows = [
        f"Means over {len(models)} models, {n_busts} of them busts, seeds {seeds}",
        "",
        f"{'':34}{'':14}{'without busts':>15}{'':7}{'change of error':>23}",
        f"{'':34}{'given':>7}{'auto':>7}{'given':>8}{'auto':>7}{'k auto':>7}"
        f"{'given':>15}{'auto':>15}",
    ]
    for line in lines:
        of_line = [outcome for outcome in found if outcome.line == line]
        plain = [outcome for outcome in of_line if category(outcome.model) != "Bust"]
        cells = "".join(
            format(statistics.fmean(getattr(each, field) for each in some), form)
            for some, field, form in (
                (of_line, "given", "7.3f"),
                (of_line, "auto", "7.3f"),
                (plain or of_line, "given", "8.3f"),
                (plain or of_line, "auto", "7.3f"),
                (of_line, "n_auto", "7.1f"),
            )
        )
        changes = [change(found, line, field) for field in ("given", "auto")]
        told = "" if line == FULL or FULL not in lines else "".join(changes)
        rows.append(f"{line:34}{cells}{told}")
    return "\n".join(rows)


def change(found: Sequence[Outcome], line: str, field: str) -> str:
    """Return by how much errors of a line exceed those in full, ± standard error."""
    errors = {(o.model, o.seed, o.line): getattr(o, field) for o in found}
    by_model: dict[int, list[float]] = {}
    for model, seed, each in errors:
        if each == line and (model, seed, FULL) in errors:
            more = errors[model, seed, line] - errors[model, seed, FULL]
            by_model.setdefault(model, []).append(more)
    means = [statistics.fmean(more) for more in by_model.values()]
    if len(means) < 2:
        return ""
    error = statistics.stdev(means) / np.sqrt(len(means))
    return f"{statistics.fmean(means):+8.4f}±{error:.4f}"


def main() -> int:
    """Measure every model of a directory on every line and print the table."""
    options = parser(__doc__)
    add_jobs(options)
    options.add_argument(
        "--line", action="append", choices=tuple(CHANGES), help="measure this one alone"
    )
    options.add_argument("--seeds", type=int, nargs="+", default=[0])
    arguments = parse(options)
    lines = arguments.line or tuple(CHANGES)

    def measure(model: int) -> list[Outcome]:
        print(model, file=sys.stderr)
        return [
            outcome
            for seed in arguments.seeds
            for outcome in outcomes(
                arguments.directory,
                model,
                replace(arguments.parameters, seed=seed),
                lines,
            )
        ]

    found = measured(arguments, measure, Outcome)
    print(f"$ {shlex.join(['python', *sys.argv])}\n\n{report(found, lines)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
