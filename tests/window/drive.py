"""Drives a Blender that has a window, from inside it.

    blender --python tests/window/drive.py -- SUBJECT

A subject is a file in subjects/, or the path of another file, with `steps(hands)`, a
generator that acts as a user does. It yields seconds to wait, or a function to wait
for; Blender goes on meanwhile. Exit status 0 says that it came to its end and nothing
was left behind.
"""

import importlib.util
import os
import sys
import time
import traceback
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "support")]

import checkout  # noqa: E402, F401  # makes the package importable
import weak_convex_decomposition as package  # noqa: E402
from hands import Hands  # noqa: E402

# Seconds that a subject waits for anything at most.
_PATIENCE = 240
_PAUSE = 0.05


def load(name):
    """Return the module of a subject."""
    path = Path(name)
    if path.suffix != ".py":
        path = next((HERE / "subjects").rglob(f"{name}.py"))
    spec = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Play:
    """A subject's steps, one after the other between Blender's own events."""

    def __init__(self, steps):
        self.steps = steps
        self.awaited = None
        self.deadline = 0.0

    def __call__(self):
        try:
            return self.go_on()
        except Exception:  # Blender would go on without its subject
            traceback.print_exc()
            leave(1)

    def go_on(self):
        if self.awaited is not None:
            if not self.awaited():
                if time.monotonic() > self.deadline:
                    self.steps.throw(TimeoutError("waited in vain"))
                return _PAUSE
            self.awaited = None
        try:
            step = next(self.steps)
        except StopIteration:
            package.unregister()
            leave(0)
        if callable(step):
            self.awaited, self.deadline = step, time.monotonic() + _PATIENCE
            return _PAUSE
        return step or _PAUSE


def leave(status):
    """End Blender at once: nobody is there to ask about unsaved changes."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)


def main():
    subject = sys.argv[sys.argv.index("--") + 1]
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.use_preferences_save = False
    # Blender would move the cursor back while a number is dragged, and a program that
    # drags, which says where the cursor is, would be taken to jump.
    preferences.inputs.use_mouse_continuous = False
    package.register()

    def steps():  # what fails as the subject is loaded ends Blender, too
        yield from load(subject).steps(Hands(Path(subject).stem))

    play = Play(steps())
    bpy.app.timers.register(play, first_interval=1.0, persistent=True)


main()
