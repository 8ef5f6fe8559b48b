"""The options for files: the inputs and how they are read, and what is written."""

from __future__ import annotations

import argparse
import os
from functools import partial
from pathlib import Path
from typing import Any

from ..formats import HULL_FORMATS, HULLS_WITHIN_ENDINGS, USUAL_UP


class _Once(argparse.Action):
    """Stores the value of an option; two are refused, since one would be dropped."""

    def __call__(
        self,
        _parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        _option: str | None = None,
    ) -> None:
        """Store the value."""
        if getattr(namespace, self.dest) is not None:
            raise argparse.ArgumentError(self, "it is given twice; name one file")
        setattr(namespace, self.dest, values)


def _name(text: str) -> str:
    """Return the name of a file, as it is given; paths drop what shows that it is none.

    The path of an empty text is the folder of the user.
    """
    if not text:
        raise argparse.ArgumentTypeError("it is empty; name a file")
    if text.endswith(("/", os.sep)):
        raise argparse.ArgumentTypeError(f"{text} is a folder; name a file")
    return text


def _path(text: str) -> Path:
    """Return the path of a file."""
    return Path(_name(text))


def add_files(parser: argparse.ArgumentParser) -> None:
    """Add the inputs and how they are read, and the files to write."""
    y_up = [ending for ending, up in USUAL_UP.items() if up == "Y"]
    files = parser.add_argument_group("files")
    files.add_argument(
        "inputs",
        metavar="INPUT",
        nargs="+",
        type=_path,
        help="models to decompose; - reads their paths from standard input, one a line",
    )
    _add_outputs(files)
    files.add_argument(
        "--up",
        type=str.upper,
        choices=("Y", "Z"),
        help=f"axis that points up in {' '.join(USUAL_UP)} files that are read or"
        f" written (default: Y in {' and '.join(y_up)}, Z in the others; the output"
        " keeps the axes of the input)",
    )
    files.add_argument(
        "--apply-modifiers",
        action="store_true",
        help="decompose, and write, meshes with their modifiers and shape keys applied"
        " (default: meshes without them)",
    )


def _add_outputs(files: argparse._ArgumentGroup) -> None:
    """Add the files to write."""
    add_file = partial(files.add_argument, action=_Once, type=_name)
    add_file("--output", metavar="OUTPUT", help="write the model with its parts")
    add_file(
        "--picture",
        metavar="PICTURE.png",
        help="write a picture of the parts, seen from the front and the back",
    )
    add_file("--hulls", metavar="HULLS", help="write collision hulls")
    files.add_argument(
        "--hulls-format",
        type=str.lower,
        choices=tuple(HULL_FORMATS),
        help="format of HULLS; its ending is added to HULLS if it is missing"
        " (default: the format of the ending of HULLS)",
    )
    files.add_argument(
        "--with-hulls",
        action="store_true",
        help=f"put collision hulls into OUTPUT, too ({' '.join(HULLS_WITHIN_ENDINGS)})",
    )
    add_file(
        "--report",
        metavar="FILE.json",
        type=_path,
        help="write the parameters and the parts with their areas and convexity ranks"
        " as JSON; - prints it to standard output, and results to standard error",
    )
