"""Runs a measurement over the benchmark's models, in several processes if asked to."""

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import checkout  # noqa: F401  # makes the package importable
from princeton import models
from weak_convex_decomposition.core.parameters.presets import PRESETS, preset

Figures = TypeVar("Figures")


def parser(description: str) -> argparse.ArgumentParser:
    """Return a parser of what all measurements are told."""
    parser = argparse.ArgumentParser(description=description.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument(
        "--models", type=int, nargs="+", help="numbers of models; all by default"
    )
    parser.add_argument(
        "--parameters",
        type=json.loads,
        default={},
        metavar="JSON",
        help='fields of Parameters, such as {"sight": "CONE"}',
    )
    parser.add_argument(
        "--preset",
        choices=[each.identifier for each in PRESETS],
        default=PRESETS[0].identifier,
        help="what these parameters change",
    )
    return parser


def parse(parser: argparse.ArgumentParser) -> argparse.Namespace:
    """Return the command line's arguments, with the models to go over."""
    arguments = parser.parse_args()
    arguments.models = arguments.models or models(arguments.directory)
    if not arguments.models:
        parser.error(f"no models: {arguments.directory}/off holds no .off files")
    chosen = preset(arguments.preset)
    arguments.parameters = chosen.parameters(**arguments.parameters)
    return arguments


def add_jobs(parser: argparse.ArgumentParser) -> None:
    """Let the command line say how many processes measure, and where figures go."""
    parser.add_argument(
        "--jobs",
        type=int,
        default=1,
        metavar="N",
        help="processes at a time; seconds are honest with one alone",
    )
    parser.add_argument(
        "--json", type=Path, metavar="FILE", help="write all figures there as well"
    )


def measured(
    arguments: argparse.Namespace,
    measure: Callable[[int], list[Figures]],
    kind: type[Figures],
) -> list[Figures]:
    """Return the figures, of the dataclass `kind`, of every model in turn."""
    if arguments.jobs > 1:
        rows = _spread(arguments.models, arguments.jobs)
    else:
        rows = [vars(row) for model in arguments.models for row in measure(model)]
    if arguments.json:
        arguments.json.write_text(json.dumps(rows, indent=1) + "\n")
    return [kind(**row) for row in rows]


def _spread(models: list[int], n_processes: int) -> list[dict]:
    """Return the figures of models that as many processes take turns with.

    They are programs like this one: bpy does not survive a fork. Of an option that is
    given twice the last one counts.
    """
    shares = [models[start::n_processes] for start in range(n_processes)]
    with tempfile.TemporaryDirectory() as folder:
        processes, files = [], []
        for share in filter(None, shares):
            files.append(Path(folder, f"{share[0]}.json"))
            command = [sys.executable, *sys.argv, "--jobs", "1", "--models"]
            command += [*map(str, share), "--json", str(files[-1])]
            processes.append(subprocess.Popen(command, stdout=subprocess.DEVNULL))
        failed = [process for process in processes if process.wait()]
        if failed:
            sys.exit("A process failed; see above.")
        rows = [row for file in files for row in json.loads(file.read_text())]
    return sorted(rows, key=lambda row: models.index(row["model"]))
