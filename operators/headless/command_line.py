"""Decomposes files without a window: `blender --command wcd` and `python .`."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from contextlib import ExitStack, closing
from pathlib import Path
from typing import Any

import bpy

from ...core.errors import DecompositionError
from .build_hulls import build_and_save
from .decompose_file import ObjectResult, decompose_objects
from .read.models import USUAL_UP, load
from .report import InputResult, save_report
from .request.options import Request, parse
from .request.outputs import Targets
from .screen import Screen
from .write.models import save
from .write.picture import save_picture
from .write.render_engine import EngineTrial

_COMMAND = "wcd"
_INTERRUPTED = 130  # what shells report after Ctrl-C

# What Blender gave for our command, to take it back with.
_registered: list[Any] = []


def register() -> None:
    """Add `blender --command wcd`."""
    _registered.append(bpy.utils.register_cli_command(_COMMAND, main))


def unregister() -> None:
    """Undo `register`."""
    while _registered:
        bpy.utils.unregister_cli_command(_registered.pop())


def main(arguments: list[str], program: str = f"blender --command {_COMMAND}") -> int:
    """Do what the command line asks for.

    Returns
    -------
    int
        Exit status: 0 if all is done, 1 if some input failed and the rest is done, 2
        if the arguments make no sense.
    """
    try:
        request = parse(arguments, program)
    except SystemExit as stop:  # argparse: after --help, --version and wrong usage
        return int(stop.code or 0)
    screen = Screen(sys.stdout, sys.stderr, request.quiet)
    try:
        results = _inputs(request, screen)
    except KeyboardInterrupt:
        screen.error("Interrupted.")
        return _INTERRUPTED
    errors: list[str] = []
    if request.report:
        report = request.report
        _attempt(
            lambda: save_report(report, results, request.parameters), errors, screen
        )
    return int(bool(errors) or any(result.failed for result in results))


def _inputs(request: Request, screen: Screen) -> list[InputResult]:
    """Decompose each input and write its model and picture."""
    with ExitStack() as stack:
        trial = None
        if any(targets.picture for targets in request.targets):
            trial = stack.enter_context(closing(EngineTrial()))
        return [
            _input(path, targets, request, trial, screen)
            for path, targets in zip(request.inputs, request.targets, strict=True)
        ]


def _input(
    path: Path,
    targets: Targets,
    request: Request,
    trial: EngineTrial | None,
    screen: Screen,
) -> InputResult:
    """Decompose one input and write its model, picture and hulls, as far as may be."""
    started = time.perf_counter()
    errors: list[str] = []
    parts: tuple[ObjectResult, ...] = ()
    output = picture = hulls = None
    try:
        objects = load(path, request.up)
    except DecompositionError as error:
        screen.error(str(error))
        errors.append(str(error))
        objects = []
    if objects:
        parts = decompose_objects(path.name, objects, request.parameters, screen)
    if any(result.record for result in parts):
        up = request.up or USUAL_UP.get(path.suffix.lower())
        if targets.output and _attempt(
            lambda: save(targets.output, up), errors, screen
        ):
            output = targets.output
        if targets.picture and _attempt(
            lambda: save_picture(targets.picture, objects, trial.engine()),
            errors,
            screen,
        ):
            picture = targets.picture
        if targets.hulls:
            try:
                parts = build_and_save(
                    targets.hulls,
                    up or "Z",
                    objects,
                    parts,
                    (request.parameters, request.hull_parameters),
                    screen,
                )
                hulls = targets.hulls
            except DecompositionError as error:
                screen.error(str(error))
                errors.append(str(error))
    return InputResult(
        path,
        parts,
        tuple(errors),
        output,
        picture,
        hulls,
        time.perf_counter() - started,
    )


def _attempt(act: Callable[[], None], errors: list[str], screen: Screen) -> bool:
    """Return whether `act` succeeded; note and show its error if not."""
    try:
        act()
    except DecompositionError as error:
        screen.error(str(error))
        errors.append(str(error))
        return False
    return True
