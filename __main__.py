"""Run the command line without Blender's window, in one of three ways.

After installation with pip, `wcd INPUT …` or `python -m weak_convex_decomposition
INPUT …`; in the folder of a checkout, `python . INPUT …`. All need the module bpy.
"""

import os
import shutil
import sys
from importlib import import_module
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import NoReturn

_PACKAGE = "weak_convex_decomposition"


def main(program: str) -> int:
    """Run the command line with the arguments of this process.

    Parameters
    ----------
    program : str
        Name of the command in the help.

    Returns
    -------
    int
        Exit status; 2 if the module bpy is missing.
    """
    try:
        import_module("bpy")  # first, because it provides mathutils
    except ModuleNotFoundError:
        print(
            f"error: {sys.executable} has no module bpy; install it with the extra bpy"
            ' (`pip install ".[bpy]"` in the project\'s folder), or install the'
            " extension and run `blender --command wcd`.",
            file=sys.stderr,
        )
        return 2
    package = import_module(__package__) if __package__ else _checkout()
    package.register()
    command_line = import_module(".operators.headless.command_line", package.__name__)
    status = command_line.main(sys.argv[1:], program=program)
    package.unregister()
    return status


def _checkout() -> ModuleType:
    """Load this folder as the package, whatever the folder's name."""
    root = Path(__file__).resolve().parent
    spec = spec_from_file_location(
        _PACKAGE, root / "__init__.py", submodule_search_locations=[str(root)]
    )
    package = module_from_spec(spec)
    sys.modules[_PACKAGE] = package
    spec.loader.exec_module(package)
    return package


def leave(status: int) -> NoReturn:
    """End the process with `status`, without shutting down the interpreter.

    The bpy wheel of Blender 4.2 may crash when the interpreter shuts down, for example
    after a glTF export. The crash would replace the exit status.

    Parameters
    ----------
    status : int
        Exit status.
    """
    bpy = sys.modules.get("bpy")
    if bpy is not None:
        shutil.rmtree(bpy.app.tempdir, ignore_errors=True)  # Blender removes it at exit
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def wcd() -> NoReturn:
    """Run the command `wcd`, which pip installs, and end the process."""
    leave(main("wcd"))


if __name__ == "__main__":
    leave(main(f"python -m {_PACKAGE}" if __package__ else "python ."))
