"""Replace a first look at parts by the parts themselves.

While settings change, parts that would take long are shown as `core.parts.first_look`
finds them, and those of large meshes with seams along patches of faces. Here the run
that the settings ask for is made, in slices, while nothing else runs. It belongs to the
undo step of the first look. So it is made again if undo brings that back, and files
never keep a first look.
"""

from __future__ import annotations

import bpy

from ...core.errors import DecompositionError
from ...core.steps.job import Job
from ...core.steps.progress import Steps
from ..bridge.parts.figures import figures_of
from ..bridge.read.evaluated import read_as
from ..bridge.read.target import Target
from ..bridge.refusals import refusal
from ..bridge.stored.record import forget_rough, is_rough, noted_mesh, noted_parameters
from ..bridge.watching import REPLACED, start_timer, stop_timer
from ..bridge.work.locking import decompose_unlocked
from ..bridge.work.run_edit import Edited
from ..viewport.viewports import redraw_sidebars
from . import modal

# Seconds that settings rest before their parts are found.
_REST = 0.3
# Seconds of work in a slice, and between two slices.
_SLICE = 0.03
_PAUSE = 0.01
# Seconds until the next try, if an object is in a mode in which it has to wait.
_RETRY = 0.5

_current: tuple[Target, Job[Edited]] | None = None


def start() -> None:
    """Find the parts of all objects with a first look at them, after a rest."""
    stop()
    if bpy.app.background:  # nothing calls timers there
        finish()
    else:
        start_timer(go_on, _REST)


def stop(*_: object) -> None:
    """Find nothing any more, until `start`. Blender passes arguments to handlers."""
    _cancel()
    stop_timer(go_on)


def _cancel() -> None:
    """Drop what is half found."""
    global _current
    if _current is not None:
        _current[1].cancel()
    _current = None


def working() -> bool:
    """Return whether parts are being found."""
    return _current is not None


def go_on() -> float | None:
    """Work for a slice; return when to go on, None if no first look is left."""
    global _current
    if modal.busy():
        return _PAUSE
    rough = [obj for obj in bpy.data.objects if is_rough(obj)]
    ready = [obj for obj in rough if refusal(obj) is None]
    if not ready:
        _cancel()  # Blender would never call a timer again that was taken away
        return _RETRY if rough else None
    target = Target.of(ready[0])
    try:
        if _current is None or _current[0] != target:
            _current = target, Job(_steps(ready[0]))
        elif _current[1].done:  # the parts are written in a slice of their own
            _current[1].result().write(ready[0])
            _current = None
            redraw_sidebars()
        else:
            _current[1].advance(_SLICE)
    except DecompositionError:  # the next run reports it
        forget_rough(ready[0])
        _current = None
    return _PAUSE


def _steps(obj: bpy.types.Object) -> Steps[Edited]:
    """Return the steps that find the parts of an object anew."""
    parameters, figures = noted_parameters(obj), figures_of(obj)
    if parameters is None or figures is None or figures.problem:
        raise DecompositionError(f"The faces of {obj.name} have changed; start again.")
    return decompose_unlocked(obj, parameters, seen=read_as(noted_mesh(obj), obj))


def _start_again(*_: object) -> None:
    """Look whether undo, redo or a file brought a first look."""
    if any(is_rough(obj) for obj in bpy.data.objects):
        start()


def finish(*_: object) -> None:
    """Find all parts at once, before a file is saved."""
    while modal.busy() is None and go_on() == _PAUSE:
        pass


HANDLERS = {
    **dict.fromkeys(REPLACED, _start_again),
    "save_pre": finish,
    "load_pre": stop,
}
