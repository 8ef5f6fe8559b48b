"""Run the command line without Blender's window, in one of three ways.

After installation with pip, `wcd INPUT …` or `python -m weak_convex_decomposition
INPUT …`; in the folder of a checkout, `python . INPUT …`. All need the module bpy.
"""

import os
import signal
import sys

_PACKAGE = "weak_convex_decomposition"
_INTERRUPTED = 130  # what shells report after Ctrl-C


def _end_at_once(number: int, frame: object) -> None:
    """End a program that is only starting, and has written nothing.

    An exception would not do: what is being imported may catch it or print it.
    """
    os.write(2, b"error: Interrupted.\n")
    _end(_INTERRUPTED)


def _end(status: int) -> None:
    """End the process without the steps of Python and Blender for that."""
    bpy = sys.modules.get("bpy")
    folder = getattr(getattr(bpy, "app", None), "tempdir", "")
    if folder:  # Blender removes it when it shuts down
        from shutil import rmtree

        rmtree(folder, ignore_errors=True)
    os._exit(status)


def _on_interrupts(handler: object) -> None:
    """Set what Ctrl-C and requests to end do; what is ignored stays so."""
    hangup = getattr(signal, "SIGHUP", None)  # Windows has none
    for number in filter(None, (signal.SIGINT, signal.SIGTERM, hangup)):
        if signal.getsignal(number) is not signal.SIG_IGN:
            signal.signal(number, handler)


_on_interrupts(_end_at_once)  # before all imports that take time


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
    from importlib import import_module

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
    _on_interrupts(signal.SIG_IGN)  # all is done
    package.unregister()
    return status


def _checkout() -> object:
    """Load this folder as the package, whatever the folder's name."""
    from importlib.util import module_from_spec, spec_from_file_location

    root = os.path.dirname(os.path.realpath(__file__))
    spec = spec_from_file_location(
        _PACKAGE, os.path.join(root, "__init__.py"), submodule_search_locations=[root]
    )
    if spec is None or spec.loader is None:
        raise ImportError(f"{root} cannot be loaded")
    package = module_from_spec(spec)
    sys.modules[_PACKAGE] = package
    spec.loader.exec_module(package)
    return package


def leave(status: int) -> None:
    """End the process with `status`, without shutting down the interpreter.

    The bpy wheel of Blender 4.2 may crash when the interpreter shuts down, for example
    after a glTF export. The crash would replace the exit status.

    Parameters
    ----------
    status : int
        Exit status.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    _end(status)


def wcd() -> None:
    """Run the command `wcd`, which pip installs, and end the process."""
    leave(main("wcd"))


if __name__ == "__main__":
    leave(main(f"python -m {_PACKAGE}" if __package__ else "python ."))
