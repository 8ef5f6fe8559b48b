"""Load SciPy and scikit-learn while nothing runs: enabling the add-on must be quick.

They take a second or two, in slices of at most 0.1 s each where they can be split. The
slices begin when the tab is first drawn. A run that starts earlier loads the rest.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from dataclasses import replace
from importlib import import_module
from typing import Any, TypeVar

from .... import core
from ....core.errors import DecompositionError, missing_library
from ....core.steps.progress import Progress, Steps
from ..watching import start_timer, stop_timer

Result = TypeVar("Result")  # of any kind that has notes

# Each imports what comes before it. SciPy and scikit-learn import the modules of other
# packages, too, which take as long. What is left of scipy.stats, 0.15 s, cannot be
# split: to import one of its modules imports all of them.
_LIBRARIES = (
    "threadpoolctl",
    "numpy.f2py",
    "unittest.mock",
    "numpy.testing",
    "scipy.sparse",
    "scipy.linalg",
    "scipy.special",
    "scipy.ndimage",
    "scipy.spatial",
    "scipy.optimize",
    "scipy.interpolate",
    "scipy.integrate",
    "scipy.stats",
    "joblib",
    "sklearn.utils",
    "sklearn.metrics",
    "sklearn.linear_model",
    "sklearn.cluster",
)
# Seconds between two slices, for Blender; and until the next try if one is missing.
_PAUSE = 0.1
_RETRY = 60.0


def load_libraries() -> Steps[None]:
    """Load the libraries of the core, and the core, a module per step.

    Raises
    ------
    DecompositionError
        If one is missing, as in a plain Blender from pip, or broken.
    """
    for name in _missing():
        yield Progress("Libraries", 0.0)
        _load(name)


def load_while_idle() -> None:
    """Load the libraries in slices, between Blender's own events."""
    if any(_missing()):
        start_timer(_load_next, _PAUSE)


def stop() -> None:
    """Load no more."""
    stop_timer(_load_next)


def _load_next() -> float | None:
    """Load a module; return after how many seconds to load another, None for never."""
    try:
        for name in _missing():
            _load(name)
            return _PAUSE
    except DecompositionError:
        return _RETRY  # a run says it
    return None


def _missing() -> Iterator[str]:
    """Yield the modules that are not loaded yet, in the order to load them."""
    yield from (
        name for name in (*_LIBRARIES, *core.MODULES) if name not in sys.modules
    )


def _load(name: str) -> None:
    """Import a module."""
    try:
        import_module(name)
    except ImportError as error:
        raise missing_library(error) from error


def with_libraries(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Load the libraries, run `steps`, and put `notes` before those of the result."""
    yield from load_libraries()
    value: Any = yield from steps
    return replace(value, notes=(*notes, *value.notes))
