"""The command line's options; those of the method come from its parameters."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, fields
from pathlib import Path

from ....core.errors import DecompositionError
from ....core.parameters.hulls import HullParameters
from ....core.parameters.parameter import info_of
from ....core.parameters.parts import Parameters
from ....core.parameters.presets import PRESET_INFO, PRESETS, preset
from ...bridge.stored.notes import version
from ..read.models import ENDINGS as READ
from ..write.hull_files import HULL_ENDINGS, HULL_FORMATS
from ..write.models import ENDINGS as WRITTEN
from .outputs import Targets, targets_for
from .parameter_options import add_option

_DESCRIPTION = f"""\
Split the mesh objects of each INPUT into weakly convex parts.
INPUT ends in one of {" ".join(READ)}.
Results go to the files that the options name; a summary goes to standard output,
progress, warnings and errors to standard error."""

_DEFAULT_PRESET = PRESETS[0].identifier

_EPILOG = f"""\
output formats:
  .blend  everything: materials, vertex groups, face attribute wcd_part, record
  .glb    one material a part; the record as extras of the node
  .obj    one material and group a part, in an .mtl file beside it
  .ply    colors and part numbers on the vertices; vertices on seams doubled
OUTPUT ends in one of {" ".join(WRITTEN)}. With several inputs, OUTPUT, PICTURE and
HULLS contain {{name}}, which stands for the input's name without its ending.

hull formats:
  .glb .obj .usd  an object a hull
  .stl            all hulls in one mesh
  .urdf .xml      for simulators (.xml is MuJoCo's MJCF); each hull an .obj file in the
                  folder HULLS_hulls beside it
HULLS ends in one of {" ".join(HULL_ENDINGS)}.

exit status: 0 all done; 1 some input failed and the rest is done; 2 wrong usage."""


@dataclass(frozen=True)
class Request:
    """What the user asks for, checked as far as is possible without reading."""

    inputs: tuple[Path, ...]
    targets: tuple[Targets, ...]
    report: Path | None
    up: str | None
    quiet: bool
    parameters: Parameters
    hull_parameters: HullParameters


def parse(arguments: list[str], program: str) -> Request:
    """Return the request that `arguments` state; exits like argparse."""
    parser = _parser(program)
    options = parser.parse_args(arguments)
    given, for_hulls = (
        {
            f.name: getattr(options, f.name)
            for f in fields(kind)
            if hasattr(options, f.name)
        }
        for kind in (Parameters, HullParameters)
    )
    chosen = preset(getattr(options, "preset", _DEFAULT_PRESET))
    try:
        return Request(
            inputs=tuple(options.inputs),
            targets=targets_for(
                options.inputs,
                options.output,
                options.picture,
                options.report,
                _hull_file(options.hulls, options.hulls_format),
            ),
            report=options.report,
            up=options.up,
            quiet=options.quiet,
            parameters=chosen.parameters(**given),
            hull_parameters=HullParameters(**for_hulls),
        )
    except DecompositionError as error:
        parser.error(str(error))


def _hull_file(hulls: str | None, hulls_format: str | None) -> str | None:
    """Return the file for hulls with the ending of the format, if one is asked for."""
    if hulls_format is None:
        return hulls
    if hulls is None:
        raise DecompositionError("--hulls-format needs --hulls, which names the file.")
    ending = HULL_FORMATS[hulls_format]
    return hulls if hulls.lower().endswith(ending) else hulls + ending


def _parser(program: str) -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    parser = argparse.ArgumentParser(
        prog=program,
        description=_DESCRIPTION,
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    _add_files(parser)
    method = parser.add_argument_group("parameters of the method")
    add_option(method, "preset", PRESET_INFO, _DEFAULT_PRESET)
    for_hulls = parser.add_argument_group("parameters of --hulls")
    for group, kind in ((method, Parameters), (for_hulls, HullParameters)):
        for each in fields(kind):
            add_option(group, each.name, info_of(each), each.default)
    return parser


def _add_files(parser: argparse.ArgumentParser) -> None:
    """Add what is read and written, and how it is told."""
    parser.add_argument("inputs", metavar="INPUT", nargs="+", type=Path)
    parser.add_argument(
        "--output", metavar="OUTPUT", help="write the model with its parts"
    )
    parser.add_argument(
        "--report",
        metavar="FILE.json",
        type=Path,
        help="write parameters, parts, their areas and convexity ranks as JSON",
    )
    parser.add_argument(
        "--picture",
        metavar="PICTURE.png",
        help="write a picture of the parts, seen from the front and the back",
    )
    parser.add_argument(
        "--hulls",
        metavar="HULLS",
        help="write collision hulls of the parts",
    )
    parser.add_argument(
        "--hulls-format",
        type=str.lower,
        choices=tuple(HULL_FORMATS),
        help="format of HULLS, whose ending is added where it is missing (default: as"
        " the ending says)",
    )
    parser.add_argument(
        "--up",
        type=str.upper,
        choices=("Y", "Z"),
        help="axis that points up in .obj .off .ply .stl .xyz .pwn .pts files, in and"
        " out (default: Y in .obj and .off, Z in the others; the output keeps the"
        " axes of the input)",
    )
    parser.add_argument(
        "--quiet", action="store_true", help="print nothing but errors and warnings"
    )
    parser.add_argument(
        "--version",
        action="version",
        version=f"weak_convex_decomposition {version()}",
        help="print the version",
    )
