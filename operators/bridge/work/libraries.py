"""Load SciPy and scikit-learn when work begins: enabling the add-on must be quick."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from dataclasses import replace
from importlib import import_module
from typing import Any, TypeVar

from ....core.errors import missing_library
from ....core.steps.progress import Progress, Steps

Result = TypeVar("Result")  # of any kind that has notes

# In the order in which they import one another.
_LIBRARIES = (
    "threadpoolctl",
    "scipy.linalg",
    "scipy.spatial",
    "scipy.optimize",
    "scipy.stats",
    "sklearn.utils",
    "sklearn.neighbors",
    "sklearn.cluster",
)


def load_libraries() -> Steps[None]:
    """Load the libraries of the core, one per step, so that the window responds.

    They take a second to load, which enabling the extension must not.

    Raises
    ------
    DecompositionError
        If one is missing, as in a plain Blender from pip, or broken.
    """
    for name in _LIBRARIES:
        if name not in sys.modules:
            yield Progress("Libraries", 0.0)
            try:
                import_module(name)
            except ImportError as error:
                raise missing_library(error) from error


def with_libraries(notes: Iterable[str], steps: Steps[Result]) -> Steps[Result]:
    """Load the libraries, run `steps`, and put `notes` before those of the result."""
    yield from load_libraries()
    value: Any = yield from steps
    return replace(value, notes=(*notes, *value.notes))
