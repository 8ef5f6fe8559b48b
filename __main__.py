"""The command line without Blender's window, started in one of three ways.

`wcd INPUT …` once installed by pip, `python -m weak_convex_decomposition INPUT …`, and
`python . INPUT …` in a bare checkout. Each needs the bpy module.
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
    """Run the command line; `program` is what its help calls it."""
    try:
        import_module("bpy")  # before anything that needs mathutils
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
    """Load this folder as a package, whatever its name."""
    root = Path(__file__).resolve().parent
    spec = spec_from_file_location(
        _PACKAGE, root / "__init__.py", submodule_search_locations=[str(root)]
    )
    package = module_from_spec(spec)
    sys.modules[_PACKAGE] = package
    spec.loader.exec_module(package)
    return package


def leave(status: int) -> NoReturn:
    """End the process with `status`, whatever becomes of Blender meanwhile.

    The wheel of Blender 4.2 crashes at the interpreter's end, after a glTF export for
    one, which would replace the status.
    """
    bpy = sys.modules.get("bpy")
    if bpy is not None:
        shutil.rmtree(bpy.app.tempdir, ignore_errors=True)  # Blender's own clean-up
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def wcd() -> NoReturn:
    """Run the command `wcd` that pip installs."""
    leave(main("wcd"))


if __name__ == "__main__":
    leave(main(f"python -m {_PACKAGE}" if __package__ else "python ."))
