"""The one error whose text is shown to the user."""

import sys


class DecompositionError(Exception):
    """An error with one sentence for the user: what is wrong, and what to do."""


def missing_library(error: ImportError) -> DecompositionError:
    """Return the error for a library of the core that is missing or broken."""
    return DecompositionError(
        "SciPy, scikit-learn and threadpoolctl are needed, and one of them cannot be"
        f" loaded ({error}); run `{sys.executable} -m pip install scipy scikit-learn"
        " threadpoolctl`."
    )
