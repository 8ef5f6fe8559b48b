"""The options of the command line, and the request that they make."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, fields
from itertools import chain
from pathlib import Path
from typing import NoReturn

from ....core.errors import DecompositionError
from ....core.parameters.bodies import BodyParameters
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parameter import info_of
from ....core.parameters.parts import Parameters
from ....core.parameters.presets import PRESET_INFO, PRESETS, preset
from ....core.steps.processes import available
from ...bridge.stored.notes import version
from ..files.claims import Goals
from ..formats import one_line
from .asked_hulls import hull_file, useless_options
from .file_options import add_files
from .help_text import DESCRIPTION, EPILOG
from .input_list import all_inputs
from .option_names import SETTINGS, with_options
from .outputs import STANDARD_STREAM, Targets, targets_for
from .parameter_options import HelpFormatter, add_option, count, with_negative_numbers

_DEFAULT_PRESET = PRESETS[0].identifier


class _Parser(argparse.ArgumentParser):
    """Says what is wrong with the arguments in two lines, without the usage."""

    def error(self, message: str) -> NoReturn:
        """Show an error and end with status 2."""
        sentence = one_line(with_options(message))
        self.exit(2, f"error: {sentence}\nAll options: {self.prog} --help\n")


@dataclass(frozen=True)
class Request:
    """What the user asks for; checked, except for the content of the inputs.

    Attributes
    ----------
    inputs : tuple of Path
    targets : tuple of Targets
        The files to write for each input.
    report : Path or None
        ``-`` is standard output.
    up : {'Y', 'Z'} or None
        Axis that points up in the inputs; None for the usual one of each format.
    apply_modifiers : bool
        Decompose meshes as Blender shows them.
    with_hulls : bool
        Put hulls into the model that is written, too.
    quiet : bool
    processes : int
        Most processes that build hulls at once.
    parameters : Parameters
    hull_parameters : HullParameters
    body_parameters : BodyParameters
    notes : tuple of str
        Sentences to the user: which options change nothing.
    """

    inputs: tuple[Path, ...]
    targets: tuple[Targets, ...]
    report: Path | None
    up: str | None
    apply_modifiers: bool
    with_hulls: bool
    quiet: bool
    processes: int
    parameters: Parameters
    hull_parameters: HullParameters
    body_parameters: BodyParameters
    notes: tuple[str, ...]

    def goals(self) -> Goals:
        """Return where this run writes to."""
        places = [*chain.from_iterable(each.places() for each in self.targets)]
        if self.report and self.report != STANDARD_STREAM:
            places.append(self.report)
        return Goals(places)


def parse(arguments: list[str], program: str) -> Request:
    """Return the request of a command line.

    Parameters
    ----------
    arguments : list of str
        The words after the program.
    program : str
        How the user starts the program.

    Raises
    ------
    SystemExit
        After --help and --version, and with status 2 if the arguments are wrong.
    """
    parser = _parser(program)
    options = parser.parse_args(with_negative_numbers(arguments))
    try:
        settings = _settings(options)
        inputs = all_inputs(options.inputs)
        hulls = hull_file(options.hulls, options.hulls_format)
        targets = targets_for(
            inputs,
            options.output,
            options.picture,
            options.report,
            hulls,
            options.with_hulls,
        )
        return Request(
            inputs=inputs,
            targets=targets,
            report=options.report,
            up=options.up,
            apply_modifiers=options.apply_modifiers,
            with_hulls=options.with_hulls,
            quiet=options.quiet,
            processes=getattr(options, "processes", available()),
            parameters=settings[0],
            hull_parameters=settings[1],
            body_parameters=settings[2],
            notes=useless_options(vars(options), inputs, targets[0], settings),
        )
    except DecompositionError as error:
        parser.error(str(error))


def _settings(
    options: argparse.Namespace,
) -> tuple[Parameters, HullParameters, BodyParameters]:
    """Return the settings: those of the preset, and what the user gives."""
    chosen = preset(getattr(options, "preset", _DEFAULT_PRESET))
    given = vars(options)
    of_parts, of_hulls, of_bodies = (
        {each.name: given[each.name] for each in fields(kind) if each.name in given}
        for kind in SETTINGS
    )
    return (
        chosen.parameters(**of_parts),
        HullParameters(**of_hulls),
        BodyParameters(**of_bodies),
    )


def _parser(program: str) -> _Parser:
    """Return the parser of the command line."""
    parser = _Parser(
        prog=program,
        usage="%(prog)s INPUT [INPUT ...] [options]",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=HelpFormatter,
        allow_abbrev=False,
        add_help=False,
    )
    add_files(parser)
    method = parser.add_argument_group("how the parts are found")
    add_option(method, "preset", PRESET_INFO, _DEFAULT_PRESET)
    for_hulls = parser.add_argument_group(
        "how the hulls are built (with --hulls or --with-hulls)"
    )
    simulators = parser.add_argument_group("what simulators get (HULLS is .urdf, .xml)")
    groups = method, for_hulls, simulators
    for group, kind in zip(groups, SETTINGS, strict=True):
        for each in fields(kind):
            add_option(group, each.name, info_of(each), each.default)
    _add_general(parser)
    return parser


def _add_general(parser: argparse.ArgumentParser) -> None:
    """Add help, version and what is printed."""
    group = parser.add_argument_group("general")
    group.add_argument(
        "--quiet", action="store_true", help="print warnings and errors only"
    )
    group.add_argument(
        "--processes",
        metavar="COUNT",
        type=count,
        default=argparse.SUPPRESS,
        help="build the hulls of so many objects at once, if a file has many (default:"
        " as many as there are processors, 8 at most)",
    )
    group.add_argument(
        "--version",
        action="version",
        version=f"weak_convex_decomposition {version()}",
        help="print the version",
    )
    group.add_argument("-h", "--help", action="help", help="print this help")
