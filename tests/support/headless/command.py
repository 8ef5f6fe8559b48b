"""The command line, in this process, or in one of its own as a user starts it."""

import os
import subprocess
import sys

from checkout import ROOT
from weak_convex_decomposition.operators.headless.command_line import main

# Up to that error a ring gets the three hulls that it may have, and gets them at once.
QUICK = ["--samples=100", "--parts=2", "--max-hulls=3", "--max-error=0.5"]


def run_wcd(*words):
    """Run the command line in this process; return its status."""
    return main([*map(str, words)])


def start(*arguments, **options):
    """Start `python .` with arguments; return the process, whose output is piped."""
    # Set by bpy in this process; another bpy would say that it found it.
    environment = {k: v for k, v in os.environ.items() if k != "OCIO"}
    environment |= options.pop("environment", {})
    return subprocess.Popen(
        [sys.executable, str(ROOT), *map(str, arguments)],
        env=environment,
        stdin=options.pop("stdin", subprocess.DEVNULL),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        **options,
    )


def content(folder):
    """Return the bytes of all files in a folder, by path."""
    files = (file for file in folder.rglob("*") if file.is_file())
    return {str(file.relative_to(folder)): file.read_bytes() for file in files}
