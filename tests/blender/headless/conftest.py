"""What tests of files share."""

import pytest
from headless.loading import load
from weak_convex_decomposition.core.errors import DecompositionError


@pytest.fixture
def unexpected(tmp_path):
    """Return a function that loads bad files and returns those with a wrong error.

    It takes the content (bytes) and a piece of the expected sentence by file name.
    """

    def check(cases):
        wrong = {}
        for name, (content, sentence) in cases.items():
            path = tmp_path / name
            path.write_bytes(content)
            error = _error_of(path)
            if sentence not in error or "\n" in error:
                wrong[name] = error
        return wrong

    return check


def _error_of(path):
    try:
        load(path)
    except DecompositionError as error:
        return str(error)
    return "no error"
