"""`python . INPUT …` with the bpy wheel: decomposes files from a bare checkout."""

import importlib
import importlib.util
import os
import shutil
import sys
from pathlib import Path
from typing import NoReturn

_PACKAGE = "weak_convex_decomposition"


def main() -> int:
    """Load this folder as a package, whatever its name, and run its command line."""
    try:
        importlib.import_module("bpy")  # before anything that needs mathutils
    except ModuleNotFoundError:
        print(
            f"error: {sys.executable} has no module bpy; use the Python that `make"
            " demo` sets up, or install the extension and run"
            " `blender --command wcd`.",
            file=sys.stderr,
        )
        return 2
    root = Path(__file__).resolve().parent
    spec = importlib.util.spec_from_file_location(
        _PACKAGE, root / "__init__.py", submodule_search_locations=[str(root)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules[_PACKAGE] = package
    spec.loader.exec_module(package)
    package.register()
    command_line = importlib.import_module(
        f"{_PACKAGE}.operators.headless.command_line"
    )
    status = command_line.main(sys.argv[1:], program="python .")
    package.unregister()
    return status


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


if __name__ == "__main__":
    leave(main())
