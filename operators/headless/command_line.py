"""The command line: `blender --command wcd` and `python .`."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import DecompositionError
from ...core.steps.progress import run
from ..bridge.work.libraries import load_libraries
from ..bridge.work.session_cache import results_kept
from .files.claims import Goals
from .interrupts import Interrupts, interruptible
from .report import save_report
from .request.options import Request, parse
from .request.outputs import STANDARD_STREAM
from .run.attempts import Attempts
from .run.decompose_file import decompose_file
from .run.results import InputResult
from .screen import Screen, StreamError, open_closed_streams, stop_printing, write
from .write.render_engine import EngineTrial

_COMMAND = "wcd"
_FAILED = 1
_NOTHING_DONE = 2
_INTERRUPTED = 130  # what shells report after Ctrl-C

# Blender's handle of our command; `unregister` needs it.
_registered: list[Any] = []


def register() -> None:
    """Add `blender --command wcd`."""
    _registered.append(bpy.utils.register_cli_command(_COMMAND, main))


def unregister() -> None:
    """Remove what `register` added."""
    while _registered:
        bpy.utils.unregister_cli_command(_registered.pop())


def main(arguments: list[str], program: str = f"blender --command {_COMMAND}") -> int:
    """Run the command line.

    Parameters
    ----------
    arguments : list of str
        The words after the program.
    program : str
        How the user starts the program; shown in the help.

    Returns
    -------
    int
        Exit status: 0 if everything was done, 1 if something failed and the rest was
        done, or if nothing can be printed any more, 2 if the arguments are wrong or
        SciPy is missing, 130 after Ctrl-C.
    """
    can_print = open_closed_streams()
    try:
        with interruptible() as interrupts:
            return _run(arguments, program, interrupts, can_print)
    except StreamError as error:
        stop_printing(error)
        return _FAILED
    except KeyboardInterrupt:
        with suppress(StreamError):
            write(sys.stderr, "error: Interrupted.\n")
        return _INTERRUPTED


def _run(
    arguments: list[str], program: str, interrupts: Interrupts, can_print: bool
) -> int:
    """Run the command line; return the exit status."""
    try:
        request = parse(arguments, program)
    except SystemExit as stop:  # from argparse: --help, --version or wrong usage
        write(sys.stdout, "")  # flush the help
        return int(stop.code or 0)
    report_is_printed = request.report == STANDARD_STREAM
    if report_is_printed and not can_print:
        raise StreamError(
            "--report is -, but standard output is closed; name a file for the report."
        )
    out = sys.stderr if report_is_printed else sys.stdout
    screen = Screen(out, sys.stderr, request.quiet)
    results: list[InputResult] = []
    attempts, goals, interrupted = Attempts(screen), request.goals(), False
    for note in request.notes:
        screen.warning(note)
    try:
        if not _has_libraries(screen):
            return _NOTHING_DONE
        for result in _decompose_files(request, screen, goals):
            if result.failed:  # by an interrupt that an operator lost, maybe
                interrupts.check()
            results.append(result)
            interrupts.check()
    except KeyboardInterrupt:
        screen.error("Interrupted.")
        interrupted = True
    finally:  # an unforeseen error, too, leaves a report of what was done
        attempts.written(
            request.report, lambda file: _report(file, results, request, goals)
        )
    failed = attempts.errors or any(result.failed for result in results)
    return _INTERRUPTED if interrupted else _FAILED if failed else 0


def _report(
    file: Path, results: Sequence[InputResult], request: Request, goals: Goals
) -> None:
    """Write the report, unless an input refers to what is in its place."""
    goals.check([file])
    save_report(file, results, request, request.inputs[len(results) :])


def _has_libraries(screen: Screen) -> bool:
    """Load SciPy and its like; return whether they are there, and say what is not."""
    try:
        run(load_libraries())
    except DecompositionError as error:
        screen.error(str(error))
        return False
    return True


def _decompose_files(
    request: Request, screen: Screen, goals: Goals
) -> Iterator[InputResult]:
    """Decompose all inputs, one after the other; yield what became of each."""
    with closing(EngineTrial()) as trial, results_kept():
        if any(targets.picture for targets in request.targets):
            trial.start()  # it runs while the first input is decomposed
        for path, targets in zip(request.inputs, request.targets, strict=True):
            yield decompose_file(path, targets, request, trial, screen, goals)
